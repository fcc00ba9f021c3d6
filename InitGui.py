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
        import FreeCADGui

        from BendTorsionWB.gui import (
            commands,
            copied,
            page_windows,
            preferences_page,
            resources,
            status_text,
            undone,
        )

        FreeCADGui.addLanguagePath(str(resources.FOLDER / "translations"))
        FreeCADGui.updateLocale()
        FreeCADGui.addIconPath(str(resources.FOLDER / "icons"))
        FreeCADGui.addPreferencePage(preferences_page.PreferencesPage, "BendTorsion")
        FreeCADGui.addPreferencePage(preferences_page.OutputPage, "BendTorsion")
        commands.register()
        commands.lay_out(self)
        status_text.watch()
        undone.watch()
        copied.watch()
        page_windows.watch()

    def ContextMenu(self, recipient):
        """Offer what suits the selection, in the 3D view and in the tree."""
        from BendTorsionWB.gui import commands

        names = commands.suited()
        if names:
            self.appendContextMenu("BendTorsion", names)

    def GetClassName(self):
        """The C++ class FreeCAD wraps a Python workbench in."""
        return "Gui::PythonWorkbench"


Gui.addWorkbench(BendTorsionWorkbench())
