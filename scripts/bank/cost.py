"""What a bank costs by its number of axes, from docs/bank/sizes.json, which scripts/bank/sizes.py writes."""

from __future__ import annotations

import json
from typing import Any

from cocotb_tests.harness.project import DOCS, ProjectError
from openppmc import parts
from scripts import recipes
from scripts.flow.report import markdown_table, recipe_words
from scripts.flow.yardstick import RECIPES, in_words
from scripts.flow.yosys_job import BEST

FILE = DOCS / "bank" / "sizes.json"
AXES = (4, 8, 16, 32, 64)
CLK_HZ = 100_000_000
HEADS = ["axes", "FF", "RAM", "COMB, plain", "an axis", "MHz", "COMB, tuned", "an axis", "MHz"]


def figures() -> dict[str, Any]:
    """The measured figures; ProjectError if there are none."""
    try:
        found: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise ProjectError(
            "docs/bank/sizes.json: not there, or no JSON: python -m scripts.bank.sizes"
        ) from None
    return found


def table() -> str:
    """Markdown: a row for each number of axes."""
    found = figures()
    rows = []
    for axes in AXES:
        both = [found.get(f"{axes} {name}") for name in RECIPES]
        assert both[0]
        cells = [str(axes), str(both[0]["ff"]), str(both[0]["ram"])]
        for one in both:
            size = [str(one["comb"]), f"{one['comb'] / axes:.0f}"] if one else ["–", "–"]
            cells += [*size, in_words(one["mhz"] if one else [])]
        rows.append(cells)
    return markdown_table(HEADS, rows)


def small() -> str:
    """A sentence about the bank on an UP5K; none if that was not measured."""
    one = figures().get("ice40")
    if not one:
        return ""
    size = (
        f"{one['AXES']} axes at {one['CLK_HZ'] // 1_000_000} MHz are {one['lut']} LUT4, {one['ff']} FF and "
        f"{one['ram']} block RAM on an iCE40 UP5K (recipe *tuned*), which has 5280, 5280 and 30"
    )
    if "says" in one:
        return f"{size}: that does not go in, nextpnr says: `{one['says']}`"
    if "mhz" not in one:
        return f"{size}."
    return f"{size}. nextpnr places it with one seed and tells {one['mhz']:.1f} MHz."


def text() -> str:
    """What stands with the table."""
    runs = [len(one["mhz"]) for key, one in figures().items() if key != "ice40"]
    seeds, missing = max(runs), ", – not measured" if 0 in runs else ""
    median = f"median of {seeds} seeds, (1) of one seed{missing}" if seeds else "not measured with this RTL"
    return (
        "`ppmc_bank` on an ECP5-25F of speed 6, CLK_HZ 100 MHz, without a bridge. *plain* is `synth_ecp5`, "
        f"*tuned* {recipe_words({'ecp5': BEST['ecp5']})}. COMB is what nextpnr packs, FF and block RAM "
        "(DP16KD) as synthesized. MHz is Fmax of `clk` with all pins behind shift registers, which are not "
        f"counted: {median}."
    )


def markdown() -> str:
    """The block of docs/benchmarks.md."""
    head = "Bank of PPMC-104, by its number of axes, written by `python -m scripts.bank.sizes`."
    return "\n\n".join(filter(None, [f"{head} {text()}", table(), small()]))


def manual() -> str:
    """The block of the manual."""
    return "\n\n".join(filter(None, [text(), table(), small()]))


def singles() -> dict[str, int]:
    """COMB with the plain recipe of other designs of one axis, as `make yardsticks` has measured it."""
    found: dict[str, int] = json.loads((DOCS / "yardsticks.json").read_text(encoding="utf-8"))
    return found


def family() -> dict[str, tuple[int, float]]:
    """Axes and COMB an axis with the plain recipe of the parts that step as a PPMC-104 does, by title."""
    found = recipes.figures()
    names = ("ppmc104", "ppmc2104", "isa_4axis")
    counts = {name: recipes.AXES.get(name, 1) for name in names}
    return {parts.part(name).title: (n, found[f"{name} plain"]["comb"] / n) for name, n in counts.items()}
