"""The timing diagrams of docs/ppmc312/README.md, from the pins of the golden model."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import Any

from cocotb_tests.harness.bus import CSR, DRR, DWR, RAR, WAR, WCR
from cocotb_tests.harness.config import D16
from cocotb_tests.harness.model_bench import on_model
from cocotb_tests.ppmc312.blocks import TF
from scripts.pages.pictures.recorded import Levels, Row, wave
from scripts.pages.ppmc312.bench import (
    NAMES,
    WIDE,
    Drawing,
    block_cycles,
    cycle,
    during,
    flags,
    hexadecimal,
    look,
    on_the_way,
    read_cycle,
    ready,
    table,
    write_cycle,
)


async def write() -> Drawing:
    """Draw the write of a header."""
    host = await ready()
    for reg, byte in ((WCR, 0x20), (WAR, 0x1D), (DWR, 0x40), (DWR, 0x01)):
        await host.write(reg, byte)
    rows = (
        (Row("cs_n, we_n", "we_n", host=True), ".A"),
        (Row("rs", during("we_n", "rs"), str, host=True), ""),
        (Row("d_i", during("we_n", "d_i"), hexadecimal, host=True), ""),
    )
    core = ((Row("MWEF", "mwef"), "B"),)
    texts = (
        "Header into DWR: clk edges counted from the end of the strobe",
        "at edge 2 the byte is stored; the block is complete and is processed",
        ["A~>B"],
    )
    return cycle(host, write_cycle(host.t, DWR, 3), range(host.t - 1, host.t + 10), rows, core, -4, texts)


async def read() -> Drawing:
    """Draw the read of the last byte of an answer."""
    host = await ready()
    await host.issue("03 01 40")
    await host.wait()
    for _ in range(3):
        await host.read(DRR)
    start = host.t + 8
    rows = (
        (Row("cs_n, oe_n", "oe_n", host=True), "AB"),
        (Row("rs", during("oe_n", "rs"), str, host=True), ""),
    )
    core = (
        (Row("d_oe", "d_oe"), "CD"),
        (Row("d_o", lambda levels: levels["d_o"] if levels["d_oe"] else None, hexadecimal), ""),
        (Row("MREF", "mref"), "E"),
        (Row("irq_n (ERIRQ = 1)", "irq_n"), ""),
    )
    texts = (
        "The last byte from DRR, 5 cycles: clk edges counted from the start of the strobe",
        "the read takes effect when the strobe has ended",
        ["A~>C", "B~>D", "B~>E"],
    )
    return cycle(host, read_cycle(start, DRR), range(start - 2, start + 12), rows, core, -2, texts)


async def wrq() -> Drawing:
    """Draw two DWR strobes that are too close for the old chip."""
    host = await ready(build=D16)
    await host.write(CSR, 0x40)
    await host.write(WCR, 0x20)
    await host.write(WAR, 0x1D)
    await host.pause(40)
    schedule = [*write_cycle(host.t, DWR, 0x40), *write_cycle(host.t + 6, DWR, 0x01, 11)]
    rows = (
        (Row("cs_n, we_n", "we_n", host=True), "..BD"),
        (Row("d_i", during("we_n", "d_i"), hexadecimal, host=True), ""),
    )
    core = ((Row("wrq_n", "wrq_n"), "EC"),)
    texts = (
        "EWRQ = 1, DATASHEET, 16 MHz: a second DWR strobe 188 ns after the first one",
        "the host keeps the strobe until wrq_n is H again",
        ["B~>E", "C~>D"],
    )
    return cycle(host, schedule, range(host.t - 1, host.t + 21), rows, core, -1, texts)


async def block() -> Drawing:
    """Draw all accesses of a version read."""
    host = await ready()
    begin = host.t + 4
    schedule, end = block_cycles(begin, "03 01 40")
    there = end + 100
    reads = [RAR, DRR, DRR, DRR, DRR]
    schedule = [*schedule, *(s for n, reg in enumerate(reads) for s in read_cycle(there + 10 * n, reg))]
    writes = 5
    columns: list[int | None] = [begin - 2, *(begin + 6 * n + 2 for n in range(writes)), end + 3, None]
    columns += [there - 4, *(there + 10 * n + 4 for n in range(len(reads))), there + 10 * len(reads) + 2]

    def access(levels: Levels) -> int | None:
        if not levels["we_n"]:
            return levels["rs"] << 8 | levels["d_i"] | 1 << 12
        return None if levels["oe_n"] else levels["rs"] << 8 | levels["d_o"]

    def text(value: int) -> str:
        return f"{NAMES[value >> 12, value >> 8 & 7]} {value & 0xFF:02X}"

    rows = (
        Row("access", access, text),
        Row("MWEF", "mwef"),
        Row("MREF", "mref"),
        Row("irq_n (ERIRQ = 1)", "irq_n"),
    )
    samples = look(host, schedule, columns)
    return {
        "signal": [wave(row, samples) for row in rows],
        "config": WIDE,
        "head": {"text": "03 01 40 and its answer 03 02 40 12: writes to the left, reads to the right"},
    }


async def start() -> Drawing:
    """Draw the time from the header of a move to pulse 2."""
    move = "03 08 83 40 0064 00000005"
    ahead = await ready(*TF)
    await ahead.issue(move)
    await ahead.pause(8)  # the block is being processed
    while flags(ahead.bench.golden)["mwef"]:
        await ahead.pause(1)
    free = ahead.t - 1 - ahead.header
    first = await ahead.pulse(1) - ahead.header
    turned = ahead.bench.rises("dir")[0] - ahead.header
    host = await ready(*TF)
    schedule, end = block_cycles(host.t + 4, move)
    columns = (
        -1, 0, 1, 2, None, turned - 1, turned, turned + 1, None, free - 1, free, None,
        first - 1, first, first + 1, None, first + 79, first + 80, None, first + 1599, first + 1600,
    )  # fmt: skip
    rows = (
        (Row("we_n", "we_n", host=True), ""),
        (Row("MWEF", "mwef"), ""),
        (Row("dir", "dir"), "A"),
        (Row("pout", "pout"), "BC"),
    )
    title = "83, CCW, rate 100 at F = 1 MHz (FAST, 16 MHz): clk edges from the end of the header's strobe"
    return table(host, schedule, end, columns, rows, title, ["A~>B 5 us", "B<->C 5 us"])


async def end() -> Drawing:
    """Draw the last pulse of a move, its report, and cd_n."""
    host, last = await on_the_way(3, "03 08 83 00 0064 00000003")
    over = 1600
    down = over + 1_600_000
    columns = (-1, 0, 1, None, 79, 80, 81, None, over - 1, *range(over, over + 10), None,
               down - 1, down, down + 1, down + 2)  # fmt: skip
    rows = (
        (Row("pout", "pout"), ""),
        (Row("irq_n (report E0)", "irq_n"), ""),
        (Row("cd_n", "cd_n"), ""),
    )
    title = "Normal end, rate 100: clk edges from the last pulse; the interval lasts until edge 1600"
    return table(host, [], last, columns, rows, title)


async def stop() -> Drawing:
    """Draw a limit shortly before a scheduled pulse."""
    going = "03 04 86 00 0064"
    host, due = await on_the_way(5, going)
    press = due - 4

    def undisturbed(levels: Levels) -> int:
        return int(due <= levels["t"] < due + 80)

    columns = tuple(range(-2, 14))
    rows = (
        (Row("fl_n", "fl_n", host=True), "A"),
        (Row("pout without the limit", undisturbed), ""),
        (Row("pout", "pout"), ""),
        (Row("irq_n (report E0)", "irq_n"), ""),
    )
    title = "Limit 4 cycles before a pulse (FAST): clk edges from the first that samples it"
    return table(host, [(press, {"fl_n": 0})], press, columns, rows, title)


async def hold() -> Drawing:
    """Draw a move that waits for RUN."""
    host = await ready(*TF)
    await host.pins(run=0)
    await host.ask("03 08 83 40 0064 00000005")
    await host.pause(200)
    go = host.t + 4
    columns = (*range(-2, 14), None, 82, 83, 84, 85, 86)
    rows = (
        (Row("run", "run", host=True), "A"),
        (Row("dir", "dir"), "B"),
        (Row("irq_n (report E2)", "irq_n"), ""),
        (Row("pout", "pout"), "C"),
    )
    title = "A move held by run (FAST): clk edges from the first that samples run = H"
    return table(host, [(go, {"run": 1})], go, columns, rows, title, ["A~>B", "B~>C 5 us"])


async def turn() -> Drawing:
    """Draw the end of phase 1 of a zero return and the start of phase 2."""
    back = "03 04 11 00 0000"
    ahead, last = await on_the_way(27, back, 15)
    again = await ahead.pulse(28) - last
    turned = ahead.bench.rises("dir")[0] - last
    host, last = await on_the_way(27, back, 15)
    columns = (-1, 0, 1, None, 79, 80, 81, None, 6399, 6400, *range(6401, turned + 3), None,
               *range(again - 1, again + 3))  # fmt: skip
    rows = ((Row("pout", "pout"), "..D"), (Row("dir", "dir"), "C"))
    title = "Zero return reverses: clk edges from the last pulse of phase 1 (interval of 6400 cycles)"
    return table(host, [], last, columns, rows, title, ["C~>D 5 us"])


def _drawn(scene: Callable[[], Coroutine[Any, Any, Drawing]]) -> Callable[[], Drawing]:
    """Return a function that draws a scene, which runs on the golden model."""
    return lambda: on_model(scene())


SCENES = (write, read, wrq, block, start, end, stop, hold, turn)
DIAGRAMS: dict[str, Callable[[], Drawing]] = {scene.__name__: _drawn(scene) for scene in SCENES}
