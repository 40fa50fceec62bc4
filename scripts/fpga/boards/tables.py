"""Tables that are generated between markers: pins and boards on pages, tops in rtl/files.yml."""

from __future__ import annotations

import json
import re
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError
from openppmc import parts
from openppmc.host.selftest.plan import Plan
from scripts.fpga.boards.description import Description
from scripts.fpga.boards.pads import Fitted
from scripts.markdown import table

TIMING = project.ROOT / "docs" / "timing.json"
"""Clock rates of the bitstreams after routing, written by scripts/fpga/flow/timing.py."""
WAYS = {"in": "in", "out": "out", "inout": "in, out"}


def pin_table(fitted: Fitted) -> str:
    """Return the table of signals with direction, package pin and place."""
    rows = [(f"`{pad.bit}`", WAYS[pad.way], pad.pin, pad.where) for pad in fitted.pads]
    return table(("signal", "", "FPGA pin", "where"), rows)


def board_table(boards: tuple[Description, ...]) -> str:
    """Return the table of boards with their FPGA, clocks and parts."""
    rows = []
    for board in boards:
        names = ", ".join(f"`{device.name}`" for device in board.devices) or "–"
        rates = dict.fromkeys(f"{on.mhz:g}" for on in board.parts)
        parts = ", ".join(dict.fromkeys(f"`{on.part}`" for on in board.parts))
        tool = board.vendor.get("tool", "").capitalize()
        built = "yes" if board.devices else f"**not run here**: for {tool}"
        clocks = f"{board.clock['mhz']:g} MHz", f"{' or '.join(rates)} MHz"
        rows.append((names, board.title, board.chip, *clocks, parts, built))
    return table(("`BOARD`", "board", "FPGA", "oscillator", "`clk`", "`PART`", "built here"), rows)


def timing_table(boards: tuple[Description, ...]) -> str:
    """Return the table of the setup margins of the bitstreams, with the smallest relative margin first."""
    figures = json.loads(TIMING.read_text(encoding="utf-8"))
    rows: list[tuple[float, tuple[str, ...]]] = []
    missing = []
    for board in boards:
        for device in board.devices:
            for on in board.parts:
                part = "" if on.part == "ppmc104" else f"-{on.part}"
                for host in on.hosts:
                    name = device.name + part + ("" if host == "uart" else f"-{host}")
                    if name not in figures:
                        missing.append(f"`{name}`")
                        continue
                    mhz, seed = figures[name]["mhz"], figures[name]["seed"]
                    period, longest = 1000 / on.mhz, 1000 / mhz
                    margin = period - longest
                    ns = (f"{period:.2f} ns", f"{longest:.2f} ns", f"{margin:.2f} ns")
                    percent = f"{100 * margin / period:.0f} %"
                    rows.append((margin / period, (f"`{name}`", f"{on.mhz:g} MHz", *ns, percent, str(seed))))
    heads = ("bitstream", "`clk`", "period", "longest path", "setup margin", "share of the period", "seed")
    body = table(heads, [row for _, row in sorted(rows)])
    return f"{body}\n\nNot measured: {', '.join(missing)}." if missing else body


def flash_table(boards: tuple[Description, ...]) -> str:
    """Return the table of the boards that `make flash` can load, each with its first part."""
    rows = []
    for board in boards:
        first = board.parts[0]
        part = "" if first.part == "ppmc104" else f" PART={first.part}"
        loads = [f"`make flash BOARD={device.name}{part}`" for device in board.devices]
        if loads:
            clk = f"{board.chip}, `clk` {first.mhz:g} MHz"
            rows.append((board.title, clk, " or ".join(loads), board.port))
    return table(("board", "FPGA", "bitstream and load", "port"), rows, left=4)


def jumper_table(fitted: list[Fitted]) -> str:
    """Return the table of self-test wires for boards with a recorder; it marks signals without a pin."""
    rows = []
    for one in fitted:
        recorder = "uart" in one.on.hosts and "RECORD" not in (one.on.omit or {})
        if not recorder or not one.on.row.selftest or not one.board.devices:
            continue
        plan: Plan = one.on.row.load("selftest")
        places = {pad.bit: pad.where for pad in one.pads}
        for wire in plan.jumpers:
            ends = [
                f"{places[bit].split(',')[0]} (`{bit}`)" if bit in places else f"`{bit}` has no pin"
                for bit in (wire.output, wire.input)
            ]
            rows.append((one.board.title, f"`{one.on.part}`", *ends, wire.what))
    return table(("board", "part", "from", "to", "for"), rows)


def recorder_table() -> str:
    """Return the table of the pins in a recorder's record for each part (bank: 8 axes), lowest bit first."""
    rows = []
    for row in parts.having("selftest"):
        plan: Plan = row.load("selftest")
        width = record_width(row)
        pins = ", ".join(f"`{name}`" + (f" {bits}" if bits > 1 else "") for name, bits in plan.layout(width))
        axes = " (8 axes)" if row.name == "bank" else ""
        rows.append((f"{row.title}{axes}", width, pins))
    return table(("part", "levels", "pins, from the lowest bit on"), rows, left=3)


def record_width(row: parts.Row) -> int:
    """Return the number of levels that a carrier records (for a bank: 8 axes), read from its source."""
    path = project.RTL / row.folder / f"{row.rtl}_carrier.sv"
    found = re.search(r"localparam int unsigned Watch = ([^;]*);", path.read_text(encoding="utf-8"))
    words = re.fullmatch(r"(\d+)(?: \+ (\d+) \* AXES)?", found[1]) if found else None
    if words is None:
        raise ProjectError(f"{project.relative(path)}: no line `localparam int unsigned Watch = …`")
    return int(words[1]) + 8 * int(words[2] or 0)


def put(text: str, begin: str, end: str, body: str, where: str) -> str:
    """Return `text` with `body` between the lines `begin` and `end`; raise ProjectError without them."""
    head, found, rest = text.partition(f"{begin}\n")
    _, closed, tail = rest.partition(end)
    if not found or not closed:
        raise ProjectError(f"{where}: put the lines {begin} and {end} at the place of the table")
    return f"{head}{begin}\n{body}\n{end}{tail}"


def pages(boards: tuple[Description, ...], fitted: list[Fitted]) -> dict[Path, str]:
    """Return path and updated text of each page with tables between <!-- marker --> and <!-- /marker -->."""
    tables = {
        "docs/boards.md": {
            "boards": board_table(boards),
            "timing": timing_table(boards),
            "jumpers": jumper_table(fitted),
            **{f"pins {one.board.constraints(one.on)}": pin_table(one) for one in fitted},
        },
        "README.md": {"boards": flash_table(boards)},
        "docs/uart_bridge.md": {"recorder": recorder_table()},
    }
    found = {}
    for name, bodies in tables.items():
        path = project.ROOT / name
        text = path.read_text(encoding="utf-8")
        for marker, body in bodies.items():
            text = put(text, f"<!-- {marker} -->", f"<!-- /{marker} -->", body, name)
        found[path] = text
    return found


def listing(boards: tuple[Description, ...], fitted: list[Fitted], text: str) -> str:
    """Return rtl/files.yml with an updated list of clock modules and board tops."""
    clocks = dict.fromkeys(board.clock["module"] for board in boards if "module" in board.clock)
    files = [project.RTL / _clock(module) for module in clocks]
    names = [path.relative_to(project.RTL).as_posix() for path in files]
    names += [f"boards/{one.board.name}/{one.top}.sv" for one in fitted]
    carriers = dict.fromkeys(f"{one.on.row.rtl}_carrier" for one in fitted)
    order = [group for group in project.listed() if group in ("leds", *carriers)]
    body = "\n".join([f"  needs: [{', '.join(order)}]", "  files:", *(f"    - {name}" for name in names)])
    return put(text, "  # written by `make boards`", "  # end", body, "rtl/files.yml")


def _clock(module: str) -> Path:
    """Return the path of a clock module, relative to rtl/."""
    found = sorted((project.RTL / "boards").glob(f"*/{module}.sv"))
    if not found:
        raise ProjectError(f"rtl/boards/<board>/{module}.sv is missing; a board.yml names this clock module")
    return found[0].relative_to(project.RTL)
