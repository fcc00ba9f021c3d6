# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD runs this at every start, window or not. Nothing to register yet."""
