# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mutation checks on the kernel: small faults set into its modules one by one, each of which a test
must notice.

cosmic-ray (from PyPI, in build/mutants) makes the mutants in a copy of the checkout; of each module
an even sample is tried. The survivors are printed with their lines.
"""

import argparse
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HOME = ROOT / "build" / "mutants"
COPY = HOME / "checkout"
LIBRARY = "cosmic-ray==8.7.0"
TIME_LIMIT = 120.0

# The kernel, and the tests that ought to notice a fault in it.
KERNEL = {
    "geometry/piecewise.py": ("test_piecewise.py", "test_frames.py", "test_skin_volume.py"),
    "geometry/curve.py": ("test_curve.py", "test_axis.py"),
    "axes/frames_minimal.py": ("test_frames.py", "test_frames_kinds.py"),
    "axes/frames.py": ("test_frames.py", "test_frames_kinds.py"),
    "members/cells.py": (
        *("test_cells.py", "test_zones.py", "test_zone_table.py", "test_surface_alignment.py"),
        *("test_skin_volume.py", "test_plates.py", "test_detailing.py", "test_thickness.py"),
    ),
    "members/mitres.py": ("test_strips.py", "test_thickness.py", "test_mathematics.py"),
    "members/strips.py": ("test_strips.py", "test_plates.py"),
    "members/volume.py": ("test_skin_volume.py", "test_strips.py"),
    "flattening/development.py": ("test_development.py", "test_development_modes.py"),
    "flattening/locate.py": ("test_development_modes.py", "test_openings.py"),
    "patterns/outline.py": ("test_pattern.py", "test_dxf.py"),
}


def run(*command, **options):
    """Run a command in the copy; its output. SystemExit with its last lines when it fails."""
    done = subprocess.run(
        command, cwd=COPY, capture_output=True, encoding="utf-8", check=False, **options
    )
    if done.returncode:
        sys.exit(f"{' '.join(command)}\n{(done.stdout + done.stderr)[-3000:]}")
    return done.stdout


def prepare():
    """cosmic-ray installed, and a fresh copy of what git keeps."""
    stamp = HOME / ".installed"
    if not stamp.is_file() or stamp.read_text(encoding="utf-8") != LIBRARY:
        HOME.mkdir(parents=True, exist_ok=True)
        subprocess.run(
            [sys.executable, "-m", "venv", "--system-site-packages", HOME / "venv"], check=True
        )
        pip = [HOME / "venv" / "bin" / "pip", "install", "--quiet"]
        subprocess.run([*pip, "--disable-pip-version-check", LIBRARY], check=True)
        stamp.write_text(LIBRARY, encoding="utf-8")
    shutil.rmtree(COPY, ignore_errors=True)
    names = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard", "-z"],
        cwd=ROOT,
        capture_output=True,
        check=True,
    ).stdout.decode()
    for name in filter(None, names.split("\0")):
        if (ROOT / name).is_file():
            (COPY / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, COPY / name)


def thinned(session, count):
    """Leave `count` mutants of a session, evenly spread over the module; those on annotations and
    texts aside, which no test can notice."""
    from cosmic_ray.work_db import WorkDB, use_db
    from cosmic_ray.work_item import WorkerOutcome, WorkResult

    with use_db(str(session), WorkDB.Mode.open) as database:
        items = sorted(database.pending_work_items, key=lambda item: item.mutations[0].start_pos)
        items = [item for item in items if "Annotation" not in item.mutations[0].operator_name]
        wanted = {items[i * len(items) // count].job_id for i in range(min(count, len(items)))}
        for item in list(database.pending_work_items):
            if item.job_id not in wanted:
                database.set_result(item.job_id, WorkResult(worker_outcome=WorkerOutcome.SKIPPED))


def tried(session):
    """(killed, [(line, operator, the line mutated)]) of a session that ran."""
    from cosmic_ray.work_db import WorkDB, use_db
    from cosmic_ray.work_item import TestOutcome, WorkerOutcome

    killed, survived = 0, []
    with use_db(str(session), WorkDB.Mode.open) as database:
        for item, result in database.completed_work_items:
            if result.worker_outcome != WorkerOutcome.NORMAL:
                continue
            if result.test_outcome == TestOutcome.SURVIVED:
                diff = [line for line in (result.diff or "").splitlines() if line[:1] == "+"]
                change = item.mutations[0]
                survived.append((change.start_pos[0], change.operator_name, diff[-1][1:].strip()))
            else:
                killed += 1
    return killed, sorted(survived)


def main():
    """Try the kernel; 0 when the share killed is at least what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--each", type=int, default=12, help="mutants of each module")
    parser.add_argument("--only", default="", help="one module of the kernel")
    parser.add_argument("--least", type=float, default=0.0, help="share that must be noticed")
    options = parser.parse_args()
    prepare()
    libraries = next((HOME / "venv" / "lib").glob("python3*")) / "site-packages"
    sys.path.insert(0, str(libraries))
    killed, survivors = 0, []
    for module, tests in KERNEL.items():
        if options.only not in module:
            continue
        stem = module.replace("/", "-").removesuffix(".py")
        config, session = HOME / f"{stem}.toml", HOME / f"{stem}.sqlite"
        session.unlink(missing_ok=True)
        asked = " ".join(f"tests/{name}" for name in tests)
        config.write_text(
            "[cosmic-ray]\n"
            f'module-path = "BendTorsionWB/core/{module}"\n'
            f"timeout = {TIME_LIMIT}\n"
            "excluded-modules = []\n"
            f'test-command = "{sys.executable} -m pytest -x -q -p no:cacheprovider {asked}"\n'
            '[cosmic-ray.distributor]\nname = "local"\n',
            encoding="utf-8",
        )
        ray = str(HOME / "venv" / "bin" / "cosmic-ray")
        run(ray, "baseline", str(config))
        run(ray, "init", str(config), str(session))
        thinned(session, options.each)
        run(ray, "exec", str(config), str(session))
        own, lived = tried(session)
        killed += own
        survivors += [(module, *what) for what in lived]
        print(f"{module}: {own} noticed, {len(lived)} not", flush=True)
    for module, line, operator, text in survivors:
        print(f"  {module}:{line} {operator.split('/')[-1]}: {text}")
    share = killed / max(killed + len(survivors), 1)
    print(f"{killed} of {killed + len(survivors)} mutants noticed: {100 * share:.0f} %")
    return 0 if share >= options.least else 1


if __name__ == "__main__":
    sys.exit(main())
