# SPDX-License-Identifier: LGPL-2.1-or-later
"""Test set-up: the checkout on the path, and FreeCAD importable as a module."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from BendTorsionWB import freecad_path

freecad_path.append()

from schedule_books import read  # noqa: E402, F401 - a fixture for all tests
