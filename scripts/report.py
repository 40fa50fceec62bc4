"""`make report`: size and clock rate of part, board top and bitstreams; `--check` compares the sizes alone.

The report places and routes everything with five seeds, writes the table into docs/benchmarks.md and the
sizes as synthesized into docs/sizes.json; without --part it renews the sizes of the bridges, too. The check
(`make size`) synthesizes only and fails on growth; the boards' bitstreams only with --part. `--accept` makes
the sizes of now the committed ones, without place and route.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from cocotb_tests.harness import project
from cocotb_tests.harness.project import console, fail
from openppmc.parts import tops
from scripts import bridges
from scripts.flow import size_page, sizes, targets
from scripts.flow.netlist import Count
from scripts.flow.synthesis import SEEDS, all_seeds, synthesize
from scripts.flow.targets import Target
from scripts.flow.yosys_job import BEST

Tell = Callable[[str], None]


def measured(wanted: list[Target], tell: Tell) -> tuple[sizes.Sizes, list[tuple[Count, Path]]]:
    """Sizes as docs/sizes.json holds them, and count and netlist of each target."""
    found = targets.synthesize_all(
        wanted, lambda target: tell(f"synthesized: {target.design}, {target.family}")
    )
    table: sizes.Sizes = {}
    for target, (count, _) in zip(wanted, found, strict=True):
        figures = {key: asdict(count)[key] for key in sizes.FIGURES}
        table.setdefault(target.design, {})[target.family] = figures
    return table, found


def accept(wanted: list[Target], tell: Tell) -> int:
    """Make the sizes of these the committed ones."""
    sizes.write(sizes.read() | measured(wanted, tell)[0])
    console.print("written: docs/sizes.json; docs/benchmarks.md has the figures of the last whole report")
    return 0


def check(wanted: list[Target], every: list[Target], tell: Tell) -> int:
    """Compare the wanted ones of all targets with the committed sizes; the exit code."""
    others = {target.design for target in every} - {target.design for target in wanted}
    committed = {design: held for design, held in sizes.read().items() if design not in others}
    now, _ = measured(wanted, tell)
    verdict = sizes.compare(committed, now)
    for line in verdict.smaller:
        console.print(f"{line}: `make report` renews docs/sizes.json", markup=False)
    for line in verdict.wrong:
        fail(line)
    if verdict.wrong:
        fail(f"{len(verdict.wrong)} size(s) beyond docs/sizes.json: make it smaller, or {sizes.ACCEPT}")
        return 1
    console.print(f"no size is more than {sizes.LIMIT} % above docs/sizes.json ({len(wanted)} netlists)")
    return 0


def device_rows(target: Target, count: Count, netlist: Path, seeds: int, tell: Tell) -> list[size_page.Row]:
    """A part or board top on the devices of its family."""
    rows = []
    for device in targets.devices(target):
        placed = targets.device_netlist(target, device, netlist)
        label = f"{target.design} on {device.name}"
        runs = all_seeds(
            device, placed, target.folder, seeds, lambda run, what=label: tell(f"{what}: {run.fmax} MHz")
        )
        fmax = sorted(run.fmax for run in runs)
        rows.append(size_page.Row(target.design, device.name, count, fmax))
    return rows


def board_row(target: Target, count: Count, netlist: Path, seeds: int, tell: Tell) -> size_page.Row:
    """A board's bitstream with its constraints."""

    def one(seed: int) -> dict:
        used = targets.route_board(target, netlist, seed)
        tell(f"{target.design}: {used['fmax']} MHz")
        return used

    # The first start of a WebAssembly tool compiles it; two at once would do that twice.
    runs = [one(1)]
    with ThreadPoolExecutor(2) as pool:
        runs += pool.map(one, range(2, min(seeds, target.board.seeds) + 1))
    fmax = sorted(run["fmax"] for run in runs)
    return size_page.Row(target.design, target.board.device, count, fmax, runs[0], target.board.clk_hz / 1e6)


def report(part: str, wanted: list[Target], seeds: int, tell: Tell) -> None:
    """One part's figures, into docs/benchmarks.md and docs/sizes.json."""
    table, found = measured(wanted, tell)
    rows: list[size_page.Row] = []
    for target, (count, netlist) in zip(wanted, found, strict=True):
        if target.board:
            rows.append(board_row(target, count, netlist, seeds, tell))
        else:
            rows += device_rows(target, count, netlist, seeds, tell)
    split = {}
    if part in targets.CARRIERS:
        base = targets.base_job(part, True)
        folder = targets.FOLDER / "breakdown"
        families = project.part(part).families
        split = {family: synthesize(folder, base, family, BEST[family])[0] for family in families}
    tell(f"{part} instance by instance")
    text = size_page.markdown(part, rows, split, seeds)
    console.print(size_page.terminal(rows))
    if seeds != SEEDS:
        console.print(f"docs/ not written: that takes {SEEDS} seeds")
        return
    project.update_benchmarks(f"report:{part}", text)
    sizes.write(sizes.read() | table)
    console.print("written: docs/benchmarks.md, docs/sizes.json")


def arguments() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.report", description=(__doc__ or "").split("\n")[0]
    )
    parser.add_argument("--part", help="only this one (default: all)")
    parser.add_argument(
        "--check", action="store_true", help="compare sizes with docs/sizes.json, route nothing"
    )
    parser.add_argument(
        "--accept", action="store_true", help="make the sizes of now the committed ones, route nothing"
    )
    parser.add_argument("--seeds", type=int, default=SEEDS, help="place-and-route runs (default %(default)s)")
    return parser.parse_args()


def main() -> int:
    """Entry point."""
    args = arguments()
    every_part = [row.name for row in tops()]
    parts = [project.part(args.part).name] if args.part else every_part
    every = {part: targets.targets(part) for part in every_part}
    # A board's netlist is a board top's for other pins: the check of all parts does without it.
    route = not (args.check or args.accept)
    boards = route or bool(args.part)
    wanted = [target for part in parts for target in every[part] if boards or not target.board]
    routes = sum(
        min(args.seeds, target.board.seeds) if target.board else args.seeds * len(targets.devices(target))
        for target in wanted
    )
    steps = len(wanted) + (routes + len(parts) if route else 0)
    columns = (TextColumn("{task.description:50}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
        task = progress.add_task("synthesis", total=steps)

        def tell(text: str) -> None:
            progress.update(task, advance=1, description=text)
            if not console.is_terminal:
                console.print(text, markup=False)

        if args.check:
            return check(wanted, [target for found in every.values() for target in found], tell)
        if args.accept:
            return accept(wanted, tell)
        for part in parts:
            report(part, every[part], args.seeds, tell)
    if not args.part:
        bridges.write()
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
