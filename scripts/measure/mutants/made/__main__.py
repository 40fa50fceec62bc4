"""`make mutate`: run proofs and tests on each mutant of rtl/ until one fails.

A run of all mutants first replays recorded tests into them (`replay`), and proves that some behave like the
RTL (`equal`). It writes docs/mutants.md if all folders are included, else build/mutants.md. A killed or equal
mutant is not tried again while the source file that it mutates is unchanged (docs/killed.json); survivors are
tried again when the sources have changed. The exit code is 1 if a mutant does not compile, or if a folder's
score is below its goal.
"""

from __future__ import annotations

import argparse
from collections.abc import Container, Sequence
from pathlib import Path

from cocotb_tests.harness.project import BUILD, DOCS, ProjectError, console, relative
from cocotb_tests.harness.project import run as guarded
from scripts.measure.campaign.cluster import Workers, add_arguments, workers_of
from scripts.measure.campaign.jobs import Campaign, Done, Job
from scripts.measure.campaign.run import run
from scripts.measure.campaign.store import Store
from scripts.measure.campaign.tree import SIMULATED, tree
from scripts.measure.mutants.made import equal, killed, replay
from scripts.measure.mutants.made.chosen import folder_of, rtl_files, sample
from scripts.measure.mutants.made.faults import Fault
from scripts.measure.mutants.made.killed import NAME
from scripts.measure.mutants.made.page import QUICK, SO_FAR, Tried, page, score
from scripts.measure.mutants.made.suites import Suites
from scripts.measure.mutants.made.work import ALIVE, BROKEN, EQUAL, KILLED, Bulk, Mutant, digest, run_one

GOAL, LEAST = 95.0, 70.0
"""Required score of a folder in %: with more than SMALL mutants, and with SMALL or fewer."""
SMALL = 50
NOT_GUIDED = "run `make coverage` first to make this much faster"


def in_bulk(chosen: Sequence[tuple[str, Fault]], workers: Workers) -> None:
    """Store the mutants that a recorded test kills, then those that are proved equal to the RTL."""
    for name, function, verdict in (("replay", replay.replayed, KILLED), ("equal", equal.equal, EQUAL)):
        with Store() as store:
            done = killed.known(store)
        jobs: dict[str, list[tuple[str, int]]] = {}
        for file, fault in chosen:
            if f"{file} {fault.number}" not in done:
                key = str(Path(file).parent) if verdict == KILLED else file
                jobs.setdefault(key, []).append((file, fault.number))
        if jobs and verdict == KILLED:
            replay.record(workers.count)
        todo = [Job(key, Bulk(tuple(mutants))) for key, mutants in jobs.items()]
        for one in run(Campaign(name, function, todo, len(todo), "files"), workers):
            for mutant, test in one.data.get("found", {}).items():
                killed.note(mutant, verdict, test)
            killed.save()


def on_file(keys: Container[str]) -> list[Done]:
    """Return the last result of each of these mutants whose file has not changed since that result."""
    with Store() as store:
        found = {done.key: done for _, done in store.all(NAME) if done.key in keys and "file" in done.data}
    return [done for done in found.values() if done.data["file"] == digest(done.key.split(" ")[0])]


def main() -> int:
    """Run the command line; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m scripts.measure.mutants.made", description=__doc__)
    parser.add_argument(
        "-k", metavar="T", default="", help="a folder of rtl/, or files whose path contains T"
    )
    parser.add_argument("--count", type=int, help="number of mutants of each folder (default: all)")
    parser.add_argument(
        "--so-far", action="store_true", help="run nothing; write the page from stored results"
    )
    parser.add_argument("--quick", action="store_true", help="only the first two batches of tests")
    add_arguments(parser)
    args = parser.parse_args()
    if args.count is not None and args.count < 1:
        raise ProjectError("--count must be 1 or more")
    files = rtl_files(args.k)
    chosen = list(sample(files, args.count))
    if not args.fresh:
        killed.load()
    if args.count is None and not (args.so_far or args.quick or args.fresh):
        in_bulk(chosen, workers_of(args))
    suites = None if args.so_far else Suites()
    with Store() as store:
        old = {} if args.fresh else {key: stamp for key, (stamp, _) in killed.known(store).items()}
    stamp = tree(SIMULATED)
    faults = {}
    jobs = []
    for file, fault in chosen:
        groups = suites.of(file, fault.line) if suites else []
        first = args.quick or bool(Tried(file, fault, "", "").why)
        mutant = Mutant(file, fault, tuple(groups[:2] if first else groups), briefly=first)
        faults[mutant.key] = (file, fault)
        jobs.append(Job(mutant.key, mutant, old.get(mutant.key, f"{stamp}{' quick' * first}")))
    tried = []
    campaign = Campaign(NAME, run_one, jobs, len(jobs), "mutants")
    for done in on_file(faults) if args.so_far else run(campaign, workers_of(args), args.fresh):
        file, fault = faults[done.key]
        one = Tried(file, fault, done.data.get("verdict", BROKEN), done.data.get("test", ""))
        tried.append(one)
        if one.verdict in (ALIVE, BROKEN) and not one.why:
            console.print(f"{one.verdict}: {file}:{fault.line}: {fault.what}: {one.source}", markup=False)
            if one.verdict == BROKEN:
                console.print(f"  {one.test or done.data.get('message', '')}", markup=False)
    if not args.fresh:
        killed.save()
    tried.sort(key=lambda one: (one.file, one.fault.number))
    path = BUILD / "mutants.md" if args.k else DOCS / "mutants.md"
    note = QUICK if args.quick else SO_FAR if args.so_far else ""
    path.write_text(page(tried, files, note), encoding="utf-8")
    bad = 0
    for folder in sorted({folder_of(file) for file in files}):
        mine = [one for one in tried if folder_of(one.file) == folder]
        found = score(mine, len(mine))
        console.print(
            f"{folder}: {found.killed} of {len(mine)} killed, {found.endless} endless, "
            f"{found.equivalent} equivalent, {found.alive} survived"
        )
        goal = LEAST if len(mine) <= SMALL else GOAL
        bad += bool(found.broken) or (found.percent is not None and found.percent < goal)
    hint = "" if suites is None or suites.guided else f" (no stored coverage: {NOT_GUIDED})"
    console.print(f"{relative(path)} written{hint}")
    return 1 if bad else 0


if __name__ == "__main__":
    raise SystemExit(guarded(main))
