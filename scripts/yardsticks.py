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
from scripts.flow.peers import OLDER, WHERE, read
from scripts.flow.report import markdown_table, recipe_words
from scripts.flow.synthesis import SEEDS
from scripts.flow.yardstick import RECIPES, Design, middle

FOLDER = project.BUILD / "yardsticks"
FILE = project.DOCS / "yardsticks.json"
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
    """One design, its name and what it does."""

    title: str
    what: str
    design: Design


def rows(part: str, peers: Path) -> list[Row]:
    """The part itself, then the peers."""
    found = [Row(f"**this {part}**", OWN[part], Design.of_part(project.part(part)))]
    for peer in read(peers):
        job = {"top": peer.top, "include": [], "sources": peer.files(peers), "params": peer.params}
        design = Design(job, {"reset": peer.reset, "pins_like": peer.pins})
        found.append(Row(f"[{peer.title}]({peer.url})", peer.what, design))
    return found


def measure(row: Row, recipe: str, seeds: int) -> dict[str, float | list[float]]:
    """COMB, FF, block RAM, and the clock rate of each seed with all pins behind shift registers."""
    folder = FOLDER / row.design.job["top"] / recipe
    size = row.design.size(recipe, folder)
    rates = []
    for seed in range(1, seeds + 1):
        rates.append(row.design.rate(recipe, seed, folder))
        console.print(f"{row.title}, {recipe}, seed {seed}: {rates[-1]} MHz")
    return {**size, "mhz": middle(rates), "rates": rates}


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


def singles(measured: list[tuple[Row, dict[str, dict]]]) -> dict[str, int]:
    """COMB with the plain recipe of each other design, for the picture of what an axis costs."""
    others = {row.title.split("]")[0].strip("["): by["plain"]["comb"] for row, by in measured[1:]}
    return others | {title: comb for title, _, comb, *_ in OLDER}


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
    measured = [(row, {name: measure(row, name, args.seeds) for name in RECIPES}) for row in wanted]
    cells = table(measured)
    shown = Table(title=f"{args.part} and open designs, ECP5-25F", title_justify="left")
    for index, head in enumerate(HEADS):
        shown.add_column(head, justify="right" if index > 1 else "left")
    for cell in cells:
        shown.add_row(*cell)
    console.print(shown)
    if args.seeds == SEEDS:
        FILE.write_text(json.dumps(singles(measured), indent=1) + "\n", encoding="utf-8")
        project.update_benchmarks(
            "yardsticks", text(args.seeds) + "\n\n" + markdown_table(HEADS, cells, left=2)
        )
        console.print("written: docs/benchmarks.md, docs/yardsticks.json")
    else:
        console.print(f"docs/benchmarks.md is written with {SEEDS} seeds only")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
