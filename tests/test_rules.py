# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rule packs: whole, sourced, and refused by name when they are not."""

import json

import pytest

from BendTorsionWB.core import rules
from BendTorsionWB.core.finding import BendTorsionError


@pytest.fixture
def own_pack(tmp_path, monkeypatch):
    """Write a pack of one's own: a copy of CN with some rules replaced (None takes one out)."""
    original = json.loads((rules.FOLDER / "CN.json").read_text(encoding="utf-8"))

    def write(**changes):
        for name, value in changes.items():
            if value is None:
                del original["rules"][name]
            else:
                original["rules"][name]["value"] = value
        (tmp_path / "OWN.json").write_text(json.dumps(original), encoding="utf-8")
        monkeypatch.setattr(rules, "FOLDER", tmp_path)
        rules.load.cache_clear()
        return "OWN"

    yield write
    rules.load.cache_clear()


def test_every_pack_has_every_rule_with_unit_source_and_status():
    names = [set(rules.load(pack)) for pack in rules.PACKS]
    assert len(names[0] & names[1] & names[2]) >= 20
    for pack in rules.PACKS:
        for name in rules.load(pack):
            rule = rules.rule(pack, name)
            assert rule.unit and rule.meaning and rule.source
            assert rule.status in ("to be verified", "verified")
            assert rule.status in rule.line() and rule.source in rule.line()


def test_limits_a_pack_must_not_lose():
    joints = rules.joint_rules("CN")
    assert (joints.stagger, joints.shortest_piece, joints.widest_piece) == (200.0, 600.0, 2400.0)
    assert "GB 50755" in rules.rule("CN", "joint_stagger").source
    for pack in rules.PACKS:
        forming = rules.forming_rules(pack)
        assert forming.elastic_stress == 100.0
        assert (forming.cold_radius_low_alloy, forming.cold_radius_mild) == (25.0, 20.0)
    slopes = [rules.rule(pack, "thickness_slope").value for pack in rules.PACKS]
    assert slopes == [2.5, 4.0, 2.5]


def test_an_edited_limit_is_the_one_used(own_pack):
    pack = own_pack(joint_stagger=300, elastic_stress=80.0)
    assert rules.joint_rules(pack).stagger == 300.0
    assert rules.forming_rules(pack).elastic_stress == 80.0


@pytest.mark.parametrize("value", [None, "two hundred", -1.0, float("nan")])
def test_a_broken_rule_is_named(own_pack, value):
    pack = own_pack(joint_stagger=value)
    with pytest.raises(BendTorsionError) as caught:
        rules.joint_rules(pack)
    finding = caught.value.findings[0]
    assert (finding.code, finding.object, finding.position) == (
        "rule-pack",
        "OWN.json",
        "joint_stagger",
    )


def test_a_missing_pack_is_named():
    with pytest.raises(BendTorsionError, match="XX.json"):
        rules.load("XX")
