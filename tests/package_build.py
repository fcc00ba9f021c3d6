# SPDX-License-Identifier: LGPL-2.1-or-later
"""A project of two members built once for all tests that read its files."""

import openpyxl
from test_build import APART, schedule

from BendTorsionWB import project

SITE = {"site_x": 1000.0, "site_y": -250.0, "site_z": 30.0, "site_rotation": 30.0}


def book_with_settings(path):
    """Two members with allowances and a backing bar at one seam, away from the site's origin."""
    schedule(path, APART)
    book = openpyxl.load_workbook(path)
    page = book.create_sheet("Settings")
    rows = {**SITE, "project": "Hall", "shrinkage_along": 0.6, "shrinkage_across": 0.4}
    for row in [("key", "value"), *rows.items()]:
        page.append(row)
    page = book.create_sheet("Edges")
    page.append(["member", "seam", "from", "to", "prep"])
    page.append(["M1", "TL", 0, "50%", "bevel angle=40 land=4 gap=4 backing=30x6"])
    page.append(["M1", "TL", "50%", "100%", "bevel angle=40 land=2 gap=4"])
    book.save(path)
    return path


def build_package(folder):
    """The schedule, the folder it was built into, and what the build found."""
    path = book_with_settings(folder / "two.xlsx")
    result = project.build(path, folder / "out", workers=1)
    assert not result.failed, [f.line() for f in result.findings]
    return path, folder / "out", result


def plates_of(result):
    return [plate for record in result.records for plate in record.plates]


def rows(sheet):
    header, *body = sheet.iter_rows(values_only=True)
    return [dict(zip(header, row, strict=True)) for row in body]
