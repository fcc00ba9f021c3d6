# SPDX-License-Identifier: LGPL-2.1-or-later
"""Recompute so that no key is lost: what is typed meanwhile waits and arrives afterwards.

FreeCAD shows a progress bar while a document is recomputed, and until it is gone throws away every
key and click of the window; it shows none where recomputing cannot be stopped by Esc.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import FreeCADGui

from BendTorsionWB.gui.qt import QtCore, QtGui, QtWidgets
from BendTorsionWB.objects.preference import preference

PASSES = 4
"""Objects may make others, as sheets their pages."""
PATIENCE = 0.7
"""Seconds of work before the window looks for Esc."""


AGAIN = 100
"""Milliseconds until a document is looked at again that was being computed."""


def keys_kept():
    """FreeCAD shows no progress bar of its own inside; the user's preference is as before then."""
    return preference("Document", "CanAbortRecompute", False)


def recompute(document) -> None:
    """Recompute a document; keys wait."""
    with keys_kept():
        document.recompute()


def recompute_each(document, progress: Callable[[str, int, int], None]) -> None:
    """Recompute what is touched and what follows from it, one by one in turn; progress
    (`project.Progress`) is told before each, and may raise to stop."""
    done: set[str] = set()
    for _ in range(PASSES):
        waiting = [obj for obj in _touched(document) if obj.Name not in done]
        if not waiting:
            break
        for count, obj in enumerate(waiting):
            progress(obj.Label, count, len(waiting))
            obj.recompute()
            obj.purgeTouched()
            done.add(obj.Name)
        progress("", len(waiting), len(waiting))
    recompute(document)


def touched_in(document) -> set[str]:
    """Names of the objects that ask to be computed."""
    return {obj.Name for obj in document.Objects if "Touched" in obj.State}


def untouch(document, but: set[str]) -> None:
    """Let no object ask to be computed but those named: values that are brought back, results among
    them, ask for it though they are as they were computed."""
    for name in touched_in(document) - but:
        document.getObject(name).purgeTouched()


def _touched(document) -> list:
    """What is to be computed, each after what it depends on."""
    names = set()
    for name in touched_in(document):
        if name not in names:
            obj = document.getObject(name)
            names.update(one.Name for one in (obj, *obj.InListRecursive))
    return [obj for obj in reversed(document.TopologicalSortedObjects) if obj.Name in names]


class Stopped(Exception):
    """Esc was pressed, or Cancel."""


class HeldInput(QtCore.QObject):
    """Holds what is typed and clicked while the window shows how far work is; `report` (a
    `project.Progress`) raises Stopped after Esc, or a click that `stops` is true of (a point of the
    screen). `release` lets all else arrive, as if typed then, and asks the window again to close
    when it was told to: FreeCAD's question is never answered while work goes on."""

    def __init__(self, show: Callable[[str, int, int], None], stops: Callable):
        super().__init__()
        self.show, self.stops = show, stops
        self.started = time.monotonic()
        self.stopped = self.closes = False
        self.held: list[tuple] = []
        QtWidgets.QApplication.instance().installEventFilter(self)

    def report(self, what: str, done: int, count: int) -> None:
        """Show how far it is once it lasts, and look for Esc."""
        if time.monotonic() - self.started < PATIENCE:
            return
        self.show(what, done, count)
        QtWidgets.QApplication.processEvents()
        if self.stopped:
            raise Stopped

    def release(self) -> None:
        """Let what was held arrive in turn; nothing of it once the work was stopped."""
        QtWidgets.QApplication.instance().removeEventFilter(self)
        for receiver, event in () if self.stopped else self.held:
            QtWidgets.QApplication.postEvent(receiver, event)
        self.held = []
        if self.closes and not self.stopped:
            QtCore.QTimer.singleShot(0, FreeCADGui.getMainWindow().close)

    def eventFilter(self, receiver, event):
        """Called by Qt before anything of the program has the event."""
        if not isinstance(event, QtCore.QEvent):
            return False
        kind = event.type()
        if kind == QtCore.QEvent.ShortcutOverride:
            # No shortcut: it comes again as a key.
            event.accept()
            return True
        if kind == QtCore.QEvent.Close:
            self.closes = self.closes or _is_main(receiver)
            event.ignore()
            return True
        if not isinstance(receiver, QtGui.QWindow):
            return False
        if kind in (QtCore.QEvent.KeyPress, QtCore.QEvent.KeyRelease):
            if event.key() == QtCore.Qt.Key_Escape:
                self.stopped = True
            else:
                self.held.append((receiver, _key(event)))
            return True
        if kind in MOUSE:
            if kind == QtCore.QEvent.MouseButtonPress and self.stops(event.globalPos()):
                self.stopped = True
            self.held.append((receiver, _click(event)))
            return True
        return kind == QtCore.QEvent.Wheel


MOUSE = (
    QtCore.QEvent.MouseButtonPress,
    QtCore.QEvent.MouseButtonRelease,
    QtCore.QEvent.MouseButtonDblClick,
)


def _is_main(receiver) -> bool:
    """Whether an event is of FreeCAD's window, by itself or as the system knows it."""
    main = FreeCADGui.getMainWindow()
    return receiver == main or receiver == main.windowHandle()


def _key(event):
    return QtGui.QKeyEvent(
        event.type(),
        event.key(),
        event.modifiers(),
        event.text(),
        event.isAutoRepeat(),
        event.count(),
    )


def _click(event):
    return QtGui.QMouseEvent(
        event.type(),
        event.localPos(),
        event.windowPos(),
        event.screenPos(),
        event.button(),
        event.buttons(),
        event.modifiers(),
    )
