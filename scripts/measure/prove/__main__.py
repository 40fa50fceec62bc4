"""Prove properties of the RTL blocks: `python -m scripts.measure.prove [NAME,...]`.

Without a name, it runs the quick proofs whose RTL or properties have changed since the proof last held
(docs/proved.json). With `--fresh`, it runs all quick proofs, with `--night` all proofs. `--break` makes each
change of RTL that the entry `breaks` of a proof states, and expects the proof to fail. The exit code is 1 if
a result differs from the expected one.
"""

from __future__ import annotations

import argparse
from concurrent.futures import ThreadPoolExecutor, as_completed

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from cocotb_tests.harness.project import console, run
from scripts.measure.prove.check import LIMIT, Outcome, check
from scripts.measure.prove.engine import abc
from scripts.measure.prove.results import changed, keep
from scripts.measure.prove.table import Change, chosen


def line(outcome: Outcome, change: Change | None) -> str:
    """Return the line that is printed for the outcome of a proof."""
    took = f"{outcome.seconds:.1f} s"
    if change:
        found = f"{'found     ' if outcome.refuted else 'NOT FOUND '} {outcome.name}.{change.name}"
        return f"{found}: {outcome.trouble or 'all properties hold'} ({took})"
    if outcome.trouble:
        again = f"\n         again: make prove T={outcome.name}"
        return f"FAILED   {outcome.name}: {outcome.trouble} ({took}){again}"
    covers = ", ".join(f"{label} in {clk} cycles" for label, clk in outcome.reached)
    return f"proved   {outcome.name}: {len(outcome.labels)} properties; {covers} ({took})"


def main() -> int:
    """Run the command line; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, prog="python -m scripts.measure.prove")
    parser.add_argument("names", nargs="*", metavar="NAME[,NAME]")
    parser.add_argument("-n", type=int, default=2, metavar="WORKERS", help="number of parallel proofs (2)")
    parser.add_argument("--night", action="store_true", help="run all proofs, also the long ones")
    parser.add_argument("--fresh", action="store_true", help="also run proofs of unchanged RTL")
    parser.add_argument(
        "--break", dest="breaking", action="store_true", help="break the RTL; each proof must fail"
    )
    parser.add_argument(
        "--limit", type=int, default=LIMIT, metavar="S", help=f"limit of a run in s ({LIMIT})"
    )
    args = parser.parse_args()
    todo = chosen([word for words in args.names for word in words.split(",")], args.night)
    every = len(todo)
    if not (args.names or args.night or args.fresh or args.breaking):
        todo = changed(todo)
    abc()
    runs = [(proof, change) for proof in todo for change in (proof.broken() if args.breaking else [None])]
    bad = 0
    shown = TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn()
    # Threads are sufficient, because each thread waits for another program.
    with (
        ThreadPoolExecutor(args.n) as pool,
        Progress(*shown, console=console, disable=not console.is_terminal) as progress,
    ):
        task = progress.add_task("breaking" if args.breaking else "proving", total=len(runs))
        jobs = {pool.submit(check, proof, args.limit, change): (proof, change) for proof, change in runs}
        for job in as_completed(jobs):
            outcome = job.result()
            proof, change = jobs[job]
            console.print(line(outcome, change), markup=False, soft_wrap=True)
            bad += not (outcome.refuted if change else outcome.good)
            progress.advance(task)
            if not change:
                keep(outcome, proof)
    what = "found" if args.breaking else "proved"
    console.print(
        f"{len(runs) - bad} of {len(runs)} {what}, {every - len(todo)} unchanged since they were proved"
    )
    return 1 if bad else 0


if __name__ == "__main__":
    raise SystemExit(run(main))
