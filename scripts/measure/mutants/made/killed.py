"""docs/killed.json: the killed and equal mutants of each file, so that any machine can continue a run."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from itertools import groupby

from cocotb_tests.harness.project import DOCS
from scripts.measure.campaign.jobs import Done
from scripts.measure.campaign.store import Store
from scripts.measure.campaign.tree import SIMULATED, tree
from scripts.measure.mutants.made.chosen import rtl_files
from scripts.measure.mutants.made.work import EQUAL, KILLED, PROOF, digest

NAME = "mutate"
PAGE = DOCS / "killed.json"
EARLIER = {
    "proof": (KILLED, f"{PROOF}of an earlier run"),
    "test": (KILLED, "of an earlier run"),
    "equal": (EQUAL, ""),
}
"""Verdict and name of what killed a mutant of this page, by the key of its list."""


def known(store: Store) -> dict[str, tuple[str, Done]]:
    """Return stamp and result of each killed or equal mutant whose file is unchanged, by the mutant's key."""
    return {
        done.key: (stamp, done)
        for stamp, done in store.all(NAME)
        if done.data.get("verdict") in (KILLED, EQUAL) and done.data["file"] == digest(done.key.split(" ")[0])
    }


def note(mutant: str, verdict: str, test: str) -> None:
    """Store that a mutant is killed by this test, or that it is equal to the RTL."""
    data = {"verdict": verdict, "test": test, "file": digest(mutant.split(" ")[0])}
    with Store() as store:
        store.note(NAME, tree(SIMULATED), Done(mutant, True, data, 0.0))


def load() -> None:
    """Store the mutants of docs/killed.json whose file is unchanged."""
    files = rtl_files()
    entries = json.loads(PAGE.read_text(encoding="ascii")) if PAGE.is_file() else {}
    with Store() as store:
        old = known(store)
        for file, entry in entries.items():
            if file not in files or entry["digest"] != digest(file):
                continue
            for kind, (verdict, test) in EARLIER.items():
                data = {"verdict": verdict, "test": test, "file": entry["digest"]}
                for key in (f"{file} {number}" for number in _numbers(entry.get(kind, ""))):
                    if key not in old:
                        store.note(NAME, "earlier", Done(key, True, data, 0.0))


def save() -> None:
    """Write all killed and equal mutants of unchanged files to docs/killed.json."""
    found: dict[str, dict[str, list[int]]] = {}
    with Store() as store:
        for key, (_, done) in known(store).items():
            file, number = key.split(" ")
            kind = "proof" if done.data["test"].startswith(PROOF) else "test"
            kind = "equal" if done.data["verdict"] == EQUAL else kind
            found.setdefault(file, {kind: [] for kind in EARLIER})[kind].append(int(number))
    rows = {
        file: {"digest": digest(file), **{kind: _ranges(sorted(all_)) for kind, all_ in kinds.items()}}
        for file, kinds in sorted(found.items())
    }
    PAGE.write_text(json.dumps(rows, indent=1) + "\n", encoding="ascii")


def _ranges(numbers: Sequence[int]) -> str:
    """Return numbers as text.

    >>> _ranges([1, 2, 3, 7])
    '1-3 7'
    """
    groups = [list(one) for _, one in groupby(enumerate(numbers), lambda pair: pair[1] - pair[0])]
    return " ".join(f"{one[0][1]}-{one[-1][1]}" if len(one) > 1 else str(one[0][1]) for one in groups)


def _numbers(text: str) -> Iterator[int]:
    """Parse the result of `_ranges`.

    >>> list(_numbers("1-3 7"))
    [1, 2, 3, 7]
    """
    for word in text.split():
        first, _, last = word.partition("-")
        yield from range(int(first), int(last or first) + 1)
