"""`@verifies("P104-CMD-07", "AC-04")`: which spec rules a test checks.

Works on plain pytest functions and on cocotb tests (above or below `@cocotb.test()`). The pytest plugin
(`plugin.py`) writes the outcome of every marked test to build/trace/, `scripts/trace.py` turns that into
the traceability table. IDs that the manual does not list make the test fail.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from typing import Any, TypeVar

from openppmc import parts

from .paths import ROOT

F = TypeVar("F")

PREFIXES = {prefix: row.name for row in parts.folders() for prefix in row.rules}
"""First word of a rule ID -> the part that it belongs to."""

# A part's first prefix has subjects (P104-CMD-07), another one numbers alone (J105-07).
_SUBJECTS = "|".join(row.rules[0] for row in parts.folders() if row.rules)
_NUMBERS = "|".join(prefix for row in parts.folders() for prefix in row.rules[1:]) or "(?!)"
RULE_ID = re.compile(
    rf"^(?:(?P<prefix>(?:{_SUBJECTS})(?=-[A-Z])|(?:{_NUMBERS})(?=-\d))(?:-[A-Z]+)?-\d\d"
    # Rules about an instruction of the PPMC-312 have its code, those about free curves a number.
    r"|(?P<code>P312)-CMD-(?:(?!FC)[0-9A-F]{2}|8L|8V|FC-\d{1,2})|AC-\d\d)$"
)
_ID = r"[A-Z0-9]+(?:-[A-Z]+)?-\d\d|P312-CMD-[0-9A-Z]{2}(?:-\d{1,2})?"
_ROW = re.compile(rf"^\|\s*(?:\*\*|`)?(?P<id>{_ID})(?:\*\*|`)?\s*\|\s*(?P<text>.*?)\s*\|\s*$")


def verifies(*ids: str) -> Callable[[F], F]:
    """Mark a test as checking these rules.

    Raises ValueError at import time for an ID that is not of the form P104-ABC-NN (or a sister part's
    prefix), J105-NN or AC-NN.
    """
    if not ids:
        raise ValueError("verifies() needs at least one rule ID")
    for rule in ids:
        if not RULE_ID.match(rule):
            raise ValueError(f"verifies(): {rule!r} is not a rule ID (P104-ABC-NN or AC-NN)")

    def mark(test: F) -> F:
        target: Any = getattr(test, "func", test)
        earlier: tuple[str, ...] = getattr(target, "_openppmc_rules", ())
        target._openppmc_rules = tuple(dict.fromkeys((*ids, *earlier)))
        return test

    return mark


def rules_of(test: Any) -> tuple[str, ...]:
    """Rule IDs put on a test function (or cocotb test object) by `verifies`."""
    return tuple(getattr(getattr(test, "func", test), "_openppmc_rules", ()))


def part_of_rule(rule: str) -> str | None:
    """Part a rule ID belongs to; None for AC-NN, which every part numbers for itself."""
    match = RULE_ID.match(rule)
    prefix = match and (match["prefix"] or match["code"])
    return PREFIXES[prefix] if prefix else None


@cache
def manual_rules(part: str) -> dict[str, str]:
    """Rule ID -> short text, from the tables of docs/<part>/README.md (empty if there is no manual yet).

    A rule is a table row of two cells whose first cell is an ID. Raises ValueError for a double ID.
    """
    manual = ROOT / "docs" / part / "README.md"
    rules: dict[str, str] = {}
    if not manual.is_file():
        return rules
    for line in manual.read_text(encoding="utf-8").splitlines():
        match = _ROW.match(line)
        if match and RULE_ID.match(match["id"]):
            if match["id"] in rules:
                raise ValueError(f"docs/{part}/README.md lists {match['id']} twice")
            rules[match["id"]] = match["text"]
    return rules


def unknown_rules(ids: tuple[str, ...], part: str) -> list[str]:
    """IDs that the manual of their part does not list; nothing is unknown while a part has no manual."""
    bad = []
    for rule in ids:
        known = manual_rules(part_of_rule(rule) or part)
        if known and rule not in known:
            bad.append(rule)
    return bad
