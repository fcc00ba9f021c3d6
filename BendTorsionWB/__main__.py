# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line: build and check schedules."""

from __future__ import annotations

import argparse
import os
import sys
import traceback
from importlib.util import find_spec

from BendTorsionWB import __version__, freecad_path
from BendTorsionWB.core.finding import BendTorsionError

GOOD, FAILED, INVALID = 0, 1, 2
SHOWN_WARNINGS = 8


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; returns 0 when all is good, 1 when members failed or files could not
    be written, 2 when the schedule is invalid and nothing was written."""
    options = _parser().parse_args(arguments)
    # Qt orders XML attributes by a seed it draws at the start; files must not depend on it.
    os.environ.setdefault("QT_HASH_SEED", "0")
    freecad_path.append()
    try:
        import FreeCAD  # noqa: F401
    except ImportError:
        print(freecad_path.missing(), file=sys.stderr)
        return INVALID
    for package in ("numpy", "scipy", "ezdxf", "openpyxl"):
        if find_spec(package) is None:
            print(
                f"{package} is not installed for {sys.executable}: on Debian run 'apt-get "
                f"install python3-{package}' and use /usr/bin/python3",
                file=sys.stderr,
            )
            return INVALID
    try:
        return options.run(options)
    except BendTorsionError as problem:
        _end_progress()
        for finding in problem.findings:
            print(finding.line(), file=sys.stderr)
        unwritten = any(finding.code == "file-not-written" for finding in problem.findings)
        return FAILED if unwritten else INVALID
    except Exception as problem:  # noqa: BLE001 - the last fence before the user
        _end_progress()
        if options.debug:
            traceback.print_exc()
        print(
            f"error: unexpected {type(problem).__name__}: {problem} -> run again with --debug "
            "and report what it prints",
            file=sys.stderr,
        )
        return FAILED
    except KeyboardInterrupt:
        _end_progress()
        print("stopped; files already written are whole", file=sys.stderr)
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python3 -m BendTorsionWB",
        description="Detailing of box members that bend and twist in space.",
    )
    parser.add_argument("--version", action="version", version=f"BendTorsion {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    build = commands.add_parser("build", help="build a schedule into a folder")
    build.add_argument("schedule", help="the schedule workbook (.xlsx)")
    build.add_argument("--out", required=True, metavar="DIR", help="folder for the results")
    build.set_defaults(run=_build)
    check = commands.add_parser("check", help="check a schedule, write nothing")
    check.add_argument("schedule", help="the schedule workbook (.xlsx)")
    check.set_defaults(run=_check)
    for command in (build, check):
        command.add_argument("--debug", action="store_true", help="print where a fault arose")
        command.add_argument("--only", default="", metavar="M1,M2", help="only these members")
        command.add_argument(
            "--jobs", type=_count, default=None, metavar="N", help="worker processes (all cores)"
        )
    return parser


def _count(text: str) -> int:
    value = int(text) if text.isdecimal() else 0
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 up")
    return value


def _members(options) -> list[str]:
    return [name.strip() for name in options.only.split(",") if name.strip()]


def _build(options) -> int:
    from BendTorsionWB import project
    from BendTorsionWB.exchange import report
    from BendTorsionWB.sheets.pdf import start_qt

    start_qt()
    result = project.build(
        options.schedule, options.out, _members(options), options.jobs, _progress
    )
    _end_progress()
    for finding in result.findings:
        if finding.severity == "error":
            print(finding.line(), file=sys.stderr)
    warnings = sorted(
        (f for f in result.findings if f.severity == "warning"),
        key=lambda f: not f.code.startswith(("axis", "surface")),
    )
    for finding in warnings[:SHOWN_WARNINGS]:
        print(finding.line(), file=sys.stderr)
    if len(warnings) > SHOWN_WARNINGS:
        more = len(warnings) - SHOWN_WARNINGS
        print(f"and {more} more warnings: see results.xlsx, sheet Checks", file=sys.stderr)
    for line in report.summary_lines(result.records, result.findings):
        print(line)
    seconds = ", ".join(f"{name} {spent:.1f}" for name, spent in result.timing.items())
    print(f"{sum(result.timing.values()):.1f} s ({seconds}); results in {options.out}")
    return FAILED if result.failed else GOOD


def _check(options) -> int:
    from BendTorsionWB import project
    from BendTorsionWB.shapes.clash import clashes

    schedule, jobs = project.read_jobs(options.schedule, _members(options))
    with project.pool(options.jobs, len(jobs)) as executor:
        detailed = project.compute(schedule, jobs, executor, _progress)
    _end_progress()
    findings = [f for item in detailed.values() for f in item.record.findings]
    findings += clashes({name: item.geometry for name, item in detailed.items()})
    for finding in dict.fromkeys(findings):
        print(finding.line())
    failed = any(finding.severity == "error" for finding in findings)
    plates = sum(len(item.record.plates) for item in detailed.values())
    print(
        f"{schedule.file}: {len(detailed)} members, {plates} plates, "
        + ("in error" if failed else "good")
    )
    return FAILED if failed else GOOD


_shown = {"width": 0, "what": ""}


def _progress(what: str, done: int, count: int) -> None:
    """One line that is written over on a terminal; one line per stage elsewhere."""
    if sys.stderr.isatty():
        text = f"{what} {done}/{count}"
        print(f"\r{text:<{_shown['width']}}", end="", file=sys.stderr, flush=True)
        _shown["width"] = len(text)
    elif what != _shown["what"]:
        print(f"{what} …", file=sys.stderr, flush=True)
    _shown["what"] = what


def _end_progress() -> None:
    if sys.stderr.isatty() and _shown["width"]:
        print(f"\r{'':<{_shown['width']}}\r", end="", file=sys.stderr, flush=True)
        _shown["width"] = 0


if __name__ == "__main__":
    sys.exit(main())
