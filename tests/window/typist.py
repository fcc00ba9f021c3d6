# SPDX-License-Identifier: LGPL-2.1-or-later
"""Real keys of the X server. Run by itself it types beside FreeCAD, as hands do, whatever FreeCAD
is busy with: seconds between keys, then texts, keys by their X names as `@Tab`, clicks at a pixel
of the screen as `@500,300`, and windows told to close, as by their button, as `@close:1234`."""

import ctypes
import sys
import time

X11, TEST = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
X11.XOpenDisplay.restype = ctypes.c_void_p
X11.XStringToKeysym.restype = ctypes.c_ulong
X11.XKeysymToKeycode.argtypes = (ctypes.c_void_p, ctypes.c_ulong)
X11.XKeycodeToKeysym.argtypes = (ctypes.c_void_p, ctypes.c_ubyte, ctypes.c_int)
X11.XKeycodeToKeysym.restype = ctypes.c_ulong
X11.XSync.argtypes = (ctypes.c_void_p, ctypes.c_int)
TEST.XTestFakeKeyEvent.argtypes = (
    *(ctypes.c_void_p, ctypes.c_uint, ctypes.c_int),
    ctypes.c_ulong,
)
TEST.XTestFakeButtonEvent.argtypes = TEST.XTestFakeKeyEvent.argtypes
TEST.XTestFakeMotionEvent.argtypes = (
    *(ctypes.c_void_p, ctypes.c_int, ctypes.c_int, ctypes.c_int),
    ctypes.c_ulong,
)
X11.XInternAtom.argtypes = (ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int)
X11.XInternAtom.restype = ctypes.c_ulong
X11.XSendEvent.argtypes = (
    *(ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int, ctypes.c_long),
    ctypes.c_void_p,
)
DISPLAY = X11.XOpenDisplay(None)
NAMES = {" ": "space", ".": "period", "+": "plus", ",": "comma", "-": "minus", ";": "semicolon"}
NAMES |= {"*": "asterisk", "/": "slash", "=": "equal", "(": "parenleft", ")": "parenright"}


def hit(name):
    """One key by its X name with its modifiers, `Shift_L+Down`; Shift is held where it needs it."""
    codes = []
    for part in name.split("+"):
        symbol = X11.XStringToKeysym(part.encode())
        code = X11.XKeysymToKeycode(DISPLAY, symbol)
        if X11.XKeycodeToKeysym(DISPLAY, code, 0) != symbol:
            codes.append(X11.XKeysymToKeycode(DISPLAY, X11.XStringToKeysym(b"Shift_L")))
        codes.append(code)
    for code in codes:
        TEST.XTestFakeKeyEvent(DISPLAY, code, 1, 0)
    for code in reversed(codes):
        TEST.XTestFakeKeyEvent(DISPLAY, code, 0, 0)
    X11.XSync(DISPLAY, 0)


def click(x, y):
    """The left button at a pixel of the screen."""
    TEST.XTestFakeMotionEvent(DISPLAY, -1, x, y, 0)
    for down in (1, 0):
        TEST.XTestFakeButtonEvent(DISPLAY, 1, down, 0)
    X11.XSync(DISPLAY, 0)


class Message(ctypes.Structure):
    """What one program tells the window of another (XClientMessageEvent, padded)."""

    _fields_ = (
        ("type", ctypes.c_int),
        ("serial", ctypes.c_ulong),
        ("sent", ctypes.c_int),
        ("display", ctypes.c_void_p),
        ("window", ctypes.c_ulong),
        ("kind", ctypes.c_ulong),
        ("bits", ctypes.c_int),
        ("values", ctypes.c_long * 5),
        ("rest", ctypes.c_long * 16),
    )


def close(window):
    """Tell a window to close, as window managers do."""
    protocols, delete = (
        X11.XInternAtom(DISPLAY, name, 0) for name in (b"WM_PROTOCOLS", b"WM_DELETE_WINDOW")
    )
    message = Message(33, 0, 1, DISPLAY, window, protocols, 32, (delete,))
    X11.XSendEvent(DISPLAY, window, 0, 0, ctypes.byref(message))
    X11.XSync(DISPLAY, 0)


def main(gap, *texts):
    """Type it."""
    for text in texts:
        for name in [text[1:]] if text[:1] == "@" else text:
            if name.startswith("close:"):
                close(int(name.removeprefix("close:")))
            elif "," in name and len(name) > 1:
                click(*map(int, name.split(",")))
            else:
                hit(NAMES.get(name, name))
            time.sleep(float(gap))


if __name__ == "__main__":
    main(*sys.argv[1:])
