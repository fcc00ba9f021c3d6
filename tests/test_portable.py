# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nothing in the product that only some systems, FreeCADs or libraries have.

Windows cannot be run here, so the sources are read: every use of a module or function that is not
on each system stands in one of the places named below, with what is done where it is not there.
"""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
SOURCES = [ROOT / "Init.py", ROOT / "InitGui.py", *sorted((ROOT / "BendTorsionWB").rglob("*.py"))]
BESIDE = ("tests", "scripts", "benchmarks", "resources")

POSIX_MODULES = {"fcntl", "grp", "pty", "pwd", "resource", "syslog", "termios", "tty", "crypt"}
POSIX_CALLS = {
    *("os.fork", "os.forkpty", "os.kill", "os.killpg", "os.getuid", "os.geteuid", "os.getgid"),
    *("os.chown", "os.mkfifo", "os.mknod", "os.nice", "os.statvfs", "os.sysconf", "os.uname"),
    *("os.setsid", "os.getpgid", "os.getloadavg", "os.sched_getaffinity", "os.waitpid"),
    *("os.symlink", "os.readlink", "os.link", "os.O_NOFOLLOW", "os.O_DIRECTORY"),
    *("signal.SIGKILL", "signal.SIGALRM", "signal.alarm", "signal.SIGHUP", "signal.SIGUSR1"),
    *("signal.setitimer", "signal.pthread_sigmask", "time.tzset"),
}
REMOVED = {
    # numpy 2, and 2.4
    *("np.trapz", "np.in1d", "np.row_stack", "np.product", "np.cumproduct", "np.alltrue"),
    *("np.sometrue", "np.float_", "np.complex_", "np.Inf", "np.NaN", "np.infty", "np.string_"),
    *("np.unicode_", "np.asfarray", "np.find_common_type", "np.cast", "np.msort", "np.round_"),
    # FreeCAD 1.1 crashes in it outside its own programs; Part.Compound does the same
    "Part.makeCompound",
    # Python 3.12 to 3.14
    *("ast.Str", "ast.Num", "pkgutil.find_loader", "locale.getdefaultlocale"),
    *("datetime.datetime.utcnow", "datetime.utcnow", "asyncio.get_event_loop"),
}
REMOVED_MODULES = {"imp", "distutils", "cgi", "pipes", "telnetlib", "crypt", "aifc", "asynchat"}
GUARDED = {
    "exchange/folder_lock.py": {"fcntl"},
    "shapes/trial_reading.py": {"resource"},
    "core/worker_processes.py": {"fcntl"},
}
"""Where a module of POSIX is imported under a guard, with another way beside it."""
FENCED = {
    "shapes/trial_reading.py": "hasattr(os, 'fork')",
    "core/worker_processes.py": "hasattr(signal, 'pthread_sigmask')",
}
"""Where calls of POSIX stand behind a question, and what it asks."""


def used(tree):
    """Dotted names read in a module, and (module, whether under a guard) of what it imports."""
    guarded = {
        id(node)
        for found in ast.walk(tree)
        if isinstance(found, ast.Try | ast.If)
        for node in ast.walk(found)
    }
    names, modules = set(), set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute):
            names.add(ast.unparse(node))
        elif isinstance(node, ast.Import):
            modules |= {(alias.name.split(".")[0], id(node) in guarded) for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            modules.add((node.module.split(".")[0], id(node) in guarded))
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names, modules


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_module_uses_what_every_system_and_release_has(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    names, modules = used(tree)
    place = path.relative_to(ROOT).as_posix().removeprefix("BendTorsionWB/")
    assert names & REMOVED == set()
    if place in FENCED:
        assert FENCED[place] in ast.unparse(tree)
    else:
        assert names & POSIX_CALLS == set()
    imported = {name for name, _ in modules}
    assert imported & REMOVED_MODULES == set()
    assert imported & POSIX_MODULES == GUARDED.get(place, set())
    assert all(guard for name, guard in modules if name in POSIX_MODULES)


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_module_holds_no_path_of_a_system(path):
    """Paths are made of parts; those that begin at a root are FreeCAD's usual places."""
    if path.name in ("freecad_path.py", "trial_reading.py"):
        return
    roots = ("/usr/lib", "/tmp", "/dev/", "/proc/", "/etc/", "/home/", "C:\\")
    found = [
        node.value
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and node.value.startswith(roots)
    ]
    assert found == []


def test_text_files_are_opened_with_their_encoding():
    """Windows would take its own code page, and a library may turn the locale to ASCII. So is read
    what programs print."""
    missing = []
    for path in (*SOURCES, *(path for name in BESIDE for path in (ROOT / name).rglob("*.py"))):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call):
                continue
            name = ast.unparse(node.func)
            words = {keyword.arg for keyword in node.keywords}
            text = name.endswith((".read_text", ".write_text"))
            if name in ("open", "os.fdopen") or name.endswith(".open"):
                mode = [a.value for a in node.args[1:2] if isinstance(a, ast.Constant)]
                mode += [k.value.value for k in node.keywords if k.arg == "mode"]
                text = name in ("open", "os.fdopen") and "b" not in "".join(map(str, mode))
            text |= name.startswith("subprocess.") and "text" in words
            if text and "encoding" not in words:
                missing.append(f"{path.relative_to(ROOT)}:{node.lineno} {name}")
    assert missing == []


def test_the_reader_sees_what_it_looks_for():
    source = "import os, fcntl\nfrom signal import SIGKILL\nos.fork()\nnp.trapz(y)\n"
    names, modules = used(ast.parse(source))
    assert names & (POSIX_CALLS | REMOVED) == {"os.fork", "np.trapz", "signal.SIGKILL"}
    assert ("fcntl", False) in modules
    guarded = used(ast.parse("try:\n    import fcntl\nexcept ImportError:\n    fcntl = None\n"))
    assert ("fcntl", True) in guarded[1]


def test_workers_start_where_there_is_no_fork():
    """As on Windows, and as Python 3.14 starts them: a new interpreter each."""
    from BendTorsionWB.core.parallel import attempts, workers_for

    with workers_for(2, 4, start_method="spawn") as executor:
        found = dict(attempts(abs, {str(k): -k for k in range(4)}, executor))
    assert {name: outcome.value for name, outcome in found.items()} == {str(k): k for k in range(4)}
