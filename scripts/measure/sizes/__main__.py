"""Measure sizes and clock rates and write docs/sizes.json; `--check` only compares the sizes.

`make report` measures every design whose RTL has changed, first its size, then its clock rate. It saves each
result, so that an interrupted run continues where it ended. `make size` synthesises the designs that have
changed (FRESH=1: all) and fails if a count has grown by more than 5 %.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from cocotb_tests.harness import project
from cocotb_tests.harness.project import console, fail
from scripts.fpga.flow.synthesis import run_yosys
from scripts.fpga.flow.yosys_job import BEST
from scripts.measure.sizes import designs, figures, peers
from scripts.measure.sizes.designs import SEEDS, TURNS, Design

T = TypeVar("T")
Work = tuple[str, Callable[[], T]]


def run_all(works: list[Work[T]], keep: Callable[[int, T], None]) -> None:
    """Run all works, two at a time, with a progress display; call keep(index, result) for each."""
    columns = (TextColumn("{task.description:50}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with (
        Progress(*columns, console=console, disable=not console.is_terminal) as progress,
        ThreadPoolExecutor(2) as pool,
    ):
        task = progress.add_task("", total=len(works))
        for at, result in enumerate(pool.map(lambda work: work[1](), works)):
            keep(at, result)
            progress.update(task, advance=1, description=works[at][0])
            if not console.is_terminal:
                console.print(
                    f"[{at + 1}/{len(works)}] {works[at][0]}: {result}", markup=False, highlight=False
                )


def sizes(selected: list[Design]) -> figures.Figures:
    """Synthesise and count cells; designs with the same netlist are synthesised once."""
    same: dict[tuple[str, str, str], list[Design]] = {}
    for design in selected:
        key = (design.job["top"], design.key if not design.board else "", design.digest())
        same.setdefault(key, []).append(design)
    groups = list(same.values())
    found: dict[str, dict[str, Any]] = {}

    def keep(at: int, counts: dict[str, int]) -> None:
        found.update({design.key: {**counts, "of": design.digest()} for design in groups[at]})

    run_all([(group[0].key, group[0].size) for group in groups], keep)
    return found


def measure(selected: list[Design], rates: bool) -> None:
    """Delete the clock rates of designs with changed RTL, then measure the changed designs."""
    held = figures.read() if figures.FILE.is_file() else {}
    known = {design.key for design in designs.all_designs()}
    held = {key: entry for key, entry in held.items() if key in known or key.startswith(figures.PEER)}
    changed = [design for design in selected if held.get(design.key, {}).get("of") != design.digest()]
    for at in range(0, len(changed), 8):
        held |= sizes(changed[at : at + 8])
        figures.write(held)
    todo = []
    for design in selected if rates else []:
        entry = held[design.key]
        if design.rated and figures.rate(entry) is None:
            entry["mhz"] = []
            todo += [(design, turn, seed) for turn in range(TURNS) for seed in range(1, SEEDS + 1)]

    def keep(at: int, mhz: float) -> None:
        held[todo[at][0].key]["mhz"].append(round(mhz, 2))
        if len(held[todo[at][0].key]["mhz"]) == TURNS * SEEDS:
            figures.write(held)

    works: list[Work[float]] = [
        (f"{design.key}, synthesis {turn}, seed {seed}", partial(design.rate, turn, seed))
        for design, turn, seed in todo
    ]
    run_all(works, keep)
    console.print("written: docs/sizes.json; `make docs` writes the tables")


def check(selected: Iterable[Design], fresh: bool) -> int:
    """Compare with the committed sizes; return the exit code.

    If the digest of a design is the stored one, its size is the stored size; the design is synthesised again
    only if `fresh` is true.
    """
    held = figures.read()
    counted = [design for design in selected if design.recipe == "tuned" and not design.board]
    changed = [design for design in counted if fresh or held.get(design.key, {}).get("of") != design.digest()]
    now = sizes(changed)
    result = figures.compare(held, now)
    for line in result.smaller:
        console.print(f"{line}: `make report` writes docs/sizes.json", markup=False)
    for line in result.wrong:
        fail(line)
    if result.wrong:
        return fail(
            f"docs/sizes.json: {len(result.wrong)} size(s) differ; reduce or accept them (make report)"
        )
    console.print(
        f"no size is more than {figures.LIMIT} % above docs/sizes.json: {len(now)} designs synthesized, "
        f"{len(counted) - len(now)} unchanged since they were measured"
    )
    return 0


def show_instances(part: str) -> None:
    """Print yosys' statistics of each module of a part, for each family."""
    design = next(d for d in designs.of_parts() if d.part == part)
    for family in project.part(part).families:
        job = {**design.job, "family": family, "recipe": BEST[family], "keep": True}
        log = run_yosys(designs.FOLDER / f"instances-{part}", job).with_suffix(".log")
        text = log.read_text(encoding="utf-8").rpartition("Printing statistics.")[2]
        text = re.split(r"\n\n[\d.]+ Executing", text)[0]
        console.print(f"{family}:{text}", markup=False, highlight=False)


def main() -> int:
    """Run the command line."""
    known = sorted({design.part for design in designs.of_parts()})
    parser = argparse.ArgumentParser(
        prog="python -m scripts.measure.sizes", description=(__doc__ or "").split("\n")[0]
    )
    parser.add_argument("--part", choices=known, help="measure designs with this part only")
    parser.add_argument("--check", action="store_true", help="compare sizes with docs/sizes.json")
    parser.add_argument("--fresh", action="store_true", help="also synthesize designs that have not changed")
    parser.add_argument("--no-rates", action="store_true", help="measure sizes only, no place and route")
    parser.add_argument("--only", metavar="TEXT", help="measure designs whose key contains TEXT")
    parser.add_argument(
        "--peers", type=Path, metavar="FOLDER", help="measure the designs of FOLDER/peers.json"
    )
    parser.add_argument("--instances", action="store_true", help="print the cells of each module of the part")
    args = parser.parse_args()
    if args.instances:
        show_instances(args.part or "ppmc104")
        return 0
    selected = designs.all_designs()
    if args.peers:
        selected = designs.of_peers(args.peers, peers.read(args.peers))
    if args.part:
        selected = [design for design in selected if design.part == args.part]
    if args.only:
        selected = [design for design in selected if args.only in design.key]
    if not selected:
        return fail("no design matches; leave out --only or --part")
    if args.check:
        return check(selected, args.fresh)
    measure(selected, not args.no_rates)
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
