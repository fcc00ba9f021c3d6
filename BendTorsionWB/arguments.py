# SPDX-License-Identifier: LGPL-2.1-or-later
"""The words of the command line: commands, and the options each takes."""

from __future__ import annotations

import argparse

from BendTorsionWB import __version__


def parser() -> argparse.ArgumentParser:
    """The parser of the command line; `command` names what is to be done."""
    whole = argparse.ArgumentParser(
        prog="python3 -m BendTorsionWB",
        description="Detailing of box members that bend and twist in space.",
    )
    whole.add_argument("--version", action="version", version=f"BendTorsion {__version__}")
    commands = whole.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name: str, help: str, *options):
        added = commands.add_parser(name, help=help)
        for option in (*options, _debug, _quiet):
            option(added)

    command(
        "build",
        "build a schedule into a folder",
        *(_schedule, _out, _only, _jobs, _no_model, _no_sheets, _svg, _split, _status, _force),
        _outside_files,
    )
    command(
        "update",
        "bring the documents of a folder up to a changed schedule, and its files",
        *(_schedule, _out, _only, _jobs, _no_sheets, _svg, _split, _remove, _status, _force),
        _outside_files,
    )
    command("issue", "freeze a built folder under a revision", _folder, _revision)
    command(
        "diff",
        "tell what changed from one schedule or document (.FCStd) to another",
        *(_two, _report, _outside_files),
    )
    command(
        "export",
        "write the files of a document, or the document as a schedule",
        *(_document, _out, _only, _jobs, _no_sheets, _svg, _force),
    )
    command(
        "report",
        "tell the figures of a schedule or document; write them to a file",
        *(_source, _only, _jobs, _figures, _outside_files),
    )
    command("new", "start a document from a template", _template)
    command(
        "support",
        "collect what a report of a fault needs, without names of users and folders",
        *(_any_source, _bundle),
    )
    command(
        "repair",
        "make a document compute again that was saved without BendTorsion",
        *(_document, _other_file),
    )
    checked = (_schedule, _only, _jobs, _outside_files)
    command("check", "check a schedule, write nothing", *checked)
    return whole


def _schedule(command) -> None:
    command.add_argument("schedule", help="the schedule: a workbook (.xlsx) or a folder of .csv")


def _out(command) -> None:
    command.add_argument("--out", required=True, metavar="DIR", help="folder for the results")


def _only(command) -> None:
    command.add_argument(
        "--only", type=_names, default=[], metavar="M1,M2", help="only these members"
    )


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


def _figures(command) -> None:
    command.add_argument(
        "--report", default="", metavar="FILE", help="write them too: .xlsx or .json"
    )


def _debug(command) -> None:
    command.add_argument("--debug", action="store_true", help="print where a fault arose")


def _quiet(command) -> None:
    command.add_argument("--quiet", action="store_true", help="print errors only")


def _names(text: str) -> list[str]:
    names = [name.strip() for name in text.split(",") if name.strip()]
    if not names:
        raise argparse.ArgumentTypeError("names no member; leave it out for all of them")
    return names


def _count(text: str) -> int:
    value = int(text) if text.isdecimal() else 0
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 up")
    return value
