"""`make test-gates`: the part's tests on the netlists of both FPGA families, and the board top's by its UART.

First the netlists and simulators that the chosen tests need are built, then the tests run, J at a time. At
the end a table says what each netlist passed. Exit code 0 only if all chosen tests ran and passed.
"""

from __future__ import annotations

import argparse
import resource
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial

from rich import box
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from cocotb_tests.harness import project
from cocotb_tests.harness.build import SimError, build
from cocotb_tests.harness.project import ProjectError, console
from cocotb_tests.harness.runner import SimOptions, attempt
from scripts.flow.gate_suite import GateTest, chosen, everything, left_out
from scripts.pool import as_done

# A failing test runs again with waves, which needs another build: only when few tests were asked for.
WAVES_UP_TO = 20
# Wall-clock limit of a simulation in s: a netlist takes five times as long as the RTL.
LIMIT = {"OPENPPMC_WALL_S": "1500"}


@dataclass(frozen=True)
class Outcome:
    """What a job took in s, of the clock and of all processors, and the message of a failure."""

    test: GateTest
    message: str
    wall: float
    cpu: float


@dataclass
class Row:
    """One netlist in the table."""

    tests: int = 0
    passed: int = 0
    failed: list[str] = field(default_factory=list)
    build: float = 0.0
    run: float = 0.0
    cpu: float = 0.0


def _measured(test: GateTest, work: Callable[[], str]) -> Outcome:
    begin, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    message = work()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Outcome(test, message, time.monotonic() - begin, cpu)


def build_one(test: GateTest) -> Outcome:
    """Make netlist and simulator of this test's row."""

    def work() -> str:
        try:
            build(test.design())
        except (SimError, ProjectError) as error:
            return str(error)
        return ""

    return _measured(test, work)


def run_one(options: SimOptions, test: GateTest) -> Outcome:
    """Run one test."""

    def work() -> str:
        try:
            return attempt(test.item, options, LIMIT, test.design())
        except ProjectError as error:
            return str(error)

    return _measured(test, work)


def run_all(tests: Sequence[GateTest], options: SimOptions, workers: int) -> dict[tuple[str, str], Row]:
    """Build, then run; a netlist that cannot be built fails all its tests. Failures are printed at once."""
    rows: dict[tuple[str, str], Row] = {}
    for test in tests:
        rows.setdefault(test.group, Row()).tests += 1
    first = {test.group: test for test in reversed(tests)}
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
        task = progress.add_task("building netlists", total=len(first))
        broken = set()
        for outcome in as_done(build_one, list(first.values()), workers):
            row = rows[outcome.test.group]
            row.build, row.cpu = outcome.wall, outcome.cpu
            progress.advance(task)
            if outcome.message:
                broken.add(outcome.test.group)
                row.failed = [test.item.id for test in tests if test.group == outcome.test.group]
                console.print(outcome.message, markup=False)
            elif not console.is_terminal:
                console.print(f"built: {' '.join(outcome.test.group)} in {outcome.wall:.0f} s")
        todo = [test for test in tests if test.group not in broken]
        task = progress.add_task("running tests", total=len(todo))
        for outcome in as_done(partial(run_one, options), todo, workers):
            row = rows[outcome.test.group]
            row.run += outcome.wall
            row.cpu += outcome.cpu
            progress.advance(task)
            if outcome.message:
                row.failed.append(outcome.test.item.id)
                console.print(outcome.message, markup=False)
            else:
                row.passed += 1
            if not console.is_terminal and row.passed + len(row.failed) == row.tests:
                console.print(f"done: {' '.join(outcome.test.group)}: {row.passed} of {row.tests} passed")
    return rows


def table(rows: dict[tuple[str, str], Row]) -> Table:
    """Family x configuration, and the sum."""
    shown = Table(title="gate-level tests", title_justify="left", box=box.SIMPLE_HEAD)
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
    """The command line."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.gates", description=(__doc__ or "").split("\n")[0]
    )
    parser.add_argument("-n", type=int, default=2, help="worker processes (default %(default)s)")
    parser.add_argument(
        "-k", metavar="T", help="only tests whose name holds T; quick: the sample that CI runs"
    )
    parser.add_argument("--seed", type=int, help="seed of all simulations; of the random hosts only this one")
    return parser.parse_args()


def main() -> int:
    """Entry point."""
    args = arguments()
    if args.n < 1:
        raise ProjectError("-n must be 1 or more")
    tests = chosen(everything(args.seed), args.k)
    if not tests:
        raise ProjectError(f"no gate-level test matches T={args.k}")
    reasons = left_out()
    begin = time.monotonic()
    options = SimOptions(seed=args.seed, waves_on_failure=len(tests) <= WAVES_UP_TO)
    rows = run_all(tests, options, args.n)
    console.print(table(rows))
    if args.k is None:
        for name, reason in reasons.items():
            console.print(f"not applicable to a netlist: {name} ({reason})")
    failed = [name for row in rows.values() for name in row.failed]
    passed = sum(row.passed for row in rows.values())
    console.print(
        f"{passed} of {len(tests)} gate-level tests passed in {time.monotonic() - begin:.0f} s "
        "(times in the table are sums over the workers)"
    )
    for name in failed[:10]:
        console.print(f"  failed: {name}", markup=False)
    if len(failed) > 10:
        console.print(f"  and {len(failed) - 10} more")
    return 0 if passed == len(tests) else 1


if __name__ == "__main__":
    sys.exit(project.run(main))
