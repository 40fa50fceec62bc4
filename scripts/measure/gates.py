"""`make test-gates`: the part tests on the netlists of both FPGA families, and the tests of the board top.

The board top is tested through its UART. `make test-verilog` (--plain) runs the same tests on the plain
Verilog of `make verilog`. `make test-bits` (--bits) runs board tests on bitstreams that are converted back to
netlists.

First, the netlists and simulators for the selected tests are built. Then the tests run as a campaign, J at a
time. After an interruption, the next run continues where it ended. Finally, a table lists the results of each
netlist. The exit code is 0 only if all selected tests ran and passed.
"""

from __future__ import annotations

import argparse
import resource
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from rich import box
from rich.table import Table

from cocotb_tests.harness import project
from cocotb_tests.harness.build import ICARUS, ICARUS_MISSING, SimError, build, icarus_installed, sim_main
from cocotb_tests.harness.project import ProjectError, console
from cocotb_tests.harness.runner import SimOptions, attempt
from scripts.fpga.flow import bits, gates, plain
from scripts.measure.campaign.cluster import Workers, add_arguments, workers_of
from scripts.measure.campaign.jobs import Campaign, Done, Job, Result
from scripts.measure.campaign.run import run
from scripts.measure.gate_suite import GateTest, chosen, everything, left_out

# If at most this number of tests run, a failing test runs again with waves, which requires a build.
WAVES_UP_TO = 20
# Wall-clock limit of a simulation in s; a netlist is simulated at a fifth of the speed of the RTL.
LIMIT = {"OPENPPMC_WALL_S": "1500"}


@dataclass
class Row:
    """Row of a netlist in the table; `old` is the number of tests that passed earlier on the same sources."""

    tests: int = 0
    passed: int = 0
    failed: list[str] = field(default_factory=list)
    build: float = 0.0
    run: float = 0.0
    cpu: float = 0.0
    old: int = 0


def _measured(work: Callable[[], str]) -> Result:
    """Return a result with the message of a failure, wall time and processor time in s."""
    begin, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    message = work()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Result(not message, {"message": message, "wall": time.monotonic() - begin, "cpu": cpu})


def build_one(test: GateTest) -> Result:
    """Build the netlist and the simulator for the row of this test."""

    def work() -> str:
        try:
            build(test.design())
        except (SimError, ProjectError) as error:
            return str(error)
        return ""

    return _measured(work)


def run_one(what: tuple[GateTest, int | None, bool]) -> Result:
    """Run one test.

    Args:
        what: test, seed of the simulations, and True if a failed test must run again with waves.
    """
    test, seed, waves = what

    def work() -> str:
        try:
            options = SimOptions(seed=seed, waves_on_failure=waves and not test.flipped)
            return test.result(attempt(test.item, options, LIMIT, test.design()))
        except ProjectError as error:
            return str(error)

    return _measured(work)


def _named(campaign: str) -> str:
    """Return the name of a campaign. The results for each main program and simulator are separate."""
    return campaign if sim_main() == "own" else f"{campaign}-{sim_main()}"


def build_all(tests: Sequence[GateTest], rows: dict[tuple[str, str], Row], workers: Workers) -> None:
    """Build each row's netlist; if a build fails, all its tests fail."""
    first = {" ".join(test.group): test for test in reversed(tests)}
    jobs = [Job(name, test) for name, test in first.items()]
    # Stored results of builds are never reused, because they do not show that the builds still exist on disk.
    for done in run(
        Campaign(_named("gates-build"), build_one, jobs, len(jobs), "building netlists"), workers, True
    ):
        row = rows[first[done.key].group]
        row.build, row.cpu = done.data.get("wall", 0.0), done.data.get("cpu", 0.0)
        if done.good:
            if not console.is_terminal:
                console.print(f"built: {done.key} in {row.build:.0f} s")
            continue
        row.failed = [test.item.id for test in tests if test.group == first[done.key].group]
        console.print(done.data["message"], markup=False)


def run_all(
    tests: Sequence[GateTest], seed: int | None, workers: Workers, fresh: bool = False
) -> dict[tuple[str, str], Row]:
    """Build the netlists, then run the tests; print failures immediately."""
    rows: dict[tuple[str, str], Row] = {}
    for test in tests:
        rows.setdefault(test.group, Row()).tests += 1
    build_all(tests, rows, workers)
    todo = {f"{test.item.id} {seed}": test for test in tests if not rows[test.group].failed}
    waves = len(tests) <= WAVES_UP_TO
    jobs = [Job(key, (test, seed, waves)) for key, test in todo.items()]
    for done in run(Campaign(_named("gates"), run_one, jobs, len(jobs), "running tests"), workers, fresh):
        _add(rows[todo[done.key].group], todo[done.key], done)
    return rows


def _add(row: Row, test: GateTest, done: Done) -> None:
    row.run += done.data.get("wall", 0.0)
    row.cpu += done.data.get("cpu", 0.0)
    row.old += done.old
    if done.good:
        row.passed += 1
    else:
        row.failed.append(test.item.id)
        console.print(done.data["message"], markup=False)
    if not console.is_terminal and row.passed + len(row.failed) == row.tests:
        console.print(f"done: {' '.join(test.group)}: {row.passed} of {row.tests} passed")


def table(rows: dict[tuple[str, str], Row], title: str = "gate-level tests") -> Table:
    """Return the table of families and configurations, with the total."""
    shown = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD)
    for head in ("family", "configuration"):
        shown.add_column(head)
    for head in ("tests", "passed", "failed", "build / s", "run / s", "CPU / s"):
        shown.add_column(head, justify="right")
    total = Row()
    for (family, config), row in [*rows.items(), (("total", ""), total)]:
        if row is total:
            shown.add_section()
        else:
            total.tests += row.tests
            total.passed += row.passed
            total.failed += row.failed
            total.build += row.build
            total.run += row.run
            total.cpu += row.cpu
        times = (f"{seconds:.0f}" for seconds in (row.build, row.run, row.cpu))
        style = "bold red" if row.failed else "bold" if row is total else None
        figures = (str(row.tests), str(row.passed), str(len(row.failed)))
        shown.add_row(family, config, *figures, *times, style=style)
    return shown


def arguments() -> argparse.Namespace:
    """Parse the command line."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.measure.gates", description=(__doc__ or "").split("\n")[0]
    )
    add_arguments(parser)
    parser.add_argument("-k", metavar="T", help="only tests whose name contains T; quick: the sample of CI")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--plain", action="store_true", help="plain Verilog instead of netlists")
    which.add_argument("--bits", action="store_true", help="bitstreams of the iCEBreaker instead of netlists")
    parser.add_argument(
        "--seed", type=int, help="seed of all simulations; only the random host with this seed"
    )
    return parser.parse_args()


def main() -> int:
    """Run the command line."""
    args = arguments()
    try:
        four_state = sim_main() == ICARUS
    except ValueError as error:
        raise ProjectError(str(error)) from None
    if four_state and not icarus_installed():
        console.print(f"skipped: {ICARUS_MISSING}")
        return 0
    if args.bits and not bits.installed():
        console.print(f"skipped: {bits.MISSING}")
        return 0
    workers = workers_of(args)
    families = (plain.FAMILY,) if args.plain else (gates.BITS,) if args.bits else gates.FAMILIES
    what = {plain.FAMILY: "tests on plain Verilog", gates.BITS: "tests on bitstreams"}.get(
        families[0], "gate-level tests"
    )
    tests = chosen(everything(args.seed, families), args.k, four_state)
    if not tests:
        raise ProjectError(f"{what}: no test matches T={args.k}")
    reasons = {} if args.bits else left_out()
    begin = time.monotonic()
    rows = run_all(tests, args.seed, workers, args.fresh)
    console.print(table(rows, what))
    if args.k is None:
        for name, reason in reasons.items():
            console.print(f"not applicable to a netlist: {name} ({reason})")
    failed = [name for row in rows.values() for name in row.failed]
    passed = sum(row.passed for row in rows.values())
    console.print(
        f"{passed} of {len(tests)} {what} passed in {time.monotonic() - begin:.0f} s "
        "(times in the table are sums over the workers)"
    )
    if old := sum(row.old for row in rows.values()):
        console.print(f"{old} of them in an earlier run on the same sources (FRESH=1 runs them again)")
    for name in failed[:10]:
        console.print(f"  failed: {name}", markup=False)
    if len(failed) > 10:
        console.print(f"  and {len(failed) - 10} more")
    return 0 if passed == len(tests) else 1


if __name__ == "__main__":
    sys.exit(project.run(main))
