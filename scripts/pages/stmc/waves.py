"""The timing diagrams of docs/stmc/README.md, from the pins of the golden model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from openppmc.model.stmc import pc104_board
from openppmc.model.stmc.pc104_board import J105Stmc
from scripts.pages.pictures.recorded import (
    Levels,
    Row,
    Schedule,
    clock,
    labels,
    numbered,
    read_cycle,
    record,
    table,
    wave,
    write_cycle,
)
from scripts.pages.stmc.bench import Bench, little

Drawing = dict[str, Any]
RAMP = (20, 5, 8)
INIT, CHOPPED = 0x0A, 0x2A
COMMAND_PORT = 0x3B1


def pattern(value: int) -> str:
    """Return the phase outputs as text."""
    return f"{value:05b}"


def hexadecimal(value: int) -> str:
    """Return a byte as two hexadecimal digits."""
    return f"{value:02X}"


def during(strobe: str, name: str) -> Callable[[Levels], int | None]:
    """Return a function for a level that is used only while an active-low strobe is asserted."""
    return lambda levels: None if levels[strobe] else levels[name]


def addressed(levels: Levels) -> int | None:
    """Return the address while it is that of the board."""
    return levels["sa"] if levels["sa"] == COMMAND_PORT else None


def ready(code: int = INIT, **parameters: object) -> Bench:
    """Return a bench some cycles after its initialisation."""
    bench = Bench(**parameters)  # type: ignore[arg-type]
    bench.init(code, *RAMP)
    bench.t += 10
    bench.chip.read(bench.t, 0)
    bench.t += 40
    return bench


def moved(code: int = INIT, count: int = 1) -> tuple[Bench, int]:
    """Return a bench with a move of `count` steps from `t` on, and the future edge of the last step."""
    ahead = ready(code)
    ahead.start(0x43, *little(count - 1))
    last = ahead.end().steps[-1]
    bench = ready(code)
    bench.send(0x43, *little(count - 1))
    return bench, last


def _table(
    bench: Bench,
    schedule: Schedule,
    base: int,
    columns: Sequence[int | None],
    rows: Sequence[Row],
    title: str,
    arrows: Sequence[str] = (),
    words: Sequence[str | None] | None = None,
    what: str = "clk edge",
) -> Drawing:
    """Return a diagram with edges counted from `base` as columns, a gap for None."""
    at = [None if number is None else base + number for number in columns]
    samples = record(bench.chip, bench.chip.inputs, schedule, at)
    foot = ""
    if words is None:
        words, foot = numbered(columns)
    lines = [labels(what, words), *(wave(row, samples) for row in rows)]
    return table(lines, title, foot, arrows)


def _cycle(bench: Bench, schedule: Schedule, first: int, count: int, groups: Any, texts: Any) -> Drawing:
    """Return a bus access with one column for each cycle from edge `first` on."""
    samples = record(bench.chip, bench.chip.inputs, schedule, range(first, first + count))
    lines = [[name, *(wave(row, samples) for row in rows)] for name, rows in groups]
    tick, title, foot, arrows = texts
    return {
        "signal": [clock(samples), *lines],
        "head": {"tick": tick, "text": title},
        "foot": {"text": foot},
        "edge": arrows,
    }


def write() -> Drawing:
    """Draw a write."""
    bench = ready()
    host = (
        Row("cs_n, wr_n", "wr_n", host=True, nodes={4: "A"}),
        Row("a0", during("wr_n", "a0"), str, host=True),
        Row("d_i", during("wr_n", "d_i"), hexadecimal, host=True),
    )
    core = (
        Row("IBF", "ibf", nodes={6: "B", 8: "C"}),
        Row("BUSY", "busy"),
        Row("hold", "hold", nodes={9: "D"}),
    )
    texts = (
        -4,
        "Write of a Single Step: clk edges counted from the end of the strobe",
        "edge 2 recorded, edge 4 accepted and checked, edge 5 motor pins",
        ["A~>B", "B~>C", "C~>D"],
    )
    cycle = write_cycle(bench.t, 1, 0x42)
    return _cycle(bench, cycle, bench.t - 1, 12, (("host", host), ("core", core)), texts)


def read() -> Drawing:
    """Draw a data read that removes the byte."""
    bench = ready()
    bench.send(0x82)
    bench.t += 20
    host = (
        Row("cs_n, rd_n", "rd_n", host=True, nodes={2: "A", 7: "B"}),
        Row("a0", during("rd_n", "a0"), str, host=True),
    )
    core = (
        Row("d_oe", "d_oe", nodes={2: "C", 7: "D"}),
        Row("d_o", "d_o", hexadecimal),
        Row("OBF", "obf", nodes={9: "E"}),
    )
    texts = (
        -2,
        "Data read with a 5-cycle strobe: clk edges counted from its start",
        "edge 5 is the first without the strobe; OBF falls two edges later",
        ["A~>C", "B~>D", "B~>E"],
    )
    return _cycle(bench, read_cycle(bench.t, 0), bench.t - 2, 12, (("host", host), ("core", core)), texts)


def start() -> Drawing:
    """Draw the time from the last byte of a move to step 1."""
    bench = ready()
    bench.write(1, 0x43)
    for byte in (19, 0):
        bench.taken()
        bench.write(0, byte)
    bench.taken()
    taken = bench.t + 8 + 3 + 4
    cycle = write_cycle(bench.t + 8, 0, 0)
    columns = (-3, -2, -1, 0, 1, 2, None, 80, 81, 82, 83, None, 80 + 25_600, 81 + 25_600, 82 + 25_600)
    rows = (
        Row("IBF", "ibf"),
        Row("BUSY", "busy"),
        Row("hold", "hold", nodes={4: "A"}),
        Row("s[5:1]", "s", pattern, nodes={8: "B", 13: "C"}),
    )
    title = "Start of command 3 (FAST, internal clock): clk edges from the one that accepts the last byte"
    return _table(bench, cycle, taken, columns, rows, title, ["A~>B 5 us", "B~>C D1 = 20 ticks"])


def end() -> Drawing:
    """Draw the end of a move, its interrupt, and HOLD."""
    bench, last = moved(count=2)
    cycle = write_cycle(last + 100, 1, 0x80)
    hold = 544_000
    columns = (-2, -1, 0, 1, 2, None, 105, 106, 107, 108, None, hold - 1, hold, hold + 1, hold + 2)
    rows = (
        Row("s[5:1]", "s", pattern, nodes={2: "A"}),
        Row("BUSY", "busy", nodes={2: "B"}),
        Row("int_n", "int_n", nodes={2: "C"}),
        Row("IBF (80 is written)", "ibf"),
        Row("hold", "hold", nodes={2: "D", 13: "E"}),
    )
    title = "Normal end (FAST): clk edges from the last step on"
    return _table(bench, cycle, last, columns, rows, title, ["D<->E 34 ms"])


def stop() -> Drawing:
    """Draw a limit switch between two steps."""
    bench, _ = moved(count=200)
    bench.in_gap(12)
    press = bench.t
    columns = tuple(range(-3, 9))
    rows = (
        Row("l1_n", "l1_n", host=True, nodes={3: "A"}),
        Row("BUSY", "busy", nodes={6: "B"}),
        Row("int_n", "int_n"),
        Row("s[5:1]", "s", pattern),
        Row("hold", "hold"),
    )
    title = "Stop limit in a cw move (FAST): clk edges counted from the first that samples the switch"
    return _table(bench, [(press, {"l1_n": 0})], press, columns, rows, title, ["A~>B"])


def chop() -> Drawing:
    """Draw chopping at standstill and the next move."""
    bench, last = moved(CHOPPED)
    on, off = 1040, 1740
    again = 2 * on + off + 500  # in an off-time
    taken = again + 3 + 4
    columns = (
        -1, 0, 1, None, on, on + 1, on + 2, None, on + off, on + off + 1, None,
        taken - 1, taken, taken + 1, None, taken + 80, taken + 81,
    )  # fmt: skip
    rows = (
        Row("BUSY", "busy"),
        Row("s[5:1]", "s", pattern, nodes={1: "A", 5: "B", 9: "C"}),
    )
    title = "Chopping at standstill (init bit 5 = 1), then a Single Step: clk edges from the last step on"
    cycle = write_cycle(last + again, 1, 0x42)
    return _table(bench, cycle, last, columns, rows, title, ["A<->B 65 us", "B<->C 108.75 us"])


def datasheet() -> Drawing:
    """Draw a constant-speed move of two steps in DATASHEET timing, and the 80 that follows it."""
    bench = ready(timing="DATASHEET")
    bench.write(1, 0x44)
    for byte in (10, 1, 0):
        bench.taken()
        bench.write(0, byte)
    bench.taken()
    recorded = bench.t + 8 + 3 + 2
    first = 3_107
    second = first + 12_800
    over = second + 417
    free = second + 2_497
    schedule = [*write_cycle(bench.t + 8, 0, 0), *write_cycle(recorded + over + 200, 1, 0x80)]
    edges = (-1, 0, 3, None, 437, None, first, None, second, None, over + 2, over + 400, None, free + 4)
    words = [None if edge is None else f"{max(edge, 0) / 16:.1f}" for edge in edges]
    words[0] = ""
    rows = (
        Row("IBF", "ibf"),
        Row("BUSY", "busy"),
        Row("hold", "hold"),
        Row("s[5:1]", "s", pattern),
        Row("int_n", "int_n"),
        Row("OBF", "obf"),
    )
    title = "TIMING = DATASHEET: 44 0A 01 00 00 and then 80, times in us from the last byte on"
    return _table(bench, schedule, recorded, edges, rows, title, (), words, "us")


def isa() -> Drawing:
    """Draw a command and a status read on the board's bus."""
    board = J105Stmc()
    first = 20
    schedule: Schedule = [
        (first, {"sa": 0x3B1}),
        (first + 1, {"iow_n": 0, "sd_i": 0x42}),
        (first + 10, {"iow_n": 1}),
        (first + 11, {"sa": 0x155}),
        (first + 13, {"sa": 0x3B1}),
        (first + 15, {"ior_n": 0}),
        (first + 24, {"ior_n": 1}),
        (first + 25, {"sa": 0x155}),
    ]
    columns = [first - 1 + n for n in range(29)]
    samples = record(board, pc104_board.INPUTS, schedule, columns)
    rows = (
        Row("sa, aen = 0", addressed, "{:X}h".format, host=True),
        Row("iow_n", "iow_n", host=True),
        Row("sd, from the host", during("iow_n", "sd_i"), hexadecimal, host=True),
        Row("ior_n", "ior_n", host=True, nodes={16: "A"}),
        Row("sd_oe", "sd_oe", nodes={16: "B"}),
        Row("sd, from the board", lambda levels: levels["sd_o"] if levels["sd_oe"] else None, hexadecimal),
    )
    return {
        "signal": [clock(samples), *(wave(row, samples) for row in rows)],
        "head": {"text": "42 to the command register, then the status (A0: not initialised), 16 MHz, 560 ns"},
        "foot": {"text": "sd_oe rises at a clk edge; it falls with ior_n, drawn here at the next edge"},
        "edge": ["A~>B"],
    }


DIAGRAMS: dict[str, Callable[[], Drawing]] = {
    "write": write,
    "read": read,
    "start": start,
    "end": end,
    "stop": stop,
    "chop": chop,
    "datasheet": datasheet,
    "isa": isa,
}
