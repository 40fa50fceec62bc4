"""`make synth PART=…`: how large a part is and how fast it runs on iCE40 and ECP5, and where its cells are.

``--quick`` synthesizes only (seconds); without it every device is placed and routed with five seeds, the
median Fmax is reported, build/synth/<part>.json is written and the table in docs/benchmarks.md is renewed.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path

from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    SpinnerColumn,
    TextColumn,
    TimeElapsedColumn,
)
from rich.table import Table

from cocotb_tests.harness import project
from cocotb_tests.harness.project import console
from scripts.flow import pnr
from scripts.flow.netlist import Breakdown, flat_counts
from scripts.flow.report import LUT_NAME, breakdown_table, device_rows, markdown
from scripts.flow.synthesis import (
    FAMILIES,
    SEEDS,
    all_seeds,
    device_entry,
    run_yosys,
    synthesize,
    synthesize_all,
    wrapped_netlist,
)
from scripts.flow.yosys_job import BEST, RECIPES

VARIANTS: tuple[tuple[str, dict[str, int | str]], ...] = (
    ("CLK_HZ = 100 MHz", {"CLK_HZ": 100_000_000}),
    ("TIMING = DATASHEET", {"TIMING": "DATASHEET"}),
)


def variants(folder: Path, base: dict, recipes: dict[str, str]) -> list[dict]:
    """Size under other parameters."""
    rows = []
    for name, params in VARIANTS:
        counts = {"name": name}
        for family in FAMILIES:
            job = {
                **base,
                "params": {**base["params"], **params},
                "family": family,
                "recipe": recipes[family],
            }
            flat = run_yosys(folder / "variants", {**job, "keep": False})
            counts[family] = asdict(flat_counts(flat, base["top"], set())[0])
        rows.append(counts)
    return rows


def full(folder: Path, base: dict, recipes: dict[str, str], seeds: int) -> None:
    """Synthesis, place and route with all seeds, build/synth/<part>.json and docs/benchmarks.md."""
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description:34}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
        task = progress.add_task("synthesis", total=3 + len(pnr.DEVICES) * seeds)
        results, netlists = synthesize_all(folder, base, recipes)
        progress.update(task, advance=1, description="synthesis with other parameters")
        others = variants(folder, base, recipes)
        progress.update(task, advance=1, description="synthesis of the wrapped part")
        wrapped = wrapped_netlist(folder, base, netlists["ice40"], recipes["ice40"])
        progress.advance(task)

        def routed(device: pnr.Device, netlist: Path) -> list[pnr.Run]:
            def done(run: pnr.Run) -> None:
                progress.advance(task)
                if not console.is_terminal:
                    console.print(f"{device.name} seed {run.seed}: {run.fmax} MHz")

            progress.update(task, description=f"place and route {device.name}")
            return all_seeds(device, netlist, folder / "pnr", seeds, done)

        devices = []
        for device in pnr.DEVICES:
            netlist = wrapped if device.wrapped else netlists[device.family]
            runs = routed(device, netlist)
            devices.append(device_entry(device, results[device.family].total, runs))
    report = {
        "part": base["top"],
        "params": base["params"],
        "recipes": recipes,
        "seed_count": seeds,
        "devices": devices,
        "variants": others,
        "breakdown": {family: result.as_dict() for family, result in results.items()},
    }
    target = project.BUILD / "synth" / f"{base['top']}.json"
    target.write_text(json.dumps(report, indent=1, default=vars) + "\n")
    show(report, results)
    if seeds == SEEDS and not base["params"]:
        project.update_benchmarks(f"synth:{base['top']}", markdown(report, results))
        console.print(f"written: {project.relative(target)}, docs/benchmarks.md")
    else:
        console.print(
            f"written: {project.relative(target)} (docs/benchmarks.md only with default parameters and seeds)"
        )


def show(report: dict, results: dict[str, Breakdown]) -> None:
    """Print devices and breakdown."""
    table = Table(
        title=f"{report['part']}: Fmax is the median of {report['seed_count']} seeds", title_justify="left"
    )
    for head in ("device", "logic", "FF", "RAM", "Fmax / MHz", "all seeds", "goals"):
        table.add_column(head, justify="left" if head in ("device", "goals") else "right")
    for row in device_rows(report["devices"]):
        table.add_row(*row[:-1], row[-1].replace("; ", "\n"))
    console.print(table)
    for entry in report["devices"]:
        console.print(f"slowest path, {entry['device']}: {entry['path']}")
    for entry in report["variants"]:
        console.print(
            f"with {entry['name']}: ECP5 {entry['ecp5']['lut']} COMB, iCE40 {entry['ice40']['lut']} LUT4"
        )
    console.print(breakdown_table(results))


def sweep(folder: Path, base: dict) -> None:
    """Print the size that each recipe gives: how the recipes in use were chosen."""
    for family in FAMILIES:
        for recipe in RECIPES[family]:
            total = synthesize(folder, base, family, recipe)[0].total
            console.print(
                f"{family:6} {recipe:18} {LUT_NAME[family]} {total.lut:5}  FF {total.ff:5}  RAM {total.ram}"
            )


def arguments() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="synth.py", description=__doc__)
    parser.add_argument("--part", default="ppmc104")
    parser.add_argument(
        "--top", help="another module than the part's top (its own default parameters are used)"
    )
    parser.add_argument(
        "--files", nargs="+", type=Path, help="these sources instead of those of rtl/files.yml"
    )
    parser.add_argument("--quick", action="store_true", help="size only, no place and route")
    parser.add_argument(
        "--seeds", type=int, default=SEEDS, help="place-and-route runs per device (default %(default)s)"
    )
    parser.add_argument("--sweep", action="store_true", help="size with every recipe")
    parser.add_argument("--clk-hz", type=int, help="CLK_HZ of the part (default: the part's own default)")
    parser.add_argument("--timing", choices=("FAST", "DATASHEET"))
    parser.add_argument(
        "-G", metavar="NAME=VALUE", action="append", default=[], help="any parameter of the top"
    )
    for family in FAMILIES:
        parser.add_argument(f"--{family}-recipe", choices=list(RECIPES[family]), default=BEST[family])
    return parser.parse_args()


def parameters(args: argparse.Namespace) -> dict[str, int | str]:
    """Parameter overrides of the top."""
    params: dict[str, int | str] = {}
    for text in args.G:
        name, _, value = text.partition("=")
        params[name] = int(value) if value.isdigit() else value
    if args.clk_hz:
        params["CLK_HZ"] = args.clk_hz
    if args.timing:
        params["TIMING"] = args.timing
    return params


def main() -> int:
    """Entry point."""
    args = arguments()
    part = project.part(args.part)
    base = {
        "top": args.top or part.name,
        "include": [project.relative(path) for path in project.include_dirs()],
        "sources": [project.relative(path) for path in args.files or project.sources(part)],
        "params": parameters(args),
    }
    folder = project.BUILD / "synth" / base["top"]
    recipes = {"ecp5": args.ecp5_recipe, "ice40": args.ice40_recipe}
    if args.sweep:
        sweep(folder, base)
        return 0
    if not args.quick:
        full(folder, base, recipes, args.seeds)
        return 0
    results, _ = synthesize_all(folder, base, recipes)
    for family, result in results.items():
        total = result.total
        console.print(
            f"[bold]{family:6}[/] {LUT_NAME[family]} {total.lut}  FF {total.ff}  RAM {total.ram}  "
            f"carry {total.carry}  (recipe {recipes[family]})"
        )
    console.print(breakdown_table(results))
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
