# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a task panel says what the checks find: below its fields, bounded, scrolled, foldable."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from BendTorsionWB.gui.qt import QtCore, QtWidgets
from BendTorsionWB.gui.scrolled_text import ScrolledText

MOST_LINES = 9
"""Lines of text seen at once; more are scrolled, so that fields keep their places."""


class FindingsBox(QtWidgets.QWidget):
    """A heading, which a click folds and unfolds, and the lines below it."""

    folded = False
    """As the user left it, from panel to panel."""

    def __init__(self):
        super().__init__()
        self.heading = QtWidgets.QToolButton()
        self.heading.setObjectName("findings heading")
        self.heading.setAutoRaise(True)
        self.heading.setToolButtonStyle(QtCore.Qt.ToolButtonTextBesideIcon)
        self.heading.clicked.connect(lambda: self.fold(not FindingsBox.folded))
        self.area = ScrolledText(MOST_LINES)
        self.lines = self.area.label
        self.lines.setObjectName("findings")
        layout = QtWidgets.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(2)
        layout.addWidget(self.heading, 0, QtCore.Qt.AlignLeft)
        layout.addWidget(self.area)
        self.errors: list[str] = []
        self.timer = QtCore.QTimer(self)
        self.timer.setSingleShot(True)
        self.timer.timeout.connect(self._reveal)
        self.tell(())

    def tell(self, lines: Iterable[str], heading: str = "", errors: Sequence[str] = ()) -> None:
        """Show lines (HTML); without a heading they cannot be folded. errors: those of the lines
        that must be seen; new ones are brought into view."""
        if set(errors) - set(self.errors):
            # Once the panel has grown with them.
            self.timer.start(0)
        self.errors = list(errors)
        self.lines.setText("".join(f'<p style="margin: 0 0 3px 0">{line}</p>' for line in lines))
        self.heading.setText(heading)
        self.heading.setVisible(bool(heading))
        self._show()

    def fold(self, folded: bool) -> None:
        """Show the heading alone, or the lines too."""
        FindingsBox.folded = folded
        self._show()

    def _reveal(self) -> None:
        """Scroll the panel to the lines, as far as the field that is typed into stays in view;
        where both have no room the first error stands at the field."""
        area = self.parentWidget()
        while area is not None and not isinstance(area, QtWidgets.QScrollArea):
            area = area.parentWidget()
        if area is None or not self.isVisible() or not self.errors:
            return
        area.ensureWidgetVisible(self, 0, self.heading.height())
        field = QtWidgets.QApplication.focusWidget()
        if field is None or not area.isAncestorOf(field):
            return
        area.ensureWidgetVisible(field, 0, 0)
        if self.visibleRegion().isEmpty():
            place = field.mapToGlobal(QtCore.QPoint(0, field.height()))
            QtWidgets.QToolTip.showText(place, self.errors[0], field)

    def _show(self) -> None:
        hidden = FindingsBox.folded and bool(self.heading.text())
        self.heading.setArrowType(QtCore.Qt.RightArrow if hidden else QtCore.Qt.DownArrow)
        self.area.setVisible(not hidden)
        self.area.fit()
