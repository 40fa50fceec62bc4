"""Results of the proofs.

build/prove/results.json has the last result of each proof, for `make trace`. docs/proved.json has the digest
of RTL, properties and tools with which each proof last held; `make prove` skips a proof with this digest.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from cocotb_tests.harness.project import BUILD, DOCS, include_dirs
from scripts.env import LOCK
from scripts.measure.prove.check import Outcome
from scripts.measure.prove.table import FORMAL, Proof, proofs
from scripts.measure.sizes.designs import code

RESULTS = BUILD / "prove" / "results.json"
PROVED = DOCS / "proved.json"


def digest(proof: Proof) -> str:
    """Return the digest of all that determines the result of a proof, without comments of the RTL."""
    headers = [path for folder in (*include_dirs(), FORMAL) for path in sorted(folder.glob("*.svh"))]
    text = proof.file.read_text(encoding="utf-8")
    headers += [FORMAL / name for name in re.findall(r'`include "(\w+/\w+\.svh)"', text)]
    version = next(
        line for line in LOCK.read_text(encoding="utf-8").splitlines() if line.startswith("pyosys==")
    )
    what = (proof.bound, proof.induct, proof.cover, proof.only, version)
    sha = hashlib.sha256(repr(what).encode())
    for path in [*proof.sources(), *headers]:
        sha.update(code(path).encode())
    for name in ("model", "engine"):
        sha.update(Path(__file__).with_name(f"{name}.py").read_bytes())
    return sha.hexdigest()[:16]


def changed(every: Sequence[Proof]) -> list[Proof]:
    """Return the proofs whose present digest is not in docs/proved.json."""
    known = _read(PROVED)
    return [proof for proof in every if known.get(proof.name) != digest(proof)]


def kept() -> dict[str, bool]:
    """Return, for the name of each proof that has run, whether the proof holds."""
    return _read(RESULTS)


def keep(outcome: Outcome, proof: Proof) -> None:
    """Store the result of a run."""
    _write(RESULTS, kept() | {outcome.name: outcome.good})
    names = {one.name for one in proofs()}
    known = {name: old for name, old in _read(PROVED).items() if name in names and name != proof.name}
    _write(PROVED, known | ({proof.name: digest(proof)} if outcome.good else {}))


def _read(path: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    return found


def _write(path: Path, found: dict[str, Any]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    fresh = path.with_suffix(f".{os.getpid()}")
    fresh.write_text(json.dumps(dict(sorted(found.items())), indent=1) + "\n", encoding="utf-8")
    fresh.replace(path)


def failed() -> list[str]:
    """Return the proofs of the table whose last run has failed."""
    return sorted({one.name for one in proofs()} & {name for name, good in kept().items() if not good})


def by_rule() -> dict[str, list[Proof]]:
    """Return the proofs of each rule, by rule ID, in the order of the tables."""
    found: dict[str, list[Proof]] = defaultdict(list)
    for one in proofs():
        for rule in one.rules:
            found[rule].append(one)
    return dict(found)
