# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lines of text as high as they need up to a bound, and scrolled beyond it."""

from __future__ import annotations

from BendTorsionWB.gui.qt import QtCore, QtWidgets


class ScrolledText(QtWidgets.QScrollArea):
    """Shows the text of `label`; most: the lines seen at once. `fit` when the text is another."""

    def __init__(self, most: int):
        super().__init__()
        self.most = most
        self.label = QtWidgets.QLabel()
        self.label.setWordWrap(True)
        self.label.setAlignment(QtCore.Qt.AlignLeft | QtCore.Qt.AlignTop)
        self.setWidget(self.label)
        self.setWidgetResizable(True)
        self.setFrameShape(QtWidgets.QFrame.NoFrame)
        self.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarAlwaysOff)
        # A long line is no reason to widen what it stands in.
        self.setSizePolicy(QtWidgets.QSizePolicy.Ignored, QtWidgets.QSizePolicy.Fixed)
        # On the ground of what it stands in, whatever colour that has.
        self.label.setAutoFillBackground(False)
        self.viewport().setAutoFillBackground(False)

    def fit(self) -> None:
        """Take the height the text needs, up to the bound."""
        height = self.label.heightForWidth(self.width()) if self.label.text() else 0
        most = self.most * self.label.fontMetrics().lineSpacing()
        self.setFixedHeight(min(height, most))
        # What has nothing to scroll is not stopped at by Tab.
        policy = QtCore.Qt.StrongFocus if height > most else QtCore.Qt.NoFocus
        self.setFocusPolicy(policy)

    def resizeEvent(self, event):
        """Lines wrap at another width, and are more or fewer."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.fit()
