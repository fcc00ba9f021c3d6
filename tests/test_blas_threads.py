# SPDX-License-Identifier: LGPL-2.1-or-later
"""The same numbers to the last bit, however many threads BLAS would have: files depend on them."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

FITTED = """
import BendTorsionWB, hashlib, os, sys
sys.path.insert(0, "tests")
from curved_members import tapered
import numpy as np
from BendTorsionWB.core.plates.plates import split_plates
bits = hashlib.sha256()
for plate in split_plates(tapered(), {})[0]:
    bits.update(plate.rails.outer.values.tobytes())
print(bits.hexdigest(), os.environ["OPENBLAS_NUM_THREADS"])
"""


def told(**environment):
    """What a process of its own says of the rails it makes."""
    root = Path(__file__).resolve().parent.parent
    given = {**os.environ, "PYTHONPATH": str(root), **environment}
    command = [sys.executable, "-c", FITTED]
    run = subprocess.run(
        command, cwd=root, env=given, capture_output=True, encoding="utf-8", check=True
    )
    return run.stdout.split()


@pytest.mark.parametrize("threads", ["2", "5"])
def test_the_same_bits_for_any_number_of_threads(threads):
    assert told(OPENBLAS_NUM_THREADS=threads) == told(OPENBLAS_NUM_THREADS="1")


@pytest.mark.parametrize("loaded", ["numpy", "FreeCADGui"])
def test_a_program_that_has_loaded_numpy_keeps_its_threads(loaded):
    """And so does FreeCAD's window, with other workbenches in it."""
    root = Path(__file__).resolve().parent.parent
    given = {**os.environ, "OPENBLAS_NUM_THREADS": "3", "PYTHONPATH": str(root)}
    there = f"import sys, types; sys.modules[{loaded!r}] = types.ModuleType({loaded!r})"
    script = f"{there}\nimport BendTorsionWB, os; print(os.environ['OPENBLAS_NUM_THREADS'])"
    command = [sys.executable, "-c", script]
    run = subprocess.run(command, env=given, capture_output=True, encoding="utf-8", check=True)
    assert run.stdout.strip() == "3"
