"""`make fire COUNT=n SEED=n`: run sessions of the drivers on lines with faults, and check what they state.

The seed of a session selects the damaged byte and the kind of the fault, so consecutive seeds damage every
byte of a session; see `sweep.faults_of`. The sessions are divided into blocks, and a later run on the same
sources reuses passed blocks. The exit code is 1 if a driver stated something untrue.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Sequence

from cocotb_tests.harness.project import ProjectError, console
from cocotb_tests.harness.project import run as guarded
from scripts.measure.campaign.cluster import add_arguments, workers_of
from scripts.measure.campaign.jobs import Campaign, Job, Result
from scripts.measure.campaign.run import run
from scripts.measure.fire.boards import TARGETS
from scripts.measure.fire.sweep import Played as Played
from scripts.measure.fire.sweep import play

BLOCK = 200
"""Number of sessions in a job."""


def block(what: tuple[str, int, int]) -> Result:
    """Run sessions.

    Args:
        what: key of TARGETS, first seed, number of seeds.
    """
    name, first, count = what
    outcomes: Counter[str] = Counter()
    failures, longest, begin = [], 0.0, time.process_time()
    for seed in range(first, first + count):
        done = play(name, seed)
        outcomes[done.outcome] += 1
        longest = max(longest, done.longest)
        if done.error:
            failures.append(f"{name}, seed {seed}: {done.error}")
    seconds = time.process_time() - begin
    return Result(
        not failures,
        {"outcomes": dict(outcomes), "failures": failures, "longest": longest, "seconds": seconds},
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.measure.fire", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("only", nargs="?", choices=TARGETS, help="only this board")
    parser.add_argument("--seed", type=int, default=0, help="first seed (default 0)")
    parser.add_argument("--count", type=int, default=10_000, help="number of sessions on all boards together")
    add_arguments(parser)
    given = parser.parse_args(arguments)
    if given.count < 1 or given.seed < 0:
        raise ProjectError("--count must be 1 or more, --seed 0 or more")
    names = [given.only] if given.only else list(TARGETS)
    end = given.seed + -(-given.count // len(names))
    jobs = [
        Job(f"{name} {first}+{min(BLOCK, end - first)}", (name, first, min(BLOCK, end - first)))
        for first in range(given.seed, end, BLOCK)
        for name in names
    ]
    outcomes: Counter[str] = Counter()
    failures: list[str] = []
    longest = seconds = 0.0
    for done in run(
        Campaign("fire", block, jobs, len(jobs), "blocks of sessions"), workers_of(given), given.fresh
    ):
        outcomes.update(done.data.get("outcomes", {}))
        failures += done.data.get("failures", [done.data.get("message", "")])
        longest = max(longest, done.data.get("longest", 0.0))
        seconds += done.data.get("seconds", 0.0)
    console.print(
        ", ".join(f"{number} {outcome}" for outcome, number in outcomes.most_common()), markup=False
    )
    rate = sum(outcomes.values()) / max(seconds, 1e-9)
    console.print(
        f"{sum(outcomes.values())} sessions, {rate:.1f} per CPU second, longest call {longest:.1f} s"
    )
    for failure in failures:
        console.print(failure, markup=False)
    console.print(f"{len(failures)} wrong statements")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(guarded(main))
