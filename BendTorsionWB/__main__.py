# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line: from schedules to files, and back."""

from __future__ import annotations

import atexit
import os
import sys
from contextlib import ExitStack, nullcontext, suppress

from BendTorsionWB import interrupts

STOPPED = "stopped; files already written are whole"
INTERRUPTED = 130


def _told(kind, problem, trace) -> None:
    """What Python prints of an exception nobody caught: one line of Ctrl-C."""
    if issubclass(kind, KeyboardInterrupt) or interrupts.asked():
        print(STOPPED, file=sys.stderr)
        _leave()
    else:
        sys.__excepthook__(kind, problem, trace)


def _swallowed(raised) -> None:
    """What Python prints of an exception that cannot be raised: an interrupt is, later on, also one
    that a call from C made a fault of its own."""
    one = raised.exc_value
    while one is not None and not isinstance(one, KeyboardInterrupt):
        one = one.__cause__ or one.__context__
    if one is None and not issubclass(raised.exc_type, KeyboardInterrupt):
        sys.__unraisablehook__(raised)


def _leave() -> None:
    """End with the exit code of an interrupt. By itself Python ends by the signal when FreeCAD has
    swallowed one in Python it ran."""
    atexit._run_exitfuncs()
    with suppress(OSError):
        sys.stdout.flush()
        sys.stderr.flush()
    os._exit(INTERRUPTED)


if __name__ == "__main__":
    # Before the imports below: they take a moment, in which Ctrl-C may come.
    sys.excepthook, sys.unraisablehook = _told, _swallowed
    ExitStack().enter_context(interrupts.heard())

import logging  # noqa: E402
import traceback  # noqa: E402
from importlib.util import find_spec  # noqa: E402
from warnings import catch_warnings, simplefilter  # noqa: E402

from BendTorsionWB import arguments, freecad_path  # noqa: E402
from BendTorsionWB.console import Progress, print_findings  # noqa: E402
from BendTorsionWB.core.collection import leave_to_the_end  # noqa: E402
from BendTorsionWB.core.finding import BendTorsionError  # noqa: E402
from BendTorsionWB.exchange.issued_folder import refuse_issued  # noqa: E402
from BendTorsionWB.exchange.outside_files import outside_allowed  # noqa: E402
from BendTorsionWB.standard_output import OutputLost, watched  # noqa: E402

GOOD, FAILED, INVALID = 0, 1, 2

_progress = Progress()


def main(given: list[str] | None = None) -> int:
    """Run the command line; returns 0 when all is good, 1 when members failed or files could not
    be written, 2 when the schedule is invalid and nothing was written, 130 when it was told to
    stop, 141 when what reads its output has closed it."""
    try:
        with interrupts.heard(), watched():
            try:
                code = _run(given)
                interrupts.stop_if_asked()
                return code
            except KeyboardInterrupt:
                _close_documents()
                _progress.end()
                print(STOPPED, file=sys.stderr)
                return INTERRUPTED
    except OutputLost as lost:
        _close_documents()
        return lost.told()


def _close_documents() -> None:
    """Whatever was being opened or made; each has a temporary folder."""
    freecad = sys.modules.get("FreeCAD")
    for name in list(freecad.listDocuments()) if freecad else ():
        if name in freecad.listDocuments():
            freecad.closeDocument(name)


def _run(given: list[str] | None) -> int:
    options = arguments.parser().parse_args(given)
    # Qt orders XML attributes by a seed it draws at the start; files must not depend on it.
    os.environ.setdefault("QT_HASH_SEED", "0")
    freecad_path.append()
    try:
        # What it runs of Python while it starts tells an interrupt as a fault of its own.
        with interrupts.to_the_end():
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
    log = logging.getLogger("BendTorsionWB")
    log.setLevel(logging.DEBUG if options.debug else logging.NOTSET)
    log.handlers = [logging.StreamHandler()] if options.debug else []
    _progress.quiet = getattr(options, "quiet", False)
    try:
        held = options.command in _AT_DOCUMENTS
        for place in _places(options):
            refuse_issued(place)
        with outside_allowed(getattr(options, "outside_files", False)), catch_warnings():
            if not options.debug:
                # What is wrong is told as a finding; numpy's lines say nothing to a user.
                simplefilter("ignore", RuntimeWarning)
            with interrupts.to_the_end() if held else nullcontext():
                return _COMMANDS[options.command](options)
    except BendTorsionError as problem:
        # What an interrupt left half done may be told as a fault.
        interrupts.stop_if_asked()
        _progress.end()
        for finding in problem.findings:
            if finding.severity == "error" or not _progress.quiet:
                print(finding.line(), file=sys.stderr)
        unwritten = any(finding.code == "file-not-written" for finding in problem.findings)
        return FAILED if unwritten else INVALID
    except Exception as problem:  # noqa: BLE001 - the last fence before the user
        interrupts.stop_if_asked()
        _progress.end()
        if options.debug:
            traceback.print_exc()
        print(
            f"error: unexpected {type(problem).__name__}: {problem} -> run again with --debug "
            "and report what it prints",
            file=sys.stderr,
        )
        return FAILED


def _places(options) -> list[str]:
    """Where a command writes; `issue` itself makes issues."""
    if options.command == "issue":
        return []
    named = (getattr(options, "out", ""), getattr(options, "report", ""))
    return [place for place in named if place]


def _wanted(options):
    from BendTorsionWB.model_files import Wanted

    update = options.command == "update"
    model = update or not options.no_model
    removing = update and options.remove
    return Wanted(model, not options.no_sheets, options.split, update, removing, options.svg)


def _build(options) -> int:
    from BendTorsionWB import project
    from BendTorsionWB.exchange.plate_status import read_statuses
    from BendTorsionWB.sheets.pdf import start_qt

    start_qt()
    result = project.build(
        options.schedule,
        options.out,
        options.only,
        options.jobs,
        _progress,
        _wanted(options),
        statuses=read_statuses(options.status) if options.status else (),
        force=options.force,
    )
    return _tell(result, options)


def _issue(options) -> int:
    from BendTorsionWB import project
    from BendTorsionWB.exchange.issue import counted

    made = project.issue_folder(options.out, options.rev, options.note)
    if not options.quiet:
        counts = ", ".join(f"{count} {what}" for what, count in counted(made).items())
        print(f"revision {made.revision}: {counts}; in {options.out}/issued/{made.revision}")
    return GOOD


def _export(options) -> int:
    from pathlib import Path

    if Path(options.out).suffix.lower() in (".xlsx", ".csv"):
        return _write_back(options)
    from BendTorsionWB.document_export import export_document
    from BendTorsionWB.sheets.pdf import start_qt

    start_qt()
    result = export_document(
        options.document,
        options.out,
        options.only,
        options.jobs,
        _progress,
        not options.no_sheets,
        options.force,
        options.svg,
    )
    return _tell(result, options)


def _write_back(options) -> int:
    """A document as a workbook, or as a folder of CSV when the name ends in .csv."""
    from pathlib import Path

    from BendTorsionWB.round_trip import write_document_back

    out = Path(options.out)
    target = out.with_suffix("") if out.suffix.lower() == ".csv" else out
    findings = write_document_back(options.document, target)
    print_findings(findings, options.quiet)
    if not options.quiet:
        things = "thing" if len(findings) == 1 else "things"
        print(f"written to {target}, {len(findings)} {things} a schedule cannot say")
    return GOOD


def _report_of(options) -> int:
    from BendTorsionWB.document_export import source_records, write_figures
    from BendTorsionWB.exchange import report
    from BendTorsionWB.exchange.file_kind import FIGURES, check_ending

    if options.report:
        check_ending(options.report, FIGURES)
    given = source_records(options.source, options.only, options.jobs, _progress)
    _progress.end()
    records = tuple(given.records.values())
    findings = report.all_findings(records, given.findings)
    if options.report:
        write_figures(given, options.report)
    print_findings(findings, options.quiet, given.titles.told_length)
    if not options.quiet:
        for line in report.summary_lines(records, findings):
            print(line)
    return FAILED if any(finding.severity == "error" for finding in findings) else GOOD


def _support(options) -> int:
    from BendTorsionWB.support import write_bundle

    names = write_bundle(options.out, options.source)
    if not options.quiet:
        print(f"{options.out}: {', '.join(names)}; read them before you send them")
    return GOOD


def _new(options) -> int:
    from BendTorsionWB.document_templates import new_document, template_titles

    if not options.template or not options.out:
        for name, title in template_titles().items():
            print(f"{name:<10} {title}")
        if not options.template and not options.out:
            return GOOD
        print(f"error: {'--out' if options.template else '--template'} is missing", file=sys.stderr)
        return INVALID
    new_document(options.template, options.out)
    if not options.quiet:
        print(f"{options.out}: open it in FreeCAD, or export it")
    return GOOD


def _repair(options) -> int:
    from BendTorsionWB.document_repair import repair_document

    labels, findings = repair_document(options.document, options.out)
    print_findings(findings, options.quiet)
    if not options.quiet:
        done = f"written to {options.out or options.document}" if labels else "nothing to repair"
        print(f"{len(labels)} object{'' if len(labels) == 1 else 's'} repaired; {done}")
    return FAILED if findings else GOOD


def _diff(options) -> int:
    from BendTorsionWB.exchange.difference import write_changes
    from BendTorsionWB.exchange.file_kind import CHANGES, check_ending
    from BendTorsionWB.round_trip import difference

    if options.report:
        check_ending(options.report, CHANGES)

    changes = difference(options.one, options.other)
    if options.report:
        write_changes(changes, options.report)
    if not options.quiet:
        for change in changes:
            print(change.line())
        print(f"{len(changes)} change{'' if len(changes) == 1 else 's'}")
    return GOOD


def _tell(result, options) -> int:
    """Print what a build found; its exit code."""
    from BendTorsionWB.exchange import report

    _progress.end()
    print_findings(result.findings, options.quiet, result.style.told_length)
    if not options.quiet:
        for change in result.changes:
            print(change.line())
        for line in report.summary_lines(result.records, result.findings):
            print(line)
        seconds = ", ".join(f"{name} {spent:.1f}" for name, spent in result.timing.items())
        print(f"{sum(result.timing.values()):.1f} s ({seconds}); results in {options.out}")
    return FAILED if result.failed else GOOD


def _check(options) -> int:
    from BendTorsionWB import project
    from BendTorsionWB.core.parallel import workers_for
    from BendTorsionWB.shapes.clash import clashes

    schedule, jobs, found = project.read_project(options.schedule, options.only)
    with workers_for(options.jobs, len(jobs)) as executor:
        detailed, lost = project.detail_members(
            schedule, jobs, executor, _progress, of_files=found.findings
        )
    _progress.end()
    findings = [*lost, *(f for item in detailed.values() for f in item.record.findings)]
    findings += found.findings
    findings += clashes({name: item.geometry for name, item in detailed.items()}, found.met)
    failed = any(finding.severity == "error" for finding in findings)
    told = dict.fromkeys(project.at_rows(schedule, findings))
    for finding in sorted(told, key=lambda own: own.severity != "error"):
        if not options.quiet or finding.severity == "error":
            print(finding.line(schedule.settings.sheet_style.told_length))
    if not options.quiet:
        plates = sum(len(item.record.plates) for item in detailed.values())
        print(
            f"{schedule.file}: {len(detailed)} member{'' if len(detailed) == 1 else 's'}, "
            f"{plates} plates, " + ("in error" if failed else "good")
        )
    return FAILED if failed else GOOD


_COMMANDS = {
    "build": _build,
    "update": _build,
    "issue": _issue,
    "diff": _diff,
    "export": _export,
    "report": _report_of,
    "new": _new,
    "support": _support,
    "repair": _repair,
    "check": _check,
}
_AT_DOCUMENTS = ("diff", "export", "report", "new", "support", "repair")
"""Commands that open documents; `build` and `update` do so in parts only."""


if __name__ == "__main__":
    code = main()
    interrupts.hear_no_more()
    leave_to_the_end()
    if code == INTERRUPTED:
        _leave()
    sys.exit(code)
