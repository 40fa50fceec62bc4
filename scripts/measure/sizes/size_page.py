"""Tables of sizes and clock rates, from docs/sizes.json."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from scripts.fpga.flow.yosys_job import BEST, recipe_text
from scripts.markdown import table
from scripts.measure.sizes import designs, figures
from scripts.measure.sizes.designs import Design
from scripts.measure.sizes.figures import PEER, Figures, rate_text
from scripts.measure.sizes.peers import OLDER, WHERE

FAMILY = {"ecp5": "ECP5", "ice40": "iCE40", "gowin": "Gowin"}
RATE = (
    f"MHz is Fmax of `clk`, median and in brackets the lowest of {figures.RUNS} runs: {designs.SEEDS} seeds "
    f"of place and route for each of {designs.TURNS} syntheses that only differ in the names of cells. "
    "A dash: not measured with this RTL."
)
RECIPE = f"*plain* is `synth_ecp5`, *tuned* is `{recipe_text('ecp5', BEST['ecp5'])}`."
HEADS = ["COMB, plain", "MHz", "COMB, tuned", "MHz"]


def _pair(found: Figures, name: str) -> list[dict[str, Any] | None]:
    return [found.get(f"{name} ecp5 {recipe}") for recipe in designs.RECIPES]


def _cells(found: Figures, name: str, axes: int = 0) -> list[str]:
    """Return FF and RAM, and then for each recipe COMB, with `axes` also COMB per axis, and MHz."""
    both = _pair(found, name)
    cells = [str(both[0][key]) if both[0] else "–" for key in ("ff", "ram")]
    for entry in both:
        cells += [str(entry["comb"]) if entry else "–"]
        cells += [f"{entry['comb'] / axes:.0f}" if entry else "–"] if axes else []
        cells += [rate_text(entry)]
    return cells


def _axes_heads(first: list[str]) -> list[str]:
    return [*first, "FF", "RAM", *(text for at in (0, 2) for text in (HEADS[at], "an axis", HEADS[at + 1]))]


def parts(found: Figures) -> str:
    """Return the table of parts on an ECP5 with both recipes."""
    rows = {d.name: d.axes for d in designs.of_parts() if d.rated and not d.name.startswith("bank ")}
    cells = [[name, str(axes), *_cells(found, name, axes)] for name, axes in rows.items()]
    text = (
        f"Parts on an ECP5-25F of speed grade 6 with default parameters. {RECIPE} COMB is the number of "
        "logic cells that nextpnr packs; FF and block RAM are the same with both recipes. The pins are "
        f"connected to shift registers that are not counted. {RATE}"
    )
    return f"{text}\n\n{table(_axes_heads(['part', 'axes']), cells, left=1)}"


def synthesized(found: Figures) -> str:
    """Return the table of LUT, FF and block RAM of parts, carriers and bridges for each family."""
    listed = [*designs.of_parts(), *designs.of_carriers(), *designs.of_bridges()]
    titles = {
        d.name: d.title or d.name for d in listed if d.recipe == "tuned" and not d.name.startswith("bank ")
    }
    rows = []
    for name, title in titles.items():
        cells = [f"`{name.split()[0]}`", "" if title == name else title]
        for family in FAMILY:
            entry = found.get(f"{name} {family} tuned")
            cells += [str(entry[key]) for key in figures.COUNTS] if entry else ["–"] * 3
        rows.append(cells)
    heads = ["module", "", *(f"{name} {what}" for name in FAMILY.values() for what in ("LUT", "FF", "RAM"))]
    recipes = ", ".join(f"`{recipe_text(family, BEST[family])}`" for family in FAMILY)
    text = (
        "Cells after synthesis of parts, of parts with their host bridge (`…_carrier`), and of single "
        f"bridges and recorders. Recipes: {recipes}. On an ECP5 LUT is LUT4 + 2 · CCU2C (carry cells); on "
        "Gowin an adder bit counts as one LUT. `make size` fails if a count grows by more than "
        f"{figures.LIMIT} %."
    )
    return f"{text}\n\n{table(heads, rows, left=2)}"


def bitstreams(found: Figures) -> str:
    """Return the table of the bitstreams of the boards."""
    rows = []
    for design in designs.of_boards():
        entry = found.get(design.key)
        cells = [str(entry[key]) for key in figures.COUNTS] if entry else ["–"] * 3
        assert design.board
        clk = f"{design.board.clk_hz / 1e6:g}"
        rows.append([design.name.removesuffix(" bitstream"), design.title, *cells, clk])
    heads = ["bitstream", "FPGA", "LUT", "FF", "RAM", "runs at, MHz"]
    text = (
        "Bitstreams with the constraints of their boards, UART host; cells after synthesis. "
        "`make bitstream` fails if a bitstream is too slow for the clock of its board."
    )
    return f"{text}\n\n{table(heads, rows, left=2)}"


def peers(found: Figures) -> str:
    """Return the comparison of the PPMC-104 with other open designs."""
    rows = [["**ppmc104**", *_cells(found, "ppmc104")]]
    names = dict.fromkeys(
        key.removeprefix(PEER).removesuffix(" ecp5 plain").removesuffix(" ecp5 tuned")
        for key in found
        if key.startswith(PEER)
    )
    rows += [
        [f"[{name}]({WHERE[name]})" if name in WHERE else name, *_cells(found, PEER + name)] for name in names
    ]
    for title, _, comb, ff, ram in OLDER:
        linked = f"[{title}]({WHERE[title]})" if title in WHERE else title
        rows.append([f"{linked} ¹", str(ff), str(ram), str(comb), "–", "–", "–"])
    text = (
        "The PPMC-104 and open designs of one axis on an ECP5-25F, measured with the same tools and recipes "
        f"(`make report PEERS=folder`). {RATE}\n\n"
        "¹ size measured earlier; its clock rate was not measured with the present recipe."
    )
    return f"{text}\n\n{table(['design', 'FF', 'RAM', *HEADS], rows, left=1)}"


def bank(found: Figures) -> str:
    """Return the table of the bank's size by its number of axes, for its manual."""
    rows = [[str(axes), *_cells(found, f"bank {axes}", axes)] for axes in designs.BANKS]
    text = (
        f"`ppmc_bank` on an ECP5-25F of speed grade 6, CLK_HZ {designs.BANK_CLK_HZ // 1_000_000} MHz, "
        f"without a bridge. {RECIPE} COMB is the number of logic cells that nextpnr packs; FF and block "
        "RAM (DP16KD) are counted after synthesis. The pins are connected to shift registers that are not "
        f"counted. {RATE}"
    )
    return f"{text}\n\n{table(_axes_heads(['axes']), rows, left=1)}"


def axis_costs(found: Figures) -> tuple[dict[str, tuple[int, float]], dict[str, int]]:
    """Return COMB per axis with the plain recipe: of our designs as (axes, COMB), and of other designs."""
    kinds = {d.name: d for d in designs.of_parts() if d.name in ("ppmc104", "ppmc2104", "isa_4axis")}
    measured = {name: found.get(f"{name} ecp5 plain") for name in kinds}
    family = {
        _title(kinds[name]): (kinds[name].axes, entry["comb"] / kinds[name].axes)
        for name, entry in measured.items()
        if entry
    }
    others = {
        key.removeprefix(PEER).removesuffix(" ecp5 plain"): entry["comb"]
        for key, entry in found.items()
        if key.startswith(PEER) and key.endswith(" plain")
    }
    return family, others | {title: comb for title, _, comb, *_ in OLDER}


def _title(design: Design) -> str:
    from openppmc import parts as table

    return table.part(design.part).title


BLOCKS: dict[str, Callable[[Figures], str]] = {
    "parts": parts,
    "synthesized": synthesized,
    "bitstreams": bitstreams,
    "peers": peers,
}
"""Blocks of docs/benchmarks.md."""
