# SPDX-License-Identifier: LGPL-2.1-or-later
"""For scripts that run inside FreeCAD's window: every text a widget shows or tells."""

from PySide import QtCore, QtGui

READ = ("text", "title", "toolTip", "statusTip", "whatsThis", "placeholderText", "windowTitle")
READ += ("suffix", "prefix", "toPlainText")
ROLES = (QtCore.Qt.DisplayRole, QtCore.Qt.ToolTipRole)


def texts_of(widget, but=()):
    """Texts and tooltips of a widget and all in it that can be seen, of tables their headings and
    cells; without what stands in widgets named in `but`."""
    # Kept: with what it takes for the widget above PySide lets go of the widget, too.
    found, beyond = [], widget.parentWidget()
    for item in (widget, *widget.findChildren(QtGui.QWidget)):
        names = [item.objectName()]
        above = item.parentWidget()
        while above is not None and above is not beyond:
            names.append(above.objectName())
            above = above.parentWidget()
        if not item.isVisibleTo(widget) or set(names) & set(but):
            continue
        found += [getattr(item, name)() for name in READ if hasattr(item, name)]
        found += [action.text() for action in item.actions()]
        if isinstance(item, QtGui.QComboBox):
            found += [item.itemText(k) for k in range(item.count())]
        if isinstance(item, QtGui.QTabBar):
            found += [item.tabText(k) for k in range(item.count())]
        if isinstance(item, QtGui.QTableWidget):
            found += cells_of(item)
        if isinstance(item, QtGui.QGraphicsView) and item.scene() is not None:
            found += [i.toolTip() for i in item.scene().items()]
            found += [i.text() for i in item.scene().items() if hasattr(i, "text")]
    return plain(found)


def cells_of(table):
    """Headings and cells of a table, with their tooltips."""
    heads = [table.horizontalHeaderItem(c) for c in range(table.columnCount())]
    items = [table.item(r, c) for r in range(table.rowCount()) for c in range(table.columnCount())]
    return [t for i in (*heads, *items) if i is not None for t in (i.text(), i.toolTip())]


def model_texts(model, above=None):
    """What the rows of a model below an index show and tell: first columns only."""
    above = above or QtCore.QModelIndex()
    found = []
    for row in range(model.rowCount(above)):
        index = model.index(row, 0, above)
        found.append([str(model.data(index, role) or "") for role in ROLES])
        if model.rowCount(index) and not above.isValid():
            found += model_texts(model, index)
    return found


def menu_texts(menu):
    """Texts of a menu's actions and of those of its submenus."""
    found = [menu.title()]
    for action in menu.actions():
        found += [action.text(), action.toolTip(), action.statusTip()]
        if action.menu() is not None:
            found += menu_texts(action.menu())
    return plain(found)


def plain(texts):
    """Each text once, without empty ones."""
    return sorted({str(text) for text in texts if text and str(text).strip()})
