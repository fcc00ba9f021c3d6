# BendTorsion: the targets a user or a contributor needs. `make demo` and `make test` suffice.

PYTHON ?= /usr/bin/python3
RUFF = ruff==0.17.6
EXAMPLE = resources/examples/concert_hall/concert_hall.xlsx
DEMO = build/concert_hall
DATA = $(or $(XDG_DATA_HOME),$(HOME)/.local/share)
MOD = $(or $(FREECAD_USER_HOME),$(DATA)/FreeCAD)/Mod

.PHONY: demo test install lint format benchmark packages clean

demo: packages  ## build the concert hall into build/concert_hall
	@$(PYTHON) -m BendTorsionWB build $(EXAMPLE) --out $(DEMO)
	@echo
	@echo "Open the model:    freecad $(DEMO)/model.FCStd"
	@echo "Open the sheets:   $(DEMO)/sheets/*.pdf"
	@echo "Cut files:         $(DEMO)/plates/*.dxf"
	@echo "Lofting data:      $(DEMO)/results.xlsx"

test: packages  ## run every test
	@$(PYTHON) -m pytest

install: packages  ## link this checkout into FreeCAD's Mod folder
	@mkdir -p "$(MOD)"
	@if [ -e "$(MOD)/BendTorsion" ] && [ ! -L "$(MOD)/BendTorsion" ]; then \
		echo "$(MOD)/BendTorsion exists and is not a link: move it away first" >&2; exit 1; fi
	@ln -sfn "$(CURDIR)" "$(MOD)/BendTorsion"
	@echo "Linked $(MOD)/BendTorsion: restart FreeCAD and choose the BendTorsion workbench."

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

packages:
	@sh scripts/install-debian.sh

clean:  ## remove everything that can be made again
	@rm -rf build
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +
