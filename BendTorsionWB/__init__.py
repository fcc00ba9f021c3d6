# SPDX-License-Identifier: LGPL-2.1-or-later
"""BendTorsion: detailing of box members that bend and twist in space, for FreeCAD."""

import os
import sys

__version__ = "0.1.0"

# How many threads BLAS has changes last digits, and with them files, from machine to machine; for
# matrices as small as ours they only spin. FreeCAD's window is shared with other workbenches.
if "numpy" not in sys.modules and "FreeCADGui" not in sys.modules:
    for _name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS"):
        os.environ[_name] = "1"
