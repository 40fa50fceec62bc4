"""Show which directed test kills each hand-made mutant: `python -m scripts.measure.mutants [WORD...]`.

The changed file is written to build/mutants/, never to rtl/. The output has a line for each mutant: the test
that fails, and the kind of the failure (see `table`). The exit code is 1 if the result of a mutant differs
from its entry.
"""

from __future__ import annotations

import argparse

from cocotb_tests.harness.build import SimError
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.project import ProjectError, console
from cocotb_tests.harness.project import run as guarded
from cocotb_tests.harness.runner import run_group
from cocotb_tests.harness.simulate import Job as Simulation
from cocotb_tests.harness.simulate import Outcome
from scripts.measure.campaign.cluster import add_arguments, workers_of
from scripts.measure.campaign.jobs import Campaign, Job, Result
from scripts.measure.campaign.run import run
from scripts.measure.mutants.table import Mutant, mutants

CHECK, COMPARISON, ASSERTION, HANGS = "check", "comparison", "assertion", "no end"
BATCH = 8
"""Number of tests in one process. After a process in which a test fails, no other process starts."""


def cause(outcome: Outcome) -> str:
    """Return the kind of a failure: a check of the test, an assertion of the RTL, or the comparison."""
    compared = ": first difference at edge" in outcome.headline
    if outcome.kind != "failed":
        return HANGS
    if "%Error" in outcome.headline or (compared and "%Error" in outcome.text):
        return ASSERTION
    return COMPARISON if compared else CHECK


def failing(mutant: Mutant, items: list[Item]) -> dict[Item, Outcome]:
    """Return the failing tests of the first process in which a test fails."""
    for at in range(0, len(items), BATCH):
        job = Simulation(
            mutant.design(items[0]), tuple(items[at : at + BATCH]), 1, env={"OPENPPMC_WALL_S": "120"}
        )
        bad = {item: outcome for item, (outcome, _) in run_group(job).items() if not outcome.good}
        if bad:
            return bad
    return {}


def find_tests(mutant: Mutant, wide: bool) -> dict[Item, Outcome]:
    """Return the tests that fail with the mutant.

    The test that the entry lists runs first. If it does not fail, the tests that the words of the entry
    select run, and then, with `wide`, all tests of the build.
    """
    items, every = mutant.items(), mutant.items(wide=True)
    listed = [item for item in every if item.test == mutant.caught]
    return failing(mutant, listed) or failing(mutant, items) or (failing(mutant, every) if wide else {})


def check_entry(what: tuple[Mutant, bool]) -> Result:
    """Test a mutant; return whether it is caught or survives as listed, and a one-line summary."""
    right, line = _check_entry(*what)
    return Result(right, {"line": line})


def _check_entry(mutant: Mutant, wide: bool) -> tuple[bool, str]:
    try:
        bad = find_tests(mutant, wide)
    except (SimError, ValueError) as error:
        return False, f"{mutant.id}: {error}"
    if not bad:
        return not mutant.caught, f"{mutant.id}: survives{mutant.why and f' ({mutant.why})'}"
    causes = {item: cause(outcome) for item, outcome in bad.items()}
    # Prefer a check of a test, because it names the rule.
    first = min(bad, key=lambda item: causes[item] != CHECK)
    right = (first.test, causes[first]) == (mutant.caught, mutant.by)
    return right, f"{mutant.id}: {first.test}, {causes[first]}: {bad[first].headline[:150]}"


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(description=__doc__, prog="python -m scripts.measure.mutants")
    parser.add_argument("words", nargs="*", metavar="WORD")
    add_arguments(parser)
    parser.add_argument("--wide", action="store_true", help="run all tests of its build on a survivor")
    args = parser.parse_args()
    chosen = [one for one in mutants() if not args.words or any(word in one.id for word in args.words)]
    if not chosen:
        raise ProjectError(f"{' '.join(args.words)}: no such mutant")
    wrong = 0
    jobs = [Job(f"{one.id}{' wide' if args.wide else ''}", (one, args.wide)) for one in chosen]
    for done in run(Campaign("mutants", check_entry, jobs, len(jobs)), workers_of(args), args.fresh):
        line = done.data.get("line") or f"{done.key}: {done.data['message']}"
        console.print(
            f"{'as listed' if done.good else 'NOT AS LISTED'}  {line}", markup=False, soft_wrap=True
        )
        wrong += not done.good
    console.print(f"{len(chosen) - wrong} of {len(chosen)} mutants as listed")
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(guarded(main))
