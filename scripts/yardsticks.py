"""`make yardsticks PEERS=folder`: a part beside open designs, with the same recipes, into docs/benchmarks.md.

Two columns for every design: plain `synth_ecp5`, and the recipe that this project tuned. PEERS is a folder
of the user's with the designs' sources and a peers.json that describes them (scripts/flow/peers.py).
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import dataclass
from pathlib import Path

from rich.table import Table

from cocotb_tests.harness import project
from cocotb_tests.harness.project import console
from scripts.flow import pnr
from scripts.flow.netlist import flat_counts
from scripts.flow.peers import OLDER, WHERE, read
from scripts.flow.report import markdown_table, recipe_words
from scripts.flow.synthesis import SEEDS, run_yosys, wrapped_netlist
from scripts.flow.yosys_job import BEST

FOLDER = project.BUILD / "yardsticks"
ECP5 = pnr.DEVICES[0]
RECIPES = {"plain": "default", "tuned": BEST["ecp5"]}
OWN = {"ppmc104": "bus, mailbox, ramp table and its builder, limits, 3-, 4-, 5-phase excitation, chopper"}
HEADS = [
    "design",
    "what it is",
    "FF",
    "RAM",
    *(f"{what}, {name}" for name in RECIPES for what in ("COMB", "MHz")),
]


@dataclass(frozen=True)
class Row:
    """One design: a yosys job without family and recipe, and how the pin-saving wrapper connects it."""

    title: str
    what: str
    job: dict
    wiring: dict[str, str]


def rows(part: str, peers: Path) -> list[Row]:
    """The part itself, then the peers."""
    own = {
        "top": part,
        "include": [project.relative(path) for path in project.include_dirs()],
        "sources": [project.relative(path) for path in project.sources(project.part(part))],
        "params": {},
    }
    found = [Row(f"**this {part}**", OWN[part], own, {})]
    for peer in read(peers):
        job = {"top": peer.top, "include": [], "sources": peer.files(peers), "params": peer.params}
        found.append(
            Row(f"[{peer.title}]({peer.url})", peer.what, job, {"reset": peer.reset, "pins_like": peer.pins})
        )
    return found


def measure(row: Row, recipe: str, seeds: int) -> dict[str, float | list[float]]:
    """COMB, FF, block RAM, and the clock rate of each seed with all pins behind shift registers."""
    folder = FOLDER / row.job["top"] / recipe
    netlist = run_yosys(folder, {**row.job, "family": "ecp5", "recipe": recipe, "keep": False})
    total = flat_counts(netlist, row.job["top"], set())[0]
    used = pnr.packed(ECP5, netlist, folder)
    wrapped = wrapped_netlist(folder, row.job, netlist, recipe, "ecp5", **row.wiring)
    rates = []
    for seed in range(1, seeds + 1):
        rates.append(pnr.place_and_route(ECP5, wrapped, folder / "pnr", seed).fmax)
        console.print(f"{row.title}, {recipe}, seed {seed}: {rates[-1]} MHz")
    middle = sorted(rates)[(seeds - 1) // 2]
    return {"comb": used["TRELLIS_COMB"], "ff": total.ff, "ram": total.ram, "mhz": middle, "rates": rates}


def table(measured: list[tuple[Row, dict[str, dict]]]) -> list[list[str]]:
    """The cells: measured designs, then the ones that were measured before."""
    cells = []
    for row, by in measured:
        shared = [str(by["plain"][key]) for key in ("ff", "ram")]
        figures = [
            f"{by[name]['comb']}" if key == "comb" else f"{by[name]['mhz']:.0f}"
            for name in RECIPES
            for key in ("comb", "mhz")
        ]
        cells.append([row.title, row.what, *shared, *figures])
    for title, what, comb, ff, ram, mhz in OLDER:
        linked = f"[{title}]({WHERE[title]})" if title in WHERE else title
        cells.append([f"{linked} ¹", what, str(ff), str(ram), str(comb), str(mhz), "–", "–"])
    return cells


def text(seeds: int) -> str:
    """What stands above the table."""
    tuned = recipe_words({"ecp5": RECIPES["tuned"]})
    return (
        "Yardsticks, written by `make yardsticks`: open designs beside ours on an ECP5-25F, with the same "
        f"tools and, in each column, the same recipe for all: *plain* is `synth_ecp5`, *tuned* {tuned}. "
        "COMB is what nextpnr packs: a LUT4 one, a carry cell CCU2C two, and ends of carry chains; it is not "
        "the LUT of the other tables, which is LUT4 + 2 · CCU2C of the netlist. FF and RAM are the same with "
        f"both. MHz: median of {seeds} seeds, the pins of every design behind shift registers, which are not "
        "counted."
        "\n\n¹ measured before, with the plain recipe only and free pins."
    )


def main() -> int:
    """Measure, print, write docs/benchmarks.md."""
    parser = argparse.ArgumentParser(prog="yardsticks.py", description=__doc__)
    parser.add_argument("peers", type=Path, help="folder with peers.json")
    parser.add_argument("--part", default="ppmc104", choices=list(OWN))
    parser.add_argument("--seeds", type=int, default=SEEDS)
    args = parser.parse_args()
    wanted = rows(args.part, args.peers)
    measured = [
        (row, {name: measure(row, recipe, args.seeds) for name, recipe in RECIPES.items()}) for row in wanted
    ]
    cells = table(measured)
    shown = Table(title=f"{args.part} and open designs, ECP5-25F", title_justify="left")
    for index, head in enumerate(HEADS):
        shown.add_column(head, justify="right" if index > 1 else "left")
    for cell in cells:
        shown.add_row(*cell)
    console.print(shown)
    (FOLDER / "figures.json").write_text(json.dumps({row.title: by for row, by in measured}, indent=1) + "\n")
    if args.seeds == SEEDS:
        project.update_benchmarks(
            "yardsticks", text(args.seeds) + "\n\n" + markdown_table(HEADS, cells, left=2)
        )
        console.print("written: docs/benchmarks.md")
    else:
        console.print(f"docs/benchmarks.md is written with {SEEDS} seeds only")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
