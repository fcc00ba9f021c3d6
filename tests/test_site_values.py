# SPDX-License-Identifier: LGPL-2.1-or-later
"""Site values are the same in IFC placements, on sheet Control and on the drawings."""

import numpy as np
import openpyxl
import pytest
from package_build import SITE, rows
from scipy.spatial import cKDTree
from test_ifc import entities, numbers, of_kind, references

from BendTorsionWB.core.drawings.sheet_arrangement import arrangement_sheets
from BendTorsionWB.core.drawings.sheet_style import SheetStyle
from BendTorsionWB.core.site import SiteDatum


def frame(found, number):
    """The matrix (4, 4) of an IfcLocalPlacement to the world, through all it is relative to."""
    _, (outer, axes) = found[number]
    origin, z, x = found[references(axes)[0]][1]
    own = np.eye(4)
    own[:3, 3] = numbers(found, references(origin)[0])
    if references(z or "") and references(x or ""):
        own[:3, 2] = numbers(found, references(z)[0])
        own[:3, 0] = numbers(found, references(x)[0])
        own[:3, 1] = np.cross(own[:3, 2], own[:3, 0])
    return (frame(found, references(outer)[0]) if references(outer) else np.eye(4)) @ own


def test_the_corners_of_control_are_vertices_of_the_ifc_on_the_site(built):
    _, out, _ = built
    found = entities((out / "model.ifc").read_text(encoding="ascii"))
    places = {}
    for values in of_kind(found, "IFCPLATE").values():
        places[values[7].strip("'")] = frame(found, references(values[5])[0])
    assert len({tuple(np.round(matrix, 9).ravel()) for matrix in places.values()}) == 1
    matrix = next(iter(places.values()))
    vertices = [
        numbers(found, references(values[0])[0])
        for values in of_kind(found, "IFCVERTEXPOINT").values()
    ]
    world = np.array(vertices) @ matrix[:3, :3].T + matrix[:3, 3]
    control = rows(openpyxl.load_workbook(out / "results.xlsx", data_only=True)["Control"])
    ends = [r for r in control if r["line"] in ("E-1", "E-2") and r["corner"] != "face"]
    assert len(ends) >= 16
    corners = np.array([[r[f"site_{axis}"] for axis in "xyz"] for r in ends])
    assert cKDTree(world).query(corners)[0].max() < 1e-3


def test_the_general_arrangement_tells_the_same_datum(built):
    _, _, result = built
    site = SiteDatum(*(SITE[f"site_{a}"] for a in "xyz"), np.radians(SITE["site_rotation"]))
    sheets = arrangement_sheets(result.records, SheetStyle(site=site))
    tables = [table for sheet in sheets for table in sheet.tables]
    (row,) = (row for t in tables for row in t.rows if "model origin" in row[0])
    assert [float(cell) for cell in row[1:]] == [1000.0, -250.0, 30.0, 30.0]
    (listed,) = (t for t in tables if any("CG on the site" in name for name in t.header))
    at = next(k for k, name in enumerate(listed.header) if "CG on the site" in name)
    for record in result.records:
        row = next(row for row in listed.rows if row[0] == record.member)
        told = [float(part) for part in row[at].replace(",", " ").split()]
        assert told == pytest.approx(site.of(record.centre_of_gravity).tolist(), abs=0.51)
