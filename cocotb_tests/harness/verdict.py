"""What to say of a test that failed: it is run again alone, then with waves.

*fails* (alone, too), *fails only behind other tests* (alone it passes, in the same process it fails again),
*not deterministic* (the same process, once more, ends otherwise). A run with waves is another build: if the
failure is gone there, that is said, and is no word about the test.
"""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from . import mutant
from .build import SimError
from .collect import Item
from .group import narrowed
from .inside import hint
from .outcome import MISSING, TIMEOUT, Outcome
from .paths import FAILURES, relative
from .simulate import VCD, Job, safe, simulate, tried


def judged(item: Item, first: Outcome, job: Job, waves: bool = True) -> str:
    """Message about an item that failed in `job`; log, and with `waves` a VCD, stay in build/failures/."""
    if mutant.present():
        return first.text
    kept = FAILURES / f"{safe(item.id)}-s{job.seed}"
    shutil.rmtree(kept, ignore_errors=True)
    alone = replace(job, items=(item,))
    outcome = simulate(alone, kept)[item]
    if not outcome.good:
        text = _fails(item, outcome, alone, waves, kept)
    elif len(job.items) == 1:
        text = _message(item, first, alone, ["the same run, once more, passed: it is not deterministic"])
    else:
        text = _behind(item, first, job, waves, kept)
    return text


def _message(
    item: Item, outcome: Outcome, job: Job, said: Sequence[str] = (), kept: Path | None = None
) -> str:
    """What is shown of a failure: what failed, what the other runs `said`, where its files are."""
    lines = [f"{item.id}: {outcome.kind}", outcome.text, *(f"({line})" for line in said)]
    lines.append(f"seed {job.seed}" + (f", log {relative(kept / 'log.txt')}" if kept else ""))
    if kept and (kept / "waves" / VCD).is_file():
        lines.append(f"waves in {relative(kept / 'waves' / VCD)}")
    return "\n".join([*lines, f"repeat with: {job.repro}"])


def _fails(item: Item, outcome: Outcome, job: Job, waves: bool, kept: Path) -> str:
    """Of a failure that `job` shows each time; the items before `item` are what it needs."""
    said = [f"fails only behind {_names(job.items[:-1])}; alone it passes"] if len(job.items) > 1 else []
    if told := hint(outcome.text, job.design):
        return _message(item, outcome, job, [*said, told], kept)
    if waves and outcome.kind != MISSING and not outcome.text.startswith(TIMEOUT):
        try:
            seen = simulate(replace(job, waves=True), kept / "waves")[item]
        except SimError as error:
            seen = Outcome(MISSING, str(error).splitlines()[0])
        if seen.good:
            said.append(f"not reproduced with waves: there it {seen.kind}")
        elif seen.kind == MISSING:
            said.append(f"no waves: {seen.text}")
        elif seen.headline != outcome.headline:
            said.append(f"not reproduced with waves: there it says {seen.headline}")
    return _message(item, outcome, job, said, kept)


def _behind(item: Item, first: Outcome, job: Job, waves: bool, kept: Path) -> str:
    """Of a test that passes alone but failed in a process with others."""
    again = tried(job)[item]
    if again.good:
        said = ["alone it passes, and in the same group, once more, too: it is not deterministic"]
        return _message(item, first, job, said)
    before = job.items[: job.items.index(item)]
    if not before:
        return _message(item, again, job, [f"alone it passes; fails only before {_names(job.items[1:])}"])
    culprits = (*narrowed(job, before, item), item)
    return _fails(item, again, replace(job, items=culprits), waves, kept)


def _names(items: Sequence[Item]) -> str:
    return ", ".join(item.id for item in items)
