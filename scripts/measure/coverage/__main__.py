"""`make coverage`: run the simulations of `make test` with counting builds and write docs/coverage.md.

A sample (T=…) is written to build/coverage.md instead. The exit code is 1 if a test fails. Without T it is
also 1 if less than 98 % of the lines or branches of a folder are covered, or a folder has a hole without an
explanation.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterable

from cocotb_tests.harness.project import BUILD, DOCS, console, relative
from cocotb_tests.harness.project import run as guarded
from scripts.measure.campaign.cluster import add_arguments, workers_of
from scripts.measure.campaign.jobs import Campaign, Done, Job
from scripts.measure.campaign.run import run
from scripts.measure.campaign.store import Store
from scripts.measure.campaign.tree import SIMULATED, tree
from scripts.measure.coverage.page import page
from scripts.measure.coverage.points import BRANCH, LINE, Points
from scripts.measure.coverage.sums import Sums
from scripts.measure.coverage.work import groups, run_group

NAME = "coverage"


def on_file(jobs: Iterable[Job]) -> list[Done]:
    """Return the last good result of each job, even if the result is from other sources."""
    keys = {job.key for job in jobs}
    with Store() as store:
        return list(
            {done.key: done for _, done in store.all(NAME) if done.good and done.key in keys}.values()
        )


def main() -> int:
    """Run the command line; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m scripts.measure.coverage", description=__doc__)
    parser.add_argument("-k", metavar="T", default="", help="a sample: tests whose name contains T (or a,b)")
    parser.add_argument(
        "--so-far", action="store_true", help="run nothing; write the page from stored results"
    )
    add_arguments(parser)
    args = parser.parse_args()
    words = [word for word in args.k.split(",") if word]
    every = groups(words)
    whole = sum(map(len, every if not words and not args.so_far else groups()))
    stamp = tree(SIMULATED)
    # Large groups cover most of the RTL. They run first, in case the run is interrupted.
    every.sort(key=len, reverse=True)
    jobs = [Job(f"{tests[0]} {len(tests)}", tests, stamp) for tests in every]
    points, crosses, failed, tests = Points(), Counter[str](), 0, 0
    campaign = Campaign(NAME, run_group, jobs, len(jobs), "groups of tests")
    for done in on_file(jobs) if args.so_far else run(campaign, workers_of(args), args.fresh):
        if not done.good:
            failed += 1
            console.print(done.data["message"], markup=False)
        if "points" in done.data:
            points.add(Points.unpack(done.data["points"]))
            crosses.update(done.data["crosses"])
            tests += done.data["tests"]
    sums = Sums(points)
    sample = bool(words) or args.so_far
    path = BUILD / "coverage.md" if words or failed else DOCS / "coverage.md"
    path.write_text(page(sums, crosses, tests, whole, args.so_far), encoding="utf-8")
    bad = [
        f"{folder}: {kind} {figure.percent:.1f} %, {figure.all - figure.reached - figure.known} holes open"
        for folder in sums.folders()
        for kind in (LINE, BRANCH)
        if not (figure := sums.figure(folder, kind)).good
    ]
    for line in bad:
        console.print(line, markup=False)
    console.print(f"{tests} tests, {failed} groups failed; {relative(path)} written")
    return 1 if failed or (bad and not sample) else 0


if __name__ == "__main__":
    raise SystemExit(guarded(main))
