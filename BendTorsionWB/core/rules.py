# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rule packs: editable limits with value, unit, source and status."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path

from .finding import BendTorsionError, error
from .plates import JointRules

FOLDER = Path(__file__).resolve().parents[2] / "resources" / "rules"
PACKS = ("CN", "EU", "US")


@lru_cache(maxsize=None)
def load(pack: str) -> dict[str, dict]:
    """The rules of a pack by name; raises BendTorsionError when the file cannot be read."""
    path = FOLDER / f"{pack}.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))["rules"]
    except (OSError, ValueError, KeyError) as problem:
        raise BendTorsionError(
            error("rule-pack", path.name, f"cannot read the rule pack: {problem}",
                  f"use one of {', '.join(PACKS)}, or mend the file")
        ) from problem


def joint_rules(pack: str) -> JointRules:
    """The limits joints are checked by."""
    rules = load(pack)
    try:
        return JointRules(
            float(rules["joint_stagger"]["value"]), float(rules["shortest_piece"]["value"])
        )
    except (KeyError, TypeError, ValueError) as problem:
        raise BendTorsionError(
            error("rule-pack", f"{pack}.json", f"a rule is missing or not a number: {problem}",
                  "mend the file")
        ) from problem
