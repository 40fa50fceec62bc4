"""`make recipes`: COMB, FF, RAM and MHz of every part with both recipes, into docs/recipes.json and a table.

A run that was broken off goes on; what has not changed is not measured again.
"""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from cocotb_tests.harness import project
from cocotb_tests.harness.project import DOCS, ProjectError, console
from openppmc import parts
from scripts.flow.report import markdown_table, recipe_words
from scripts.flow.synthesis import SEEDS
from scripts.flow.yardstick import RECIPES, Design, in_words, measure

FILE = DOCS / "recipes.json"
FOLDER = project.BUILD / "recipes"
AXES = {"ppmc2104": 2, "isa_4axis": 4}
"""Parts with more than one."""
ELSEWHERE = ("bank",)
"""By its number of axes: scripts/bank/sizes.py."""
HEADS = ["part", "axes", "FF", "RAM", "COMB, plain", "an axis", "MHz", "COMB, tuned", "an axis", "MHz"]


def figures() -> dict[str, Any]:
    """What was measured, by part and recipe; ProjectError if there is none."""
    try:
        found: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise ProjectError("docs/recipes.json: not there, or no JSON: make recipes") from None
    return found


def table(found: dict[str, Any]) -> str:
    """Markdown: a row a part."""
    rows = []
    for row in parts.tops():
        both = [found.get(f"{row.name} {recipe}") for recipe in RECIPES]
        if None in both:
            continue
        axes = AXES.get(row.name, 1)
        cells = [row.name, str(axes), str(both[0]["ff"]), str(both[0]["ram"])]
        for one in both:
            cells += [str(one["comb"]), f"{one['comb'] / axes:.0f}", in_words(one["mhz"])]
        rows.append(cells)
    return markdown_table(HEADS, rows)


def text() -> str:
    """What stands above the table."""
    return (
        "Every part on an ECP5-25F of speed 6 with its default parameters, written by `make recipes`: "
        f"*plain* is `synth_ecp5`, *tuned* {recipe_words({'ecp5': RECIPES['tuned']})}. COMB is what nextpnr "
        "packs (not the LUT of the reports). MHz: all pins behind shift registers, "
        f"which are not counted, median of {SEEDS} seeds, or of as many as stand in brackets."
    )


def main() -> int:
    """Measure, write."""
    names = [row.name for row in parts.tops() if row.name not in ELSEWHERE]
    parser = argparse.ArgumentParser(prog="python -m scripts.recipes", description=__doc__)
    parser.add_argument("--part", choices=names, help="this one only (default: all)")
    parser.add_argument("--seeds", type=int, default=SEEDS, help="how many are placed, 0 for sizes only")
    args = parser.parse_args()
    designs = {name: Design.of_part(parts.part(name)) for name in ([args.part] if args.part else names)}
    found = measure(designs, dict.fromkeys(designs, args.seeds), FILE, FOLDER)
    project.update_benchmarks("recipes", f"{text()}\n\n{table(found)}")
    console.print("written: docs/recipes.json, docs/benchmarks.md")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
