"""`make fuzz COUNT=n SEED=n`: send valid and invalid frames to the deframers of RTL and golden models.

Both deframers must report the same requests, instructions and faults at the same characters.

A seed defines a block of characters for each line, with silences and characters without a stop bit. A later
run on the same sources reuses passed blocks. The exit code is 1 if there is a difference.
"""

from __future__ import annotations

import argparse
import random
import sys
from collections import Counter
from collections.abc import Sequence

from cocotb_tests.harness.compare import counts_text
from cocotb_tests.harness.project import ProjectError, console
from cocotb_tests.harness.project import run as guarded
from scripts.measure.campaign.cluster import add_arguments, workers_of
from scripts.measure.campaign.jobs import Campaign, Job, Result
from scripts.measure.campaign.run import run
from scripts.measure.fuzz.bench import difference, shrink_report
from scripts.measure.fuzz.lines import LINES
from scripts.measure.fuzz.words import stream

BLOCK = 250_000
"""Number of characters in the block of a seed."""


def play(what: tuple[str, int, int]) -> Result:
    """Run a block.

    Args:
        what: line, seed, number of characters.
    """
    name, seed, size = what
    line = LINES[name]
    words = stream(random.Random(f"{name} {seed}"), size, line.good, line.special)
    if difference(name, line, words) is not None:
        return Result(False, {"message": f"seed {seed}: {shrink_report(name, line, words)}"})
    return Result(
        True, {"compared": {f"{name} bytes": len(words), "events": sum(1 for _ in line.expected(words))}}
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.measure.fuzz", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("--seed", type=int, default=1, help="first seed (default 1)")
    parser.add_argument(
        "--count", type=int, default=len(LINES) * BLOCK, help="number of characters for all lines together"
    )
    add_arguments(parser)
    given = parser.parse_args(arguments)
    if given.count < 1 or given.seed < 0:
        raise ProjectError("--count must be 1 or more, --seed 0 or more")
    each = -(-given.count // len(LINES))
    seeds = range(given.seed, given.seed + -(-each // BLOCK))
    size = min(each, BLOCK)
    jobs = [Job(f"{name} {seed} {size}", (name, seed, size)) for seed in seeds for name in LINES]
    compared: Counter[str] = Counter()
    failures = []
    for done in run(
        Campaign("fuzz", play, jobs, len(jobs), "blocks of characters"), workers_of(given), given.fresh
    ):
        compared.update(done.data.get("compared", {}))
        if not done.good:
            failures.append(done.data["message"])
            console.print(f"[red]{done.data['message']}[/red]", markup=True)
    console.print(
        f"{counts_text(compared)}, {'all' if not failures else 'the others'} equal to the golden models"
    )
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(guarded(main))
