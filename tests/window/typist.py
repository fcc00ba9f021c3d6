# SPDX-License-Identifier: LGPL-2.1-or-later
"""Real keys of the X server. Run by itself it types beside FreeCAD, as hands do, whatever FreeCAD
is busy with: seconds between keys, then texts, keys by their X names as `@Tab`, and clicks at a
pixel of the screen as `@500,300`."""

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


def main(gap, *texts):
    """Type it."""
    for text in texts:
        for name in [text[1:]] if text[:1] == "@" else text:
            if "," in name and len(name) > 1:
                click(*map(int, name.split(",")))
            else:
                hit(NAMES.get(name, name))
            time.sleep(float(gap))


if __name__ == "__main__":
    main(*sys.argv[1:])
