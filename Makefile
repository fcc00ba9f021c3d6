# BendTorsion: the targets a user or a contributor needs. `make demo` and `make test` suffice.

PYTHON ?= /usr/bin/python3
RUFF = ruff==0.17.6
EXAMPLE = resources/examples/concert_hall/concert_hall.xlsx
DEMO = build/concert_hall
DATA = $(or $(XDG_DATA_HOME),$(HOME)/.local/share)
USER_FOLDER = $(or $(FREECAD_USER_HOME),$(DATA)/FreeCAD)

.PHONY: demo test test-optional install lint format benchmark tutorial translations findings check-structure coverage mutants release packages clean

demo: packages  ## build the concert hall into build/concert_hall
	@$(PYTHON) -m BendTorsionWB build $(EXAMPLE) --out $(DEMO)
	@echo
	@echo "Open the model:    freecad $(DEMO)/model.FCStd"
	@echo "Open the sheets:   $(DEMO)/sheets/*.pdf"
	@echo "Cut files:         $(DEMO)/plates/*.dxf"
	@echo "Lofting data:      $(DEMO)/results.xlsx"

# A file's tests stay together: they share fixtures, folders and pictures. Two workers more than there
# are processors: sessions in FreeCAD's window wait for it to settle.
TOGETHER = -n $(shell expr $$(nproc) + 2) --dist loadfile

# Every program the tests start would compile the whole package anew.
test: export PYTHONDONTWRITEBYTECODE =
test: packages  ## run the everyday tests; with ALL=1 the slow ones too
	@$(PYTHON) -m pytest $(TOGETHER) $(if $(ALL),,-m "not slow")

# Newer releases would bring a numpy that Debian's scipy does not load with.
OPTIONAL = rhino3dm==8.17.0 distributed==2024.5.0 dask==2024.5.0

test-optional: packages build/optional/bin/python  ## run the tests of what is optional: Rhino files, a Dask cluster
	@build/optional/bin/python -m pytest -m optional

build/optional/bin/python: Makefile
	@$(PYTHON) -m venv --system-site-packages build/optional
	@build/optional/bin/pip install --quiet --disable-pip-version-check $(OPTIONAL)
	@touch $@

install: packages  ## link this checkout into FreeCAD's Mod folder
	@# FreeCAD 1.1 has a folder per release, v1-1 and so on, where it was not there before 1.1.
	@set -e; for folder in "$(USER_FOLDER)" "$(USER_FOLDER)"/v[0-9]*-[0-9]*; do \
		case "$$folder" in *"/v[0-9]*-[0-9]*") continue ;; esac; \
		mod="$$folder/Mod"; mkdir -p "$$mod"; \
		if [ -e "$$mod/BendTorsion" ] && [ ! -L "$$mod/BendTorsion" ]; then \
			echo "$$mod/BendTorsion exists and is not a link: move it away first" >&2; exit 1; fi; \
		ln -sfn "$(CURDIR)" "$$mod/BendTorsion"; \
		echo "Linked $$mod/BendTorsion: restart FreeCAD and choose the BendTorsion workbench."; \
	done

lint: build/ruff/bin/ruff  ## check style and formatting; needs python3-venv and PyPI
	@build/ruff/bin/ruff check .
	@build/ruff/bin/ruff format --check .

format: build/ruff/bin/ruff  ## mend what the linter can mend
	@build/ruff/bin/ruff check --fix .
	@build/ruff/bin/ruff format .

build/ruff/bin/ruff: Makefile
	@$(PYTHON) -m venv build/ruff
	@build/ruff/bin/pip install --quiet --disable-pip-version-check $(RUFF)
	@touch $@

benchmark: packages  ## print measured figures beside their limits
	@set -e; for script in benchmarks/*.py; do echo "== $$script"; $(PYTHON) "$$script"; done

tutorial: packages  ## work through the tutorial in FreeCAD's window and refresh its pictures
	@rm -rf build/pictures/tutorial
	@# Those of docs are compared once they are there.
	@$(PYTHON) -m pytest -q tests/test_tutorial_window.py -k "not every_picture"
	@rm -rf docs/images/tutorial
	@mkdir -p docs/images/tutorial/dark
	@cp build/pictures/tutorial/*.png docs/images/tutorial/
	@cp build/pictures/tutorial/dark/*.png docs/images/tutorial/dark/

translations:  ## bring the translations up to the sources; needs qttools5-dev-tools
	@$(PYTHON) scripts/translations.py

check-structure: packages  ## the layers and the page of findings, in seconds
	@$(PYTHON) -m pytest -q tests/test_layers.py tests/test_findings_table.py

coverage: packages build/coverage/bin/coverage  ## branch coverage of core by every test; at least 95 %
	@build/coverage/bin/coverage run --branch --source=BendTorsionWB/core --data-file=build/coverage/data \
		-m pytest -q $(COVERED)
	@build/coverage/bin/coverage report --data-file=build/coverage/data --skip-covered --sort=cover \
		--fail-under=95

build/coverage/bin/coverage: Makefile
	@$(PYTHON) -m venv --system-site-packages build/coverage
	@build/coverage/bin/pip install --quiet --disable-pip-version-check coverage==7.6.4
	@touch $@

mutants: packages  ## small faults set into the kernel: does a test notice each
	@$(PYTHON) scripts/mutants.py

release: packages  ## make the add-on archive and try it in a clean FreeCAD user folder
	@$(PYTHON) scripts/release.py

findings:  ## write docs/findings.md: every finding with what mends it; list those without Chinese
	@$(PYTHON) scripts/findings_table.py
	@$(PYTHON) scripts/findings_texts.py

packages:
	@sh scripts/install-debian.sh

clean:  ## remove everything that can be made again
	@rm -rf build
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +
