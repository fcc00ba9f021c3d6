# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD runs this when its window starts: it lists the workbench and loads nothing else."""


class BendTorsionWorkbench(Workbench):
    """The BendTorsion workbench; its commands are loaded when it is first opened."""

    # FreeCAD executes this file as text: no __file__, and its names are gone once it has run,
    # so the class body and each method import what they use.
    from BendTorsionWB.gui import resources

    MenuText = "BendTorsion"
    ToolTip = "Detailing of box members that bend and twist along curves on a surface"
    Icon = resources.icon("BendTorsion")
    del resources

    def Initialize(self):
        """Register the commands and lay out the toolbar and the menu."""
        from BendTorsionWB.gui import commands

        names = commands.register()
        self.appendToolbar("BendTorsion", names)
        self.appendMenu("&BendTorsion", names)

    def GetClassName(self):
        """The C++ class FreeCAD wraps a Python workbench in."""
        return "Gui::PythonWorkbench"


Gui.addWorkbench(BendTorsionWorkbench())
