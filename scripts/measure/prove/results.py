"""Results of the last runs of the proofs: build/prove/results.json, for `make trace`."""

from __future__ import annotations

import json
import os
from collections import defaultdict

from cocotb_tests.harness.project import BUILD
from scripts.measure.prove.check import Outcome
from scripts.measure.prove.table import Proof, proofs

RESULTS = BUILD / "prove" / "results.json"


def kept() -> dict[str, bool]:
    """Return, for the name of each proof that has run, whether the proof holds."""
    found: dict[str, bool] = {}
    if RESULTS.is_file():
        found = json.loads(RESULTS.read_text(encoding="utf-8"))
    return found


def keep(outcome: Outcome) -> None:
    """Store the result of a run."""
    found = kept() | {outcome.name: outcome.good}
    RESULTS.parent.mkdir(parents=True, exist_ok=True)
    fresh = RESULTS.with_suffix(f".{os.getpid()}")
    fresh.write_text(json.dumps(dict(sorted(found.items())), indent=1), encoding="utf-8")
    fresh.replace(RESULTS)


def failed() -> list[str]:
    """Return the proofs of the table whose last run has failed."""
    return sorted({one.name for one in proofs()} & {name for name, good in kept().items() if not good})


def by_rule() -> dict[str, list[Proof]]:
    """Return rule ID -> its proofs, in the order of the tables."""
    found: dict[str, list[Proof]] = defaultdict(list)
    for one in proofs():
        for rule in one.rules:
            found[rule].append(one)
    return dict(found)
