# SPDX-License-Identifier: LGPL-2.1-or-later
# Part's library crashes the interpreter when it is loaded before FreeCAD's (0.20).
import FreeCAD  # noqa: F401
