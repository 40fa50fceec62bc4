"""The synthesis report: tables for the terminal and the Markdown block of docs/benchmarks.md."""

from __future__ import annotations

from rich import box
from rich.table import Table

from .netlist import Breakdown, Count
from .yosys_job import RECIPES

LUT_NAME = {"ecp5": "COMB", "ice40": "LUT4"}
GOALS = {"ecp5": {"lut": 1100, "ram": 2}, "ice40": {"lut": 1100}}


def breakdown_table(results: dict[str, Breakdown]) -> Table:
    """Cells per instance, all families side by side."""
    table = Table(
        title="where the cells are", title_justify="left", caption_justify="left", box=box.SIMPLE_HEAD
    )
    table.caption = (
        "flat: flattened, a LUT is credited to the instance it feeds; own: each module mapped by itself"
    )
    table.add_column("instance", no_wrap=True)
    table.add_column("module", no_wrap=True)
    for family in results:
        for head in (f"{family}\nflat", "\nown", "\nFF", "\nRAM"):
            table.add_column(head, justify="right", no_wrap=True)
    for row in breakdown_rows(results, indent="  "):
        if row[0] == "total":
            table.add_section()
        table.add_row(*row, style="bold" if row[0] == "total" else None)
    return table


def breakdown_rows(results: dict[str, Breakdown], indent: str) -> list[list[str]]:
    """Rows of instance, module, then flat LUTs, own LUTs, FF, RAM of each family; the last is the total."""
    first = next(iter(results.values()))
    rows = []
    for path in sorted(first.kept):
        depth = path.count(".") + 1 if path else 0
        row = [indent * depth + (path.rsplit(".", 1)[-1] or "(top itself)"), first.module[path]]
        for result in results.values():
            flat, kept = result.flat.get(path, Count()), result.kept.get(path, Count())
            row += [str(flat.lut), str(kept.lut), str(flat.ff), str(flat.ram or "")]
        rows.append(row)
    total = ["total", ""]
    for result in results.values():
        own = sum(count.lut for count in result.kept.values())
        total += [str(result.total.lut), str(own), str(result.total.ff), str(result.total.ram or "")]
    return [*rows, total]


def markdown_table(heads: list[str], rows: list[list[str]], left: int = 1) -> str:
    """A Markdown table whose first `left` columns are left-aligned and the rest right-aligned."""
    rule = ["---" if index < left else "---:" for index in range(len(heads))]
    return "\n".join("| " + " | ".join(row) + " |" for row in [heads, rule, *rows])


def verdict(value: float, goal: float, at_most: bool) -> str:
    """'reached', or by how much a goal is missed."""
    if (value <= goal) if at_most else (value >= goal):
        return "reached"
    return f"missed by {abs(value - goal):g}"


def device_rows(devices: list[dict]) -> list[list[str]]:
    """One row a device: cells, Fmax over the seeds, goals and whether they are reached."""
    rows = []
    for entry in devices:
        goal = GOALS[entry["family"]]
        name = LUT_NAME[entry["family"]]
        goals = [f"{name} ≤ {goal['lut']}: {verdict(entry['lut'], goal['lut'], True)}"]
        if "ram" in goal:
            goals.append(f"RAM ≤ {goal['ram']}: {verdict(entry['ram'], goal['ram'], True)}")
        goals.append(f"≥ {entry['goal_mhz']:g} MHz: {verdict(entry['fmax'], entry['goal_mhz'], False)}")
        seeds = entry["seeds"]
        rows.append(
            [
                entry["device"],
                f"{entry['lut']} {name}",
                str(entry["ff"]),
                str(entry["ram"]),
                f"{entry['fmax']:.1f}",
                f"{min(seeds):.1f} … {max(seeds):.1f}",
                "; ".join(goals),
            ]
        )
    return rows


def recipe_words(recipes: dict[str, str]) -> str:
    """The recipes as the options they stand for."""
    words = []
    for family, name in recipes.items():
        pre, options = RECIPES[family][name]
        script = f" after `{pre}`" if pre else ""
        words.append(f"`{f'synth_{family} {options}'.strip()}`{script}")
    return ", ".join(words)


def markdown(report: dict, results: dict[str, Breakdown]) -> str:
    """The whole block between the markers of a part."""
    heads = ["device", "logic", "FF", "block RAM", "Fmax / MHz", "all seeds", "goals"]
    parts = [
        f"Median Fmax of {report['seed_count']} place-and-route seeds; default parameters "
        "(CLK_HZ 16 MHz, FAST), pins unconstrained. COMB is what nextpnr fills: a LUT4 one, a carry cell "
        "CCU2C two, and ends of carry chains; LUT4 is as synthesized. "
        f"Recipes: {recipe_words(report['recipes'])}. UP5K has fewer pins than the "
        "part: for its clock rate they go through shift registers, which are not counted.",
        markdown_table(heads, device_rows(report["devices"])),
        "Slowest path of the median seed:",
        "\n".join(f"- {entry['device']}: `{entry['path']}`" for entry in report["devices"]),
        "With other parameters (synthesis only):",
        markdown_table(
            ["parameters", "ECP5 COMB", "ECP5 FF", "iCE40 LUT4", "iCE40 FF"],
            [
                [
                    entry["name"],
                    *(str(entry[family][key]) for family in ("ecp5", "ice40") for key in ("lut", "ff")),
                ]
                for entry in report["variants"]
            ],
        ),
        "Where the cells are. *flat*: the flattened netlist, a LUT credited to the instance it feeds (the "
        "total is exact); *own*: each module mapped by itself.",
        markdown_table(
            ["instance", "module", "ECP5 flat", "own", "FF", "RAM", "iCE40 flat", "own", "FF", "RAM"],
            breakdown_rows(results, indent="&nbsp;&nbsp;"),
            left=2,
        ),
    ]
    return "\n\n".join(parts)
