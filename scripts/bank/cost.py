"""What a bank costs by its number of axes, from docs/bank/sizes.json, which scripts/bank/sizes.py writes."""

from __future__ import annotations

import json
import re
from typing import Any

from cocotb_tests.harness.project import DOCS, ProjectError
from scripts.flow.peers import OLDER
from scripts.flow.report import markdown_table, recipe_words
from scripts.flow.yosys_job import BEST

FILE = DOCS / "bank" / "sizes.json"
AXES = (4, 8, 16, 32, 64)
CLK_HZ = 100_000_000
RECIPES = {"plain": {"ecp5": "default", "ice40": "default"}, "tuned": BEST}
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


def megahertz(rates: list[float]) -> str:
    """Median (the lower one of two in the middle); in brackets the number of seeds if it is one."""
    if not rates:
        return "–"
    middle = sorted(rates)[(len(rates) - 1) // 2]
    return f"{middle:.0f}" + (" (1)" if len(rates) == 1 else "")


def table() -> str:
    """Markdown: a row for each number of axes."""
    found = figures()
    rows = []
    for axes in AXES:
        both = [found[f"{axes} {name}"] for name in RECIPES]
        cells = [str(axes), str(both[0]["ff"]), str(both[0]["ram"])]
        for one in both:
            cells += [str(one["comb"]), f"{one['comb'] / axes:.0f}", megahertz(one["mhz"])]
        rows.append(cells)
    return markdown_table(HEADS, rows)


def small() -> str:
    """A sentence about the bank on an UP5K."""
    one = figures()["ice40"]
    size = (
        f"{one['AXES']} axes at {one['CLK_HZ'] // 1_000_000} MHz are {one['lut']} LUT4, {one['ff']} FF and "
        f"{one['ram']} block RAM on an iCE40 UP5K (recipe *tuned*), which has 5280, 5280 and 30"
    )
    if "says" in one:
        return f"{size}: that does not go in, nextpnr says: `{one['says']}`"
    return f"{size}. nextpnr places it with one seed and tells {one['mhz']:.1f} MHz."


def text() -> str:
    """What stands with the table."""
    runs = [len(one["mhz"]) for key, one in figures().items() if key != "ice40"]
    seeds, missing = max(runs), ", – not measured" if 0 in runs else ""
    return (
        "`ppmc_bank` on an ECP5-25F of speed 6, CLK_HZ 100 MHz, without a bridge. *plain* is `synth_ecp5`, "
        f"*tuned* {recipe_words({'ecp5': BEST['ecp5']})}. COMB is what nextpnr packs, FF and block RAM "
        "(DP16KD) as synthesized. MHz is Fmax of `clk` with all pins behind shift registers, which are not "
        f"counted: median of {seeds} seeds, (1) of one seed{missing}."
    )


def markdown() -> str:
    """The block of docs/benchmarks.md."""
    head = "Bank of PPMC-104, by its number of axes, written by `python -m scripts.bank.sizes`."
    return "\n\n".join([f"{head} {text()}", table(), small()])


def manual() -> str:
    """The block of the manual."""
    return "\n\n".join([text(), table(), small()])


def singles() -> list[tuple[str, int]]:
    """COMB with the plain recipe of this project's PPMC-104 and other designs of one axis."""
    page = (DOCS / "benchmarks.md").read_text(encoding="utf-8")
    block = page.split("<!-- yardsticks -->")[1].split("<!-- /yardsticks -->")[0]
    found = []
    for line in block.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 8 and cells[4].isdigit():
            found.append((re.sub(r"[\[*]|\].*|this |¹", "", cells[0]).strip(), int(cells[4])))
    assert len(found) > len(OLDER)
    return found
