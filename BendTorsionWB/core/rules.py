# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rule packs: editable limits with value, unit, source and status."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from .finding import BendTorsionError, error
from .joints.stock import StockSheet
from .members.thickness import ThicknessRules
from .nodes.node_input import NodeRules
from .patterns.forming import FormingRules
from .plates.plates import JointRules
from .welds.edge_rows import WeldDefaults
from .welds.preps import Prep

FOLDER = Path(__file__).resolve().parents[2] / "resources" / "rules"
PACKS = ("CN", "EU", "US")


@dataclass(frozen=True)
class Rule:
    """One limit: its value and unit, what it means, where it comes from, and whether the source
    has been read (`verified`) or not yet (`to be verified`)."""

    name: str
    value: float
    unit: str
    meaning: str
    source: str
    status: str

    def line(self) -> str:
        """The rule as one line; its status stays visible."""
        unit = "" if self.unit == "1" else f" {self.unit}"
        return f"{self.meaning}: {self.value:g}{unit} ({self.source}; {self.status})"


@cache
def load(pack: str) -> dict[str, dict]:
    """The rules of a pack by name; raises BendTorsionError when the file cannot be read."""
    path = FOLDER / f"{pack}.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))["rules"]
    except (OSError, ValueError, KeyError) as problem:
        raise BendTorsionError(
            error(
                "rule-pack",
                path.name,
                f"cannot read the rule pack: {problem}",
                f"use one of {', '.join(PACKS)}, or mend the file",
            )
        ) from problem


def rule(pack: str, name: str) -> Rule:
    """One rule of a pack; raises BendTorsionError when it is missing or its value no number."""
    try:
        given = load(pack)[name]
        fields = (given[key] for key in ("unit", "meaning", "source", "status"))
        made = Rule(name, float(given["value"]), *fields)
        if not math.isfinite(made.value) or made.value < 0.0:
            raise ValueError(f"{name} = {made.value}")
        return made
    except (KeyError, TypeError, ValueError) as problem:
        raise BendTorsionError(
            error(
                "rule-pack",
                f"{pack}.json",
                f"a rule is missing or not a number: {problem}",
                "mend the file",
                position=name,
            )
        ) from problem


def joint_rules(pack: str, stock: tuple[StockSheet, ...] = ()) -> JointRules:
    """The limits joints are checked by and solved for; stock: instead of the pack's."""
    return JointRules(
        stagger=rule(pack, "joint_stagger").value,
        shortest_piece=rule(pack, "shortest_piece").value,
        longest_piece=rule(pack, "longest_piece").value,
        widest_piece=rule(pack, "widest_piece").value,
        fold_clearance=rule(pack, "fold_clearance").value,
        diaphragm_clearance=rule(pack, "diaphragm_clearance").value,
        node_clearance=rule(pack, "node_clearance").value,
        piece_end_clearance=rule(pack, "piece_end_clearance").value,
        narrowest_lane=rule(pack, "longitudinal_strip").value,
        stock=stock,
    )


def weld_defaults(pack: str) -> WeldDefaults:
    """Preparations of seams and joints that no row of the Edges sheet names, of branches and
    diaphragms at nodes."""

    def value(name: str) -> float:
        return rule(pack, name).value

    corner = Prep(
        "corner",
        "bevel",
        math.radians(value("corner_groove_angle")),
        value("corner_groove_land"),
    )
    butt = Prep(
        "butt",
        "v",
        math.radians(value("butt_groove_angle")),
        value("butt_groove_land"),
        value("butt_groove_gap"),
    )
    branch = Prep(
        "branch",
        "bevel",
        math.radians(value("branch_groove_angle")),
        value("branch_groove_land"),
    )
    return WeldDefaults(
        corner,
        butt,
        bevel_step=math.radians(value("bevel_step")),
        branch=branch,
        leg=value("diaphragm_leg"),
        fillet_least_angle=math.radians(value("fillet_least_angle")),
        largest_bevel=math.radians(value("largest_bevel")),
        widest_leg=value("fillet_leg"),
        widest_gap=value("widest_root_gap"),
        gap_over_thickness=value("root_gap_over_thickness"),
        access=value("node_manhole"),
    )


def thickness_rules(pack: str) -> ThicknessRules:
    """The limits of thickness joints."""
    return ThicknessRules(
        stagger=rule(pack, "joint_stagger").value,
        fold_clearance=rule(pack, "fold_clearance").value,
        chamfer_slope=rule(pack, "thickness_chamfer").value,
    )


def forming_rules(pack: str) -> FormingRules:
    """The limits of the forming classes."""
    names = (
        "flat_within",
        "elastic_stress",
        "cold_radius_low_alloy",
        "cold_radius_mild",
        "mild_up_to",
    )
    return FormingRules(
        **{name: rule(pack, name).value for name in names},
        fold_without_press=math.radians(rule(pack, "fold_without_press").value),
    )


def node_rules(pack: str) -> NodeRules:
    """The limits of nodes."""
    return NodeRules(
        least_angle=math.radians(rule(pack, "node_least_angle").value),
        flange_angle=math.radians(rule(pack, "node_flange_angle").value),
        **{
            name: rule(pack, f"node_{name}").value
            for name in (
                "near",
                "end_distance",
                "shortest_branch",
                "overhang",
                "same",
                "flange_step",
                "gap",
                "widest_gap",
                "gap_over_thickness",
                "manhole",
                "manhole_edge",
                "snipe",
                "wall_gap",
                "access",
            )
        },
    )
