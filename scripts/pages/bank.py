"""Kinds of tables and pictures for docs/bank/figures.yml, from the golden model of the bank and its sizes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.figure import Figure

from openppmc.check.records import level_at
from openppmc.model.bank.chopper import VisitSchedule
from openppmc.model.bank.window import (
    BUSY,
    CONFIG,
    DATA,
    ERR,
    GO,
    IBF,
    INFO,
    MASK,
    OBF,
    PENDING,
    POSITION,
    STATUS,
    STOP,
)
from scripts.demo.bank.session import READ_FINISH, Access, Session
from scripts.markdown import table
from scripts.measure.sizes import designs, figures, size_page
from scripts.pages.pictures.plots import BLUE, GREEN, GREY, RED
from scripts.pages.pictures.recorded import Levels, Row, Samples, labels, thinned, wave

SESSION_AXES = 32
RAMP = (0x0A, 0x63, 0x13, 0x64, 0x00)  # initialisation bytes: 5 to 25 kpps within 100 pulses
BITS = ((ERR, "ERR"), (BUSY, "BUSY"), (IBF, "IBF"), (OBF, "OBF"))
Lines = list[tuple[str, int]]
"""Explanations in a session, each with the number of accesses before it."""


def meaning(one: Access) -> str:
    """Return the name of a register."""
    names = {DATA: "data", CONFIG: "CONFIG", GO: "GO", STOP: "STOP"}
    if one.register == STATUS:
        return "command" if one.write else "status"
    if one.register in (MASK, PENDING, INFO):
        name = {MASK: "MASK", PENDING: "interrupt map", INFO: "INFO"}[one.register]
        return f"{name} byte {one.axis}"
    if POSITION <= one.register < POSITION + 4:
        return f"position byte {one.register - POSITION}"
    return names[one.register]


def flags(byte: int) -> str:
    """Return a status as text."""
    found = [name for bit, name in BITS if byte & bit]
    wanted = byte >> 4 & 7
    if wanted and not byte & 0x80:
        found.append(f"{wanted} more bytes expected" if wanted > 1 else "1 more byte expected")
    return ", ".join(found) or "ready"


def rows(accesses: list[Access], notes: Lines) -> list[list[str]]:
    """Return one row for each access. Consecutive equal polls are combined in one row."""
    found, at = list[list[str]](), 0
    for note, end in notes:
        first = True
        while at < end:
            one, count = accesses[at], 1
            while at + count < end and _same(accesses[at + count], one):
                count += 1
            times = f" × {count}" if count > 1 else ""
            what = f"axis {one.axis}: {meaning(one)}" if one.register < MASK else meaning(one)
            said = f"{one.byte:02X}{times}"
            if one.register == STATUS and not one.write:
                said += f": {flags(one.byte)}"
            data = [f"{one.byte:02X}", ""] if one.write else ["", said]
            found.append([f"{one.axis << 4 | one.register:03X}", what, *data, note if first else ""])
            first, at = False, at + count
    return found


def _same(one: Access, other: Access) -> bool:
    return not one.write and one[1:] == other[1:]


HEADS = ["a", "register", "write", "read", ""]


def axis_session() -> str:
    """Return a session with axis 5: INFO, CONFIG, initialisation, a move, its end, and the position."""
    host, notes = Session(SESSION_AXES, 100_000_000), []

    def note(text: str) -> None:
        notes.append((text, len(host.accesses)))

    for k in range(3):
        host.read(k, INFO)
    note("a bank, version 1 of the window, 32 axes")
    host.write(5, CONFIG, 0b11)
    note("base clock 500 kHz, plain rate formula (the levels after reset)")
    host.send(5, *RAMP)
    note("initialise: 4-phase motor, RL 99, RH 19, PA 100")
    host.send(5, 0x43, 0xE7, 0x03, 0x00)
    note("acceleration/deceleration move CW, 1000 pulses")
    host.t += 100_000
    host.position(5)
    note("1 ms later: current position")
    while host.model.busy(5):
        host.run(host.t + 1000)
    host.poll(5)
    note("later: stopped; `int_n` is L")
    host.read(0, PENDING)
    note("bit 5: the motion of axis 5 ended")
    host.answer(5, READ_FINISH)
    note("finish status: a ramped move, complete; `int_n` = H")
    host.position(5)
    note("0x000003E8 = 1000")
    return table(HEADS, rows(host.accesses, notes))


def group_session() -> str:
    """Return a session in which axes 5 and 6 move as a group and are stopped by STOP."""
    host = Session(SESSION_AXES, 100_000_000)
    for axis in (5, 6):
        host.send(axis, *RAMP)
        host.poll(axis)
    host.t += 20_000
    begin, notes = len(host.accesses), []

    def note(text: str) -> None:
        notes.append((text, len(host.accesses) - begin))

    host.write(0, MASK, 0x60)
    note("group: axes 5 and 6")
    host.send(5, 0x43, 0xE7, 0x03, 0x00)
    note("axis 5: 1000 pulses CW. BUSY = 1, no pulse yet")
    host.send(6, 0x4E)
    note("axis 6: continuous high speed CCW; also held")
    go = host.write(0, GO, 0)
    note("pulse 1 of both axes is at edge g + 4 + R + W")
    host.t += host.model.round + 5
    host.write(0, MASK, 0)
    note("R + 5 cycles later, not before: clear the group")
    host.t += 1_000_000
    stop = host.write(0, STOP, 0)
    note("10 ms later: all axes stop at the next edge")
    host.run(host.t + 1000)
    for axis in (5, 6):
        host.answer(axis, READ_FINISH)
    note("finish status: a stop ended both motions early")
    model = host.model
    assert {model.pulses(axis)[0] for axis in (5, 6)} == {go + 4 + model.round + model.timebase.w}
    assert max(max(model.pulses(axis)) for axis in (5, 6)) <= stop
    return table(HEADS, rows(host.accesses[begin:], notes))


# ----------------------------------------------------------------------------------------------- cost


def cost_table() -> str:
    """Return the table of size and clock rate for each number of axes."""
    return size_page.bank(figures.read())


def axis_cost() -> Figure:
    """Draw COMB per axis over the number of axes: bank, parts with similar axes, other designs."""
    found = figures.read()
    figure, axes = plt.subplots(figsize=(8.4, 4.6), layout="constrained")
    for name, color in (("plain", BLUE), ("tuned", RED)):
        known = [n for n in designs.BANKS if f"bank {n} ecp5 {name}" in found]
        values = [found[f"bank {n} ecp5 {name}"]["comb"] / n for n in known]
        axes.plot(known, values, "o-", color=color, label=f"ppmc_bank, {name}")
        if name == "plain":
            for n, value in zip(known, values, strict=True):
                axes.annotate(f"{value:.0f}", (n, value), (5, 5), textcoords="offset points", color=color)
    family, others = size_page.axis_costs(found)
    points = list(zip(*family.values(), strict=True)) or [(), ()]
    axes.plot(*points, "s-", color=GREEN, label="parts, plain")
    for title, (n, comb) in family.items():
        axes.annotate(f"{title}: {comb:.0f}", (n, comb), (6, 6), textcoords="offset points", color=GREEN)
    for title, comb in others.items():
        axes.axhline(comb, color=GREY, linewidth=0.8, linestyle=(0, (4, 3)))
        near = any(0 < other - comb < 0.1 * comb for other in others.values())
        # If two lines are close together, write the name of the lower one below it.
        side = "top" if near else "bottom"
        axes.text(73, comb, f"{title}: {comb}", va=side, ha="right", size=7.5, color="#444444")
    axes.set(xscale="log", yscale="log", xlabel="axes", ylabel="COMB of an axis, ECP5")
    ticks = (1, 2, *designs.BANKS)
    axes.set_xticks(ticks, [str(n) for n in ticks])
    axes.set_yticks([50, 100, 200, 500, 1000, 2000], ["50", "100", "200", "500", "1000", "2000"])
    axes.minorticks_off()
    axes.set(xlim=(0.9, 74), ylim=(45, 2900))
    axes.legend(loc="lower left")
    axes.set_title("Cost of an axis over the number of axes (dashed: one axis of other designs, plain)")
    return figure


# ------------------------------------------------------------------------------------------- diagrams


AXES, CLK_HZ = 8, 20_000_000
"""A round of all axes has 8 cycles. With vsel = L, intervals are not whole numbers of rounds."""
INIT = (0x0A, 99, 99, 4, 0)
ONE, OTHER = 2, 5
PINS = ("hold", "dir", "pout_n")
VISITS = {axis: VisitSchedule(axis, AXES, 0) for axis in (ONE, OTHER)}


def ready() -> Session:
    """Return a host that has initialised two axes with the same speed and vsel = L."""
    host = Session(AXES, CLK_HZ)
    for axis in (ONE, OTHER):
        host.write(axis, CONFIG, 0b01)
        host.send(axis, *INIT)
        host.t += 100
    return host


def sampled(host: Session, columns: Iterable[int | None], more: Callable[[int], Levels]) -> Samples:
    """Return the levels of both axes' pins, of the host's pins and of `more`, sampled at these edges."""
    model, outputs, inputs = host.model, {}, {}
    for axis in (ONE, OTHER):
        for name in PINS:
            outputs[f"{name}[{axis}]"] = (model.bits(name, axis), model.log.initial[name] >> axis & 1)
    for name in ("a", "wr_n", "d_i"):
        changes = [(t, value) for t, pin, value in model.stimulus if pin == name]
        inputs[name] = (changes, model.INPUTS[name])
    found: list[Mapping[str, int] | None] = []
    for edge in columns:
        if edge is None:
            found.append(None)
            continue
        levels = {name: level_at(*changes_of(pin, edge)) for name, pin in (outputs | inputs).items()}
        found.append({**levels, **more(edge)})
    return found


def changes_of(pin: tuple[list[tuple[int, int]], int], edge: int) -> tuple[list[tuple[int, int]], int, int]:
    """Return the arguments for level_at."""
    changes, initial = pin
    return changes, edge, initial


def words(columns: Sequence[int | None], names: Mapping[int, str]) -> list[str | None]:
    """Return the word below each column; "" for a column without a word, None for a gap."""
    return [None if edge is None else names.get(edge, "") for edge in columns]


def turn(edge: int) -> int:
    """Return the axis that the bank processes at an edge (BANK-GEN-01)."""
    return (edge - 8) % AXES


def visits() -> dict[str, Any]:
    """Return the diagram of two pulses of two axes. An axis schedules a pulse when it is processed."""
    host = ready()
    for axis in (ONE, OTHER):
        host.send(axis, 0x45, 9 + axis)
    host.run(host.t + 6000)
    pulses = {axis: host.model.pulses(axis) for axis in (ONE, OTHER)}
    first = next(t for t in pulses[ONE][1:] if (t - VISITS[ONE].last(t)) > 3)
    second = next(t for t in pulses[OTHER] if t > first and t - VISITS[OTHER].last(t) == 2)
    starts = {ONE: VISITS[ONE].last(first), OTHER: VISITS[OTHER].last(second)}
    begin, end = starts[ONE] - 2, first + 4
    again, stop = starts[OTHER] - 2, second + 4
    columns: list[int | None] = [*range(begin, end), None, *range(again, stop)]
    edges = {ONE: first, OTHER: second}

    def more(edge: int) -> Levels:
        waiting = {f"order{axis}": int(starts[axis] <= edge < edges[axis]) for axis in edges}
        return {"turn": turn(edge), **waiting}

    place = {edge: column for column, edge in enumerate(columns) if edge is not None}
    rows = [Row("visit of axis", "turn", str, nodes={place[starts[ONE]]: "A", place[starts[OTHER]]: "C"})]
    for axis, name in ((ONE, "B"), (OTHER, "D")):
        rows += [
            Row(f"order in cell {axis}", f"order{axis}"),
            Row(f"pout_n[{axis}]", f"pout_n[{axis}]", nodes={place[edges[axis]]: name}),
        ]
    samples = sampled(host, columns, more)
    late = {axis: edges[axis] - starts[axis] for axis in edges}
    return {
        "signal": [
            {"name": "clk", "wave": "p" + "".join("|" if edge is None else "." for edge in columns[1:])},
            *(wave(row, samples) for row in rows),
        ],
        "edge": [f"A~>B {late[ONE]} cycles", f"C~>D {late[OTHER]} cycles"],
        "head": {
            "text": "8 axes: a round of 8 cycles, and two pulses, each in the cycle ordered by its visit"
        },
        "config": {"hscale": 1},
    }


def group() -> dict[str, Any]:
    """Return the diagram of a group of two axes, which wait until the host writes GO."""
    host = ready()
    host.group(1 << ONE | 1 << OTHER)
    host.t += 20
    host.send(ONE, 0x45, 9)
    host.send(OTHER, 0x4D, 14)
    starts = {axis: host.model.bits("hold", axis)[0][0] for axis in (ONE, OTHER)}
    host.t += 100
    write = host.t + 1
    go = host.write(0, GO, 0)
    host.run(go + 6000)
    first = host.model.pulses(ONE)[0]
    assert first == host.model.pulses(OTHER)[0] == go + 4 + host.model.round + host.model.timebase.w
    low = host.model.timebase.w
    columns: list[int | None] = []
    for begin, end in (
        (starts[ONE] - 1, starts[ONE] + 2),
        (starts[OTHER] - 1, starts[OTHER] + 2),
        (write - 2, go + 3),
        (first - 2, first + 3),
        (first + low - 1, first + low + 2),
    ):
        columns += [*range(begin, end), None]
    columns.pop()
    lines = [
        Row("a", "a", lambda value: f"{value:03X}", host=True),
        Row("wr_n", "wr_n", host=True),
        *(Row(f"{pin}[{axis}]", f"{pin}[{axis}]") for axis in (ONE, OTHER) for pin in PINS),
    ]
    columns = thinned(columns, sampled(host, columns, lambda edge: {}), lines)
    place = {edge: column for column, edge in enumerate(columns) if edge is not None}
    names = {
        starts[ONE]: f"start {ONE}",
        starts[OTHER]: f"start {OTHER}",
        go: "g",
        first: "g+4+R+W",
        first + low: "+W",
    }
    samples = sampled(host, columns, lambda edge: {})
    nodes = {
        "wr_n": {place[write + 2]: "A"},
        f"pout_n[{ONE}]": {place[first]: "B"},
        f"pout_n[{OTHER}]": {place[first]: "C"},
    }
    rows = [replace(row, nodes=nodes.get(row.name, {})) for row in lines]
    return {
        "signal": [labels("edge", words(columns, names)), *(wave(row, samples) for row in rows)],
        "edge": ["A~>B", "B-C skew 0"],
        "head": {
            "text": "A group: two motions start and wait; a write to GO (0x00A) releases them at one edge"
        },
        "config": {"hscale": 1},
    }
