"""`make soak PART= SEED= COUNT=`: compare any number of random-host runs with the golden model.

The column `soak` of the table of parts defines the meaning of a seed; PART=all runs all parts one after
the other. The seeds form one campaign, which is divided into blocks. A later run of the same part on the
same sources, with more seeds or after an interruption, reuses passed blocks. A failure does not stop the
other seeds. At the end, the failing seeds are listed with the command that repeats each. The exit code is
1 if a seed failed.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Protocol

from cocotb_tests.harness.compare import counts_text
from cocotb_tests.harness.project import ProjectError, console
from cocotb_tests.harness.project import run as guarded
from cocotb_tests.harness.random_items import Played
from openppmc import parts
from scripts.measure.campaign.cluster import Workers, add_arguments, workers_of
from scripts.measure.campaign.jobs import Campaign, Job, Result
from scripts.measure.campaign.run import run

ALL = "all"
BLOCK, LARGE_BLOCK = 25, 250
"""Number of seeds in a job: with fewer than LARGE seeds, and with LARGE or more (longer jobs)."""
LARGE = 10_000


class Hosts(Protocol):
    """Entry of a part in the column `soak` of the table of parts: constrained-random hosts.

    The entry is a `RandomItems`, or an object of a class that runs further checks with a seed.
    """

    def some(self, seeds: Sequence[int]) -> Played:
        """Run these seeds in this process."""
        ...


def hosts(part: str) -> Hosts:
    """Return the constrained-random hosts of a part; raise ProjectError if it has none."""
    known = names()
    if part not in known:
        raise ProjectError(
            f"PART={part}: no random hosts for this part (there are for {', '.join(known)}, {ALL})"
        )
    found: Hosts = parts.part(part).load("soak")
    return found


def names() -> list[str]:
    """Return the parts that have constrained-random hosts (column `soak`)."""
    return [row.name for row in parts.having("soak")]


def some(what: tuple[str, int, int]) -> Result:
    """Run a block of seeds.

    Args:
        what: part, first seed, number of seeds.
    """
    part, first, count = what
    played = hosts(part).some(range(first, first + count))
    return Result(not played.failures, {"failures": played.failures, "compared": dict(played.compared)})


def blocks(first: int, count: int) -> Iterator[tuple[int, int]]:
    """Yield (first seed, number of seeds) of each job. Jobs begin at multiples of the job size."""
    size, end = (LARGE_BLOCK if count >= LARGE else BLOCK), first + count
    while first < end:
        last = min(end, (first // size + 1) * size)
        yield first, last - first
        first = last


def soak(part: str, first: int, count: int, workers: Workers, fresh: bool = False) -> int:
    """Run the seeds of a part; return the exit code."""
    every = list(blocks(first, count))
    jobs = [Job(f"{begin}+{size}", (part, begin, size)) for begin, size in every]
    title = f"{part}, seeds {first}…{first + count - 1} in blocks"
    failures: list[Sequence[str]] = []
    compared: Counter[str] = Counter()
    ended = old = 0
    for done in run(Campaign(f"soak-{part}", some, jobs, len(jobs), title), workers, fresh):
        ended += 1
        old += int(done.key.partition("+")[2]) if done.old else 0
        compared.update(done.data.get("compared", {}))
        for seed, _, message in done.data.get("failures", ()):
            console.print(f"[red]seed {seed} failed[/red]")
            console.print(message, markup=False)
        failures += done.data.get("failures", ())
        if lost := done.data.get("message"):
            failures.append((done.key, "", lost))
    if old:
        console.print(f"{old} of them in earlier runs on the same sources (FRESH=1 repeats them)")
    if failures:
        console.print(f"[red]{len(failures)} of {count} seeds of {part} failed[/red]; to repeat one:")
        for seed, name, _ in sorted(failures):
            line = f"make test T={name} SEED={seed}" if name else f"block {seed} ended its workers"
            console.print(f"  {line}", markup=False)
        return 1
    console.print(f"{part}: {counts_text(compared)}, all equal to the golden model")
    return 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.measure.soak", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("part", nargs="?", default="ppmc104")
    parser.add_argument("--seed", type=int, default=1, help="first seed (default 1)")
    parser.add_argument("--count", type=int, default=1000, help="number of seeds of each part (default 1000)")
    add_arguments(parser)
    given = parser.parse_args(arguments)
    if given.count < 1 or given.seed < 0:
        raise ProjectError("--count must be 1 or more, --seed 0 or more")
    chosen = names() if given.part == ALL else [given.part]
    for part in chosen:
        hosts(part)
    workers = workers_of(given)
    return max([soak(part, given.seed, given.count, workers, given.fresh) for part in chosen])


if __name__ == "__main__":
    sys.exit(guarded(main))
