"""`python -m scripts.mains WORD`: tests of the parts on both main programs of simulations, and whether they
record the same pins, host accesses and output edges. WORD is a part of their names, as with `make test T=`.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.mains import check_mains
from cocotb_tests.harness.project import ProjectError, console, run
from scripts.flow.gate_suite import suites
from scripts.pool import as_done


def items() -> Iterator[Item]:
    """Directed tests, and random hosts by their seeds."""
    for part in suites():
        yield from part.items
        for make, seeds in part.sample.items():
            yield from map(make, seeds)


def compare(item: Item) -> tuple[str, str]:
    """Name of a test, and how it went: "" if it has differed or failed."""
    try:
        return f"{item.id}: the same, recordings: {check_mains(item)}", ""
    except AssertionError as error:
        return item.id, str(error)


def main() -> int:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__, prog="python -m scripts.mains")
    parser.add_argument("word")
    parser.add_argument("-n", type=int, default=2, metavar="WORKERS", help="how many at a time (2)")
    args = parser.parse_args()
    chosen = [item for item in items() if args.word.lower() in item.id.lower()]
    if not chosen:
        raise ProjectError(f"{args.word}: no such test")
    failed = 0
    for name, trouble in as_done(compare, chosen, args.n):
        console.print(trouble or name, markup=False)
        failed += bool(trouble)
    console.print(f"{len(chosen) - failed} of {len(chosen)} the same on both")
    return 1 if failed else 0


if __name__ == "__main__":
    raise SystemExit(run(main))
