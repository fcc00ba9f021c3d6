# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD's real window on a virtual screen, with a user profile of its own, driven by a script."""

import json
import os
import signal
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TIME_LIMIT = 120

# The start page is a web view and slow to load; Part is there on every machine.
SETTINGS = """<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<FCParameters>
 <FCParamGroup Name="Root">
  <FCParamGroup Name="BaseApp">
   <FCParamGroup Name="Preferences">
    <FCParamGroup Name="General">
     <FCText Name="AutoloadModule">PartWorkbench</FCText>
     <FCText Name="Language">{language}</FCText>
    </FCParamGroup>
    <FCParamGroup Name="MainWindow">
{style}
    </FCParamGroup>
    <FCParamGroup Name="View">
     <FCBool Name="Gradient" Value="{gradient}"/>
     <FCBool Name="Simple" Value="{simple}"/>
     <FCUInt Name="BackgroundColor" Value="{background}"/>
    </FCParamGroup>
   </FCParamGroup>
  </FCParamGroup>
 </FCParamGroup>
</FCParameters>
"""
LIGHT = {"dark": False, "gradient": 1, "simple": 0, "background": 0}
DARK = {"dark": True, "gradient": 0, "simple": 1, "background": 0x21252BFF}


def run_in_window(
    script: Path,
    folder: Path,
    look=None,
    language="English",
    time_limit=TIME_LIMIT,
    **environment,
) -> dict:
    """Run a script of tests/window inside FreeCAD's window; the JSON it wrote.

    folder: home of the run, made when missing; what is in `environment` the script reads as
    BENDTORSION_WINDOW_<NAME>. The script gets BENDTORSION_WINDOW_RESULT, the file to write. look:
    LIGHT or DARK. time_limit: seconds until FreeCAD is ended.
    """
    folder.mkdir(parents=True, exist_ok=True)
    folder.chmod(0o700)
    result = folder / "result.json"
    everything = {
        **os.environ,
        "HOME": str(folder),
        "XDG_DATA_HOME": str(folder / "share"),
        "XDG_CONFIG_HOME": str(folder / "config"),
        "XDG_RUNTIME_DIR": str(folder),
        "FREECAD_USER_HOME": str(folder / "freecad"),
        "QTWEBENGINE_DISABLE_SANDBOX": "1",
        "PYTHONPATH": "",
        "BENDTORSION_WINDOW_RESULT": str(result),
        **{f"BENDTORSION_WINDOW_{name.upper()}": str(given) for name, given in environment.items()},
    }
    everything.pop("QT_QPA_PLATFORM", None)
    # What `make install` does (test_package.py), without asking for Debian's packages each time.
    (folder / "freecad" / "Mod").mkdir(parents=True, exist_ok=True)
    (folder / "freecad" / "Mod" / "BendTorsion").symlink_to(ROOT)
    # FreeCAD 1.1 has another name for it.
    if language == "Chinese Simplified" and release() >= (1, 1):
        language = "Chinese (Simplified)"
    look = look or LIGHT
    settings = SETTINGS.format(language=language, style=_style(look["dark"]), **look)
    (folder / "freecad" / "user.cfg").write_text(settings, encoding="utf-8")
    command = ["xvfb-run", "-a", "-s", "-screen 0 1920x1200x24", "freecad", str(script)]
    with open(folder / "log.txt", "w+", encoding="utf-8", errors="replace") as log:
        process = subprocess.Popen(
            command,
            env=everything,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            process.wait(timeout=time_limit)
        except subprocess.TimeoutExpired:
            pass
        finally:
            _end(process)
        log.seek(0)
        assert result.exists(), f"FreeCAD wrote no result:\n{log.read()[-4000:]}"
    return json.loads(result.read_text(encoding="utf-8"))


def session(name: str, tmp_path_factory, **given) -> dict:
    """What tests/window/<name>_session.py saw; its pictures are in build/pictures/<name>. given: of
    `run_in_window`."""
    script = ROOT / "tests" / "window" / f"{name}_session.py"
    pictures = ROOT / "build" / "pictures" / name
    given = {"time_limit": 400, "pictures": pictures, **given}
    return run_in_window(script, tmp_path_factory.mktemp(name), **given)


def step(window: dict, name: str):
    """What a step of a session saw; fails with its traceback when it broke off."""
    assert "failed" not in window[name], window[name]["failed"]
    return window[name]


def release() -> tuple[int, int]:
    """Of the FreeCAD that is installed, such as (0, 20)."""
    import FreeCAD

    return tuple(int(number) for number in FreeCAD.Version()[:2])


def _style(dark: bool) -> str:
    """The lines of settings for FreeCAD's own dark look, or for none: its name changed twice."""
    named = {"StyleSheet": "", "Theme": ""}
    if dark and release() >= (1, 1):
        named = {"StyleSheet": "FreeCAD.qss", "Theme": "FreeCAD Dark", "QtStyle": "FreeCAD"}
    elif dark and release() >= (1, 0):
        named = {"StyleSheet": "FreeCAD Dark.qss", "Theme": "FreeCAD Dark"}
    elif dark:
        named = {"StyleSheet": "Behave-dark.qss", "Theme": "Behave-dark.qss"}
    return "\n".join(f'     <FCText Name="{key}">{value}</FCText>' for key, value in named.items())


def _end(process):
    """End the whole process group: xvfb-run, its screen and FreeCAD."""
    for sign in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, sign)
            process.wait(timeout=5)
        except ProcessLookupError:
            return
        except subprocess.TimeoutExpired:
            continue
