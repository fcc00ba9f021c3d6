# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line: from schedules to files, and back."""

from __future__ import annotations

import argparse
import os
import sys
import traceback
from importlib.util import find_spec

from BendTorsionWB import __version__, freecad_path
from BendTorsionWB.console import Progress, print_findings
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.exchange.outside_files import outside_allowed

GOOD, FAILED, INVALID = 0, 1, 2

_progress = Progress()


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
    _progress.quiet = getattr(options, "quiet", False)
    try:
        with outside_allowed(getattr(options, "outside_files", False)):
            return options.run(options)
    except BendTorsionError as problem:
        _progress.end()
        for finding in problem.findings:
            print(finding.line(), file=sys.stderr)
        unwritten = any(finding.code == "file-not-written" for finding in problem.findings)
        return FAILED if unwritten else INVALID
    except Exception as problem:  # noqa: BLE001 - the last fence before the user
        _progress.end()
        if options.debug:
            traceback.print_exc()
        print(
            f"error: unexpected {type(problem).__name__}: {problem} -> run again with --debug "
            "and report what it prints",
            file=sys.stderr,
        )
        return FAILED
    except KeyboardInterrupt:
        _progress.end()
        print("stopped; files already written are whole", file=sys.stderr)
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python3 -m BendTorsionWB",
        description="Detailing of box members that bend and twist in space.",
    )
    parser.add_argument("--version", action="version", version=f"BendTorsion {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str, run, help: str, *options):
        added = commands.add_parser(name, help=help)
        for option in (*options, _debug, _quiet):
            option(added)
        added.set_defaults(run=run)

    command(
        "build",
        _build,
        "build a schedule into a folder",
        *(_schedule, _out, _only, _jobs, _no_model, _no_sheets, _svg, _split, _status, _force),
        _outside_files,
    )
    command(
        "update",
        _build,
        "bring the documents of a folder up to a changed schedule, and its files",
        *(_schedule, _out, _only, _jobs, _no_sheets, _svg, _split, _remove, _status, _force),
        _outside_files,
    )
    command("issue", _issue, "freeze a built folder under a revision", _folder, _revision)
    command(
        "diff",
        _diff,
        "tell what changed from one schedule or document (.FCStd) to another",
        *(_two, _report, _outside_files),
    )
    command(
        "export",
        _export,
        "write the files of a document, or the document as a schedule",
        *(_document, _out, _only, _jobs, _no_sheets, _svg, _force),
    )
    command(
        "report",
        _report_of,
        "tell the figures of a schedule or document; write them to a file",
        *(_source, _only, _jobs, _report, _outside_files),
    )
    command("new", _new, "start a document from a template", _template)
    command(
        "support",
        _support,
        "collect what a report of a fault needs, without names of users and folders",
        *(_any_source, _bundle),
    )
    command(
        "repair",
        _repair,
        "make a document compute again that was saved without BendTorsion",
        *(_document, _other_file),
    )
    checked = (_schedule, _only, _jobs, _outside_files)
    command("check", _check, "check a schedule, write nothing", *checked)
    return parser


def _schedule(command) -> None:
    command.add_argument("schedule", help="the schedule: a workbook (.xlsx) or a folder of .csv")


def _out(command) -> None:
    command.add_argument("--out", required=True, metavar="DIR", help="folder for the results")


def _only(command) -> None:
    command.add_argument("--only", default="", metavar="M1,M2", help="only these members")


def _jobs(command) -> None:
    command.add_argument(
        "--jobs", type=_count, default=None, metavar="N", help="worker processes (all cores)"
    )


def _no_model(command) -> None:
    command.add_argument(
        "--no-model", action="store_true", help="neither FreeCAD document nor STEP and IFC"
    )


def _no_sheets(command) -> None:
    command.add_argument(
        "--no-sheets", action="store_true", help="no drawing sheets, in the document neither"
    )


def _svg(command) -> None:
    command.add_argument("--svg", action="store_true", help="drawing sheets as SVG as well")


def _split(command) -> None:
    command.add_argument(
        "--split", type=_count, default=0, metavar="N", help="a document for each N members"
    )


def _remove(command) -> None:
    command.add_argument("--remove", action="store_true", help="remove objects whose rows are gone")


def _force(command) -> None:
    command.add_argument(
        "--force", action="store_true", help="into the folder of another project as well"
    )


def _outside_files(command) -> None:
    command.add_argument(
        "--outside-files",
        action="store_true",
        help="read files the schedule names outside its folder, too",
    )


def _status(command) -> None:
    command.add_argument(
        "--status", default="", metavar="FILE", help="the shop's list of plates cut (.csv)"
    )


def _document(command) -> None:
    command.add_argument("document", help="a FreeCAD document (.FCStd)")


def _other_file(command) -> None:
    command.add_argument("--out", default="", metavar="FILE", help="another file, not in place")


def _source(command) -> None:
    command.add_argument("source", help="a schedule or a FreeCAD document (.FCStd)")


def _any_source(command) -> None:
    command.add_argument(
        "source", nargs="?", default="", help="the schedule or document (.FCStd) it happens with"
    )


def _bundle(command) -> None:
    command.add_argument("--out", required=True, metavar="FILE", help="the bundle (.zip)")


def _template(command) -> None:
    command.add_argument("--template", default="", metavar="NAME", help="list them when left out")
    command.add_argument("--out", default="", metavar="FILE", help="the new document (.FCStd)")


def _folder(command) -> None:
    command.add_argument("out", metavar="DIR", help="folder of a build")


def _revision(command) -> None:
    command.add_argument("--rev", required=True, metavar="B", help="name of the revision")
    command.add_argument("--note", default="", help="a line for the transmittal")


def _two(command) -> None:
    command.add_argument("one", help="a schedule or a document")
    command.add_argument("other", help="another, later one")


def _report(command) -> None:
    command.add_argument(
        "--report", default="", metavar="FILE", help="write it too: .xlsx, .csv or .json"
    )


def _debug(command) -> None:
    command.add_argument("--debug", action="store_true", help="print where a fault arose")


def _quiet(command) -> None:
    command.add_argument("--quiet", action="store_true", help="print errors only")


def _count(text: str) -> int:
    value = int(text) if text.isdecimal() else 0
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 up")
    return value


def _members(options) -> list[str]:
    return [name.strip() for name in options.only.split(",") if name.strip()]


def _wanted(options):
    from BendTorsionWB.model_files import Wanted

    update = options.command == "update"
    model = update or not options.no_model
    return Wanted(model, not options.no_sheets, options.split, update, options.svg)


def _build(options) -> int:
    from BendTorsionWB import project
    from BendTorsionWB.exchange.plate_status import read_statuses
    from BendTorsionWB.sheets.pdf import start_qt

    start_qt()
    result = project.build(
        options.schedule,
        options.out,
        _members(options),
        options.jobs,
        _progress,
        _wanted(options),
        removing=getattr(options, "remove", False),
        statuses=read_statuses(options.status) if options.status else None,
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
        _members(options),
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
        print(f"written to {target}, {len(findings)} things a schedule cannot say")
    return GOOD


def _report_of(options) -> int:
    from BendTorsionWB.document_export import source_records, write_figures
    from BendTorsionWB.exchange import report

    given = source_records(options.source, _members(options), options.jobs, _progress)
    _progress.end()
    records = tuple(given.records.values())
    findings = report.all_findings(records, given.findings)
    if options.report:
        write_figures(given, options.report)
    print_findings(findings, options.quiet)
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
        return GOOD if not options.out and not options.template else INVALID
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
        print(f"{len(labels)} objects repaired; {done}")
    return FAILED if findings else GOOD


def _diff(options) -> int:
    from BendTorsionWB.exchange.difference import write_changes
    from BendTorsionWB.round_trip import difference

    changes = difference(options.one, options.other)
    if options.report:
        write_changes(changes, options.report)
    if not options.quiet:
        for change in changes:
            print(change.line())
        print(f"{len(changes)} changes")
    return GOOD


def _tell(result, options) -> int:
    """Print what a build found; its exit code."""
    from BendTorsionWB.exchange import report

    _progress.end()
    print_findings(result.findings, options.quiet)
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

    schedule, jobs, found = project.read_project(options.schedule, _members(options))
    with workers_for(options.jobs, len(jobs)) as executor:
        detailed, lost = project.detail_members(schedule, jobs, executor, _progress)
    _progress.end()
    findings = [*lost, *(f for item in detailed.values() for f in item.record.findings)]
    findings += found.findings
    findings += clashes({name: item.geometry for name, item in detailed.items()}, found.met)
    failed = any(finding.severity == "error" for finding in findings)
    for finding in dict.fromkeys(findings):
        if not options.quiet or finding.severity == "error":
            print(finding.line())
    if not options.quiet:
        plates = sum(len(item.record.plates) for item in detailed.values())
        print(
            f"{schedule.file}: {len(detailed)} members, {plates} plates, "
            + ("in error" if failed else "good")
        )
    return FAILED if failed else GOOD


if __name__ == "__main__":
    sys.exit(main())
