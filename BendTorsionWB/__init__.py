# SPDX-License-Identifier: LGPL-2.1-or-later
"""BendTorsion: detailing of box members that bend and twist in space, for FreeCAD."""

__version__ = "0.1.0"
