# SPDX-License-Identifier: LGPL-2.1-or-later
"""What members give to an IFC file: joined as if written at once, kept, and never stale."""

from dataclasses import replace
from types import SimpleNamespace

import FreeCAD
import Part
import pytest

from BendTorsionWB import ifc_fragments
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.exchange.ifc import ifc_bytes, ifc_file
from BendTorsionWB.exchange.ifc_fragment import Assembly, PlateSolid, ifc_fragment
from BendTorsionWB.exchange.result_cache import ResultCache
from BendTorsionWB.ifc_fragments import NamedSolid, kept_key, member_fragment
from BendTorsionWB.shapes import step_text
from BendTorsionWB.shapes.boundary_of import boundary_of

GREY = (0.5, 0.5, 0.75)


def box(size, at=0.0):
    return Part.makeBox(10 * size, 20, 30, FreeCAD.Vector(at, 0, 0)).Solids[0]


def plate(mark, **other):
    given = dict.fromkeys(("area", "volume", "mass", "length", "width", "thickness"), 12.5)
    given |= {"mark": mark, "part": mark, "piece": 1, "face": "top", "forming": "cold"}
    given |= {"material": "S355", "gross": None, "marking_face": "inside", "bevels": ()}
    return SimpleNamespace(**given | other)


def assembly(member, *sizes, material="S355"):
    return Assembly(
        member,
        member,
        tuple(
            PlateSolid(
                plate(f"{member}-T{k}", material=material),
                boundary_of(box(size, 7.0 * k), f"{member}-T{k}"),
                GREY if k % 2 else (0.1, 0.9, 0.2),
            )
            for k, size in enumerate(sizes, 1)
        ),
    )


def test_a_file_of_fragments_is_that_of_all_members_at_once():
    """Also where they share directions, colours and materials."""
    every = [
        assembly("M1", 1, 2),
        assembly("M2", 3, material="Q420"),
        assembly("M3", 1, 4, 2),
        replace(assembly("M4", 5), mark="M4-P2"),
    ]
    site = SiteDatum(x=1000.0, y=-2.5, z=30.0, rotation=0.5)
    at_once = ifc_bytes("Hall", every, site, "1.0")
    fragments = [ifc_fragment("Hall", [own]) for own in every]
    assert b"".join(ifc_file("Hall", fragments, site, "1.0")) == at_once
    assert at_once.count(b"IFCDIRECTION((0.,0.,1.))") == 1
    assert at_once.count(b"IFCMATERIAL(") == 2 and at_once.count(b"IFCSURFACESTYLE(") == 2


def test_a_file_of_nothing_has_no_empty_entities():
    content = ifc_bytes("Hall", [])
    assert b"IFCBUILDING(" in content and b"=;" not in content


@pytest.fixture
def made(monkeypatch):
    """Members whose fragments were made."""
    names = []
    real = ifc_fragments.ifc_fragment

    def spy(project, assemblies):
        names.append(assemblies[0].member)
        return real(project, assemblies)

    monkeypatch.setattr(ifc_fragments, "ifc_fragment", spy)
    return names


def given(size=1, colour=GREY, mark="M1", **other):
    solids = {mark: [NamedSolid("M1-T1", 1, colour, box(size))]}
    return "Hall", "M1", solids, {"M1-T1": plate("M1-T1", **other)}


def test_a_fragment_is_kept_and_read_as_it_was_made(made, tmp_path):
    cache = ResultCache(tmp_path)
    first = member_fragment(*given(), cache)
    again = member_fragment(*given(), cache)
    assert made == ["M1"] and again == first == member_fragment(*given())
    (kept,) = tmp_path.iterdir()
    assert kept.stem == kept_key("M1")
    kept.write_bytes(kept.read_bytes()[:-1])
    assert member_fragment(*given(), cache) == first and made == ["M1"] * 3


@pytest.mark.parametrize(
    "changed",
    [
        {"size": 2},
        {"colour": (0.5, 0.5, 0.5)},
        {"mark": "M1-P1"},
        {"material": "Q420"},
        {"mass": 13.0},
        {"forming": "hot"},
        {"width": 12.0},
        {"marking_face": "outside"},
    ],
    ids=str,
)
def test_of_what_is_told_nothing_changes_unseen(changed, made, tmp_path):
    cache = ResultCache(tmp_path)
    first = member_fragment(*given(), cache)
    second = member_fragment(*given(**changed), cache)
    assert made == ["M1", "M1"] and second != first
    assert second == member_fragment(*given(**changed))


def test_a_solid_of_no_plate_is_left_out(made, tmp_path):
    project, member, solids, plates = given()
    solids["M1"] = [*solids["M1"], NamedSolid("M1-T2", 1, GREY, box(3))]
    found = member_fragment(project, member, solids, plates, ResultCache(tmp_path))
    assert found == member_fragment(*given())


def test_solids_hashed_before_are_not_exported_again(made, monkeypatch, tmp_path):
    cache = ResultCache(tmp_path)
    first = member_fragment(*given(), cache, "one")
    monkeypatch.setattr(step_text, "solids_as_bytes", lambda own: pytest.fail("exported"))
    assert member_fragment(*given(), cache, "one") == first and made == ["M1"]
    member_fragment(*given(), cache, "another")
    assert made == ["M1", "M1"]
