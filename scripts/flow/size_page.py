"""The resource report: the table for the terminal and the Markdown block of docs/benchmarks.md."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from rich import box
from rich.table import Table

from .netlist import Breakdown, Count
from .report import markdown_table
from .sizes import LIMIT

HEADS = ("design", "device", "LUT", "FF", "block RAM", "of the device", "Fmax / MHz", "all seeds", "runs at")
BRIDGE = "u_host.g_uart"
KEYS = ("lut", "ff", "ram")
INSIDE = {"ecp5": "ECP5", "ice40": "iCE40"}


@dataclass(frozen=True)
class Row:
    """One design on one device.

    `fmax`: MHz of all seeds, rising. `used`: LUTs and RAMs as packed, with the device's totals. `clk_mhz`:
    the clock of a bitstream.
    """

    design: str
    device: str
    count: Count
    fmax: list[float]
    used: Mapping[str, float | int] | None = None
    clk_mhz: float | None = None

    @property
    def median(self) -> float:
        """Median Fmax, the lower one of two in the middle."""
        return self.fmax[(len(self.fmax) - 1) // 2]

    def cells(self, seeds: int = 0) -> list[str]:
        """The row as text; the number of its seeds in brackets if it has fewer than `seeds`."""
        share = ""
        if self.used:
            share = f"{100 * self.used['lut'] / self.used['lut_total']:.0f} %"
        return [
            self.design,
            self.device,
            str(self.count.lut),
            str(self.count.ff),
            str(self.count.ram),
            share,
            f"{self.median:.1f}",
            f"{self.fmax[0]:.1f} … {self.fmax[-1]:.1f}"
            + ("" if len(self.fmax) >= seeds else f" ({len(self.fmax)})"),
            f"{self.clk_mhz:g} MHz" if self.clk_mhz else "",
        ]


def terminal(rows: list[Row]) -> Table:
    """The table for the terminal."""
    table = Table(title="size and clock rate", title_justify="left", box=box.SIMPLE_HEAD)
    for place, head in enumerate(HEADS):
        table.add_column(head, justify="left" if place < 2 else "right")
    for row in rows:
        table.add_row(*row.cells())
    return table


def _sum(counts: Mapping[str, Count], below: str) -> Count:
    """Sum over an instance and everything in it."""
    total = Count()
    for path, count in counts.items():
        if path == below or path.startswith(f"{below}."):
            total.lut += count.lut
            total.ff += count.ff
            total.ram += count.ram
    return total


def _cells(counts: Iterable[Count]) -> list[str]:
    """LUT, FF and RAM of each family."""
    return [str(figure) for count in counts for figure in (count.lut, count.ff, count.ram or "")]


def has_bridge(split: Mapping[str, Breakdown]) -> bool:
    """Whether the board top has more to it than the part, reset and lamps."""
    return any(path.startswith(f"{BRIDGE}.") for path in next(iter(split.values())).kept)


def instance_rows(part: str, split: Mapping[str, Breakdown]) -> list[list[str]]:
    """What the board top adds to the part, instance by instance; without a bridge, the part in this way."""
    first, bridged = next(iter(split.values())), has_bridge(split)
    whole = [_sum(result.flat, "u_part") for result in split.values()]
    # The part by itself is in the row of its top, where its instances follow.
    own = whole if bridged else [result.flat.get("u_part", Count()) for result in split.values()]
    rows = [["u_part", f"{part}, all of it" if bridged else part, *_cells(own)]]
    opened, margin = (BRIDGE, -1) if bridged else ("u_part", 0)
    for path in sorted(path for path in first.kept if path.startswith(f"{opened}.")):
        depth = path.count(".") - opened.count(".") + margin
        name = "&nbsp;&nbsp;" * depth + path.rsplit(".", 1)[-1]
        counts = [result.flat.get(path, Count()) for result in split.values()]
        rows.append([name, first.module[path], *_cells(counts)])
    rest = []
    for result, inside in zip(split.values(), whole, strict=True):
        bridge = _sum(result.flat, BRIDGE)
        rest.append(
            Count(*(getattr(result.total, key) - getattr(inside, key) - getattr(bridge, key) for key in KEYS))
        )
    total = [result.total for result in split.values()]
    return [*rows, ["(top itself)", f"{part}_carrier", *_cells(rest)], ["total", "", *_cells(total)]]


def markdown(part: str, rows: list[Row], split: Mapping[str, Breakdown], seeds: int) -> str:
    """The whole block between a part's markers; `split` is empty when the part has no board top."""
    few = ", or as many as stand in brackets" if any(len(row.fmax) < seeds for row in rows) else ""
    top = "part and UART bridge" if not split or has_bridge(split) else "part, reset and lamps"
    parts = [
        f"{part}, written by `make report`. LUT, FF and block RAM as synthesized (LUT on ECP5 is LUT4 + "
        "2 · CCU2C, the carry cells; on Gowin an adder bit counts as one); Fmax of `clk` after place and "
        f"route, median of {seeds} seeds{few}. Part and board top ({top}, 24 MHz) with free pins, through "
        "shift registers where the device has too few (UP5K; the bank); the bitstreams with their boards' "
        "constraints, *of the device* being the "
        "share of its LUT places that are taken. `make size` compares the sizes with docs/sizes.json and "
        f"fails when one has grown by more than {LIMIT} %.",
        markdown_table(list(HEADS), [row.cells(seeds) for row in rows], left=2),
    ]
    if split:
        heads = [
            "instance",
            "module",
            *(f"{INSIDE[f]} {what}" for f in split for what in ("LUT", "FF", "RAM")),
        ]
        parts += [
            f"Where the cells of {part}_carrier are, flattened, a LUT credited to the instance it feeds:",
            markdown_table(heads, instance_rows(part, split), left=2),
        ]
    return "\n\n".join(parts)
