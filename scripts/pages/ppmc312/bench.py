"""Functions for the timing diagrams of docs/ppmc312/README.md: host on the model, columns, rows, letters."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from cocotb_tests.harness.bus import CSR, DRR, DWR, RAR, WAR, WCR
from cocotb_tests.harness.config import F16, Config
from cocotb_tests.harness.model_bench import OnModel
from cocotb_tests.ppmc312.blocks import TF
from cocotb_tests.ppmc312.host import Host
from scripts.pages.pictures.recorded import (
    Levels,
    Row,
    Samples,
    Schedule,
    clock,
    labels,
    numbered,
    record,
    thinned,
    wave,
)
from scripts.pages.pictures.recorded import table as drawn

Drawing = dict[str, Any]
WIDE = {"hscale": 2}
ANSWERS = 0x10  # CSR: irq_n reports answers
NAMES = {(0, CSR): "CSR", (0, RAR): "RAR", (0, DRR): "DRR", (1, CSR): "CSR", (1, WCR): "WCR"}
NAMES |= {(1, WAR): "WAR", (1, DWR): "DWR"}


def flags(chip: Any) -> Levels:
    """Return MWEF and MREF, as a read of CSR returns them, and the edge."""
    return {"mwef": chip.csr >> 3 & 1, "mref": chip.csr >> 2 & 1, "t": chip.now}


def marked(row: Row, samples: Samples, letters: str) -> Row:
    """Return the row with letters for arrows at its changes. A full stop means no letter."""
    levels = [None if found is None else row.of(found) for found in samples]
    changes, last = [], next(level for level in levels if level is not None)
    for column, found in enumerate(samples):
        if found is not None and levels[column] != last:
            changes.append(column)
            last = levels[column]
    nodes = {column: letter for column, letter in zip(changes, letters, strict=False) if letter != "."}
    return replace(row, nodes=nodes)


def hexadecimal(value: int) -> str:
    """Return a byte as two hexadecimal digits."""
    return f"{value:02X}"


def during(strobe: str, name: str) -> Callable[[Levels], int | None]:
    """Return a function for a level that is used only while an active-low strobe is asserted."""
    return lambda levels: None if levels[strobe] else levels[name]


async def ready(*setting: str, build: Config = F16) -> Host:
    """Return a host on a model that is set up, with interrupts for answers."""
    host = await Host.start(OnModel(build), *setting)
    await host.write(CSR, ANSWERS)
    await host.pause(40)
    return host


def write_cycle(edge: int, reg: int, byte: int, strobe: int = 3) -> Schedule:
    """Return the pins of a write whose strobe is sampled from `edge` on for `strobe` cycles."""
    on = {"cs_n": 0, "we_n": 0, "rs": reg, "d_i": byte}
    return [(edge, on), (edge + strobe, {"cs_n": 1, "we_n": 1})]


def read_cycle(edge: int, reg: int, strobe: int = 5) -> Schedule:
    """Return the pins of a read whose strobe is sampled from `edge` on for `strobe` cycles."""
    return [(edge, {"cs_n": 0, "oe_n": 0, "rs": reg}), (edge + strobe, {"cs_n": 1, "oe_n": 1})]


def block_cycles(edge: int, block: str) -> tuple[Schedule, int]:
    """Return WAR and DWR writes of an instruction from `edge` on, and the edge after the header's strobe."""
    data = bytes.fromhex(block)[::-1]
    accesses = [(WCR, 0x20), (WAR, 0x20 - len(data)), *((DWR, byte) for byte in data)]
    schedule = [
        step for n, (reg, byte) in enumerate(accesses) for step in write_cycle(edge + 6 * n, reg, byte)
    ]
    return schedule, edge + 6 * len(accesses) - 3


async def on_the_way(number: int, block: str, origin: int = 0) -> tuple[Host, int]:
    """Return a host shortly before pulse `number` of a motion, and the edge of that pulse.

    Args:
        origin: the pulse after which the origin switch closes; it opens again five pulses later.
    """
    edge = 0
    while True:
        host = await ready(*TF)
        await host.ask(block)
        if origin:
            await host.pulse(origin)
            await host.pins(org_n=0)
            await host.pulse(origin + 5)
            await host.pins(org_n=1)
        if edge:
            await host.go(edge - 20)
            return host, edge
        edge = await host.pulse(number)


def look(host: Host, schedule: Schedule, columns: Sequence[int | None]) -> Samples:
    """Return the model's pins and flags at the edges of the columns."""
    model = host.bench.golden
    return record(model, model.inputs, schedule, columns, flags)


def table(
    host: Host,
    schedule: Schedule,
    base: int,
    columns: Sequence[int | None],
    rows: Sequence[tuple[Row, str]],
    title: str,
    arrows: Sequence[str] = (),
) -> Drawing:
    """Return a diagram with edges counted from `base` as columns, a gap for None; rows with their letters."""
    at = [None if number is None else base + number for number in columns]
    samples = look(host, schedule, at)
    shown = thinned(at, samples, [row for row, _ in rows])
    samples = [None if edge is None else samples[at.index(edge)] for edge in shown]
    words, foot = numbered([None if edge is None else edge - base for edge in shown])
    lines = [labels("clk edge", words)]
    lines += [wave(marked(row, samples, letters), samples) for row, letters in rows]
    return drawn(lines, title, foot, arrows)


def cycle(
    host: Host,
    schedule: Schedule,
    columns: range,
    first: Sequence[tuple[Row, str]],
    second: Sequence[tuple[Row, str]],
    tick: int,
    texts: tuple[str, str, Sequence[str]],
) -> Drawing:
    """Return a bus access with one column for each cycle.

    Args:
        texts: texts of head, foot and arrows.
    """
    samples = look(host, schedule, columns)
    return {
        "signal": [
            clock(samples),
            ["host", *(wave(marked(row, samples, letters), samples) for row, letters in first)],
            ["core", *(wave(marked(row, samples, letters), samples) for row, letters in second)],
        ],
        "head": {"tick": tick, "text": texts[0]},
        "foot": {"text": texts[1]},
        "edge": list(texts[2]),
    }
