"""Runs cocotb tests: directed ones of a build together in one process, all others in one of their own.

All simulations of the project go through here; the traps of the tool chain that shaped it: results.xml must
hold exactly the tests asked for (else nothing ran), exit codes count too, a fired assertion of the RTL is an
error of the test in whose part of the log it stands (`outcome`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from .build import Design, SimError, part_design
from .collect import Item
from .group import run_group
from .inside import seen
from .outcome import PASSED, SKIPPED, XFAILED, Outcome
from .paths import WAVES, relative
from .simulate import REPRO, VCD, Job, repro_line, safe, simulate
from .summary import WAVES_IN
from .verdict import judged
from .views import write_views


@dataclass(frozen=True)
class SimOptions:
    """What the user asked for on the command line; seed None = the fixed default of each test.

    waves: keep a VCD of each test, passing ones too. inside: every signal is visible. group: the items that
    share a simulator process, in order; `done` has the outcomes of those that ran.
    """

    seed: int | None = None
    waves_on_failure: bool = True
    waves: bool = False
    inside: bool = False
    group: tuple[Item, ...] = ()
    done: dict[tuple[Item, ...], dict[Item, tuple[Outcome, Job]]] = field(default_factory=dict, compare=False)


def run_sim(
    design: Design,
    item: Item,
    seed: int,
    waves: bool = False,
    env: Mapping[str, str] | None = None,
    folder: Path | None = None,
    repro: str | None = None,
) -> Path:
    """Build if needed and run one cocotb test in one process; returns the folder of the run.

    `folder` (default below build/runs/) receives log.txt, results.xml and what the test writes.
    Raises SimError unless exactly this test ran and passed, and the process ended well.
    """
    job = Job(design, (item,), seed, waves, {**(env or {}), **({REPRO: repro} if repro else {})})
    folder = folder or job.folder
    outcome = simulate(job, folder)[item]
    if outcome.kind not in (PASSED, XFAILED):
        log = relative(folder / "log.txt")
        raise SimError(
            f"{item.id}: {outcome.kind}\n{outcome.text}\nseed {seed}, log {log}\nrepeat with: {job.repro}"
        )
    return folder


def _job(item: Item, options: SimOptions, env: Mapping[str, str], design: Design | None) -> Job:
    seed = item.seed if options.seed is None else options.seed
    design = seen(design or part_design(item.part, item.config), item.inside, options.inside)
    group = options.group if item in options.group else (item,)
    return Job(design, group, seed, options.waves, env)


def outcome_of(item: Item, options: SimOptions, env: Mapping[str, str], design: Design | None) -> Outcome:
    """What became of an item; the text of one that failed is the whole message.

    The first item of a group that is asked for runs the group.
    """
    try:
        job = _job(item, options, env, design)
        if options.waves:
            return _with_waves(item, job)
        if job.items not in options.done:
            options.done[job.items] = run_group(job)
        outcome, ran = options.done[job.items][item]
        if outcome.good:
            return outcome
        return Outcome(outcome.kind, judged(item, outcome, ran, options.waves_on_failure))
    except SimError as error:
        repro = env.get(REPRO) or repro_line([item], item.seed if options.seed is None else options.seed)
        return Outcome("failed", f"{item.id}: {error}\nrepeat with: {repro}")


def _with_waves(item: Item, job: Job) -> Outcome:
    """Run one item with traces, which stay in build/waves/ with their views."""
    folder = WAVES / safe(item.id)
    outcome = simulate(job, folder)[item]
    views = write_views(folder / VCD, job.design)
    print(WAVES_IN + ", ".join(relative(path) for path in views))
    if outcome.good:
        return outcome
    text = f"{item.id}: {outcome.kind}\n{outcome.text}\nrepeat with: {job.repro} WAVES=1"
    return Outcome(outcome.kind, text)


def attempt(
    item: Item,
    options: SimOptions | None = None,
    env: Mapping[str, str] | None = None,
    design: Design | None = None,
) -> str:
    """Run one item; "" if it passed, else a short message with the repro line.

    `design` (default: the part of the item) is what is simulated.
    """
    outcome = outcome_of(item, options or SimOptions(), env or {}, design)
    return "" if outcome.good else outcome.text


def run_item(
    item: Item,
    options: SimOptions | None = None,
    env: Mapping[str, str] | None = None,
    design: Design | None = None,
) -> None:
    """Run one collected item as a pytest test, which ends as the cocotb test did."""
    __tracebackhide__ = True
    if item.skipped:
        pytest.skip(item.skipped)
    outcome = outcome_of(item, options or SimOptions(), env or {}, design)
    if outcome.kind == SKIPPED:
        pytest.skip(outcome.text)
    if outcome.kind == XFAILED:
        pytest.xfail(outcome.text)
    if not outcome.good:
        pytest.fail(outcome.text, pytrace=False)
