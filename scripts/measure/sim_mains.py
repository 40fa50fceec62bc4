"""Run tests of the parts on both main programs of simulations: `python -m scripts.measure.sim_mains WORD`.

Both programs must record the same pins, host accesses and output edges. WORD is a part of a test name, as for
`make test T=`.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.project import ProjectError, console
from cocotb_tests.harness.project import run as guarded
from cocotb_tests.harness.runner import check_mains
from scripts.measure.campaign.cluster import add_arguments, workers_of
from scripts.measure.campaign.jobs import Campaign, Job, Result
from scripts.measure.campaign.run import run
from scripts.measure.gate_suite import suites


def items() -> Iterator[Item]:
    """Yield the directed tests, and the tests with random hosts, each with its seed."""
    for part in suites():
        yield from part.items
        for make, seeds in part.sample.items():
            yield from map(make, seeds)


def compare(item: Item) -> Result:
    """Run a test on both main programs; return the result with a message of one line."""
    try:
        return Result(True, {"message": f"{item.id}: the same, recordings: {check_mains(item)}"})
    except AssertionError as error:
        return Result(False, {"message": str(error)})


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__, prog="python -m scripts.measure.sim_mains")
    parser.add_argument("word")
    add_arguments(parser)
    args = parser.parse_args()
    chosen = [item for item in items() if args.word.lower() in item.id.lower()]
    if not chosen:
        raise ProjectError(f"{args.word}: no such test")
    failed = 0
    campaign = Campaign("mains", compare, [Job(item.id, item) for item in chosen], len(chosen))
    for done in run(campaign, workers_of(args), args.fresh):
        console.print(done.data["message"], markup=False)
        failed += not done.good
    console.print(f"{len(chosen) - failed} of {len(chosen)} the same on both")
    return 1 if failed else 0


if __name__ == "__main__":
    raise SystemExit(guarded(main))
