"""Timing diagrams of docs/bank/README.md, from the pins of the golden model."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from openppmc.check.records import level_at
from openppmc.model.bank.chopper import VisitSchedule
from openppmc.model.bank.window import CONFIG, GO
from scripts.demo.bank.session import Session
from scripts.pages.pictures.recorded import Levels, Row, Samples, labels, thinned, wave

AXES, CLK_HZ = 8, 20_000_000
"""A round has 8 cycles; with vsel = L, intervals are not a whole number of rounds."""
INIT = (0x0A, 99, 99, 4, 0)
ONE, OTHER = 2, 5
PINS = ("hold", "dir", "pout_n")
VISITS = {axis: VisitSchedule(axis, AXES, 0) for axis in (ONE, OTHER)}


def ready() -> Session:
    """Return a host with two axes initialised at one speed, vsel = L."""
    host = Session(AXES, CLK_HZ)
    for axis in (ONE, OTHER):
        host.write(axis, CONFIG, 0b01)
        host.send(axis, *INIT)
        host.t += 100
    return host


def sampled(host: Session, columns: Iterable[int | None], more: Callable[[int], Levels]) -> Samples:
    """Return the pins of both axes, the host's pins and `more` at these edges."""
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
    """Return the arguments of level_at."""
    changes, initial = pin
    return changes, edge, initial


def words(columns: Sequence[int | None], names: Mapping[int, str]) -> list[str | None]:
    """Return the words below the columns, "" for a column without a word."""
    return [None if edge is None else names.get(edge, "") for edge in columns]


def turn(edge: int) -> int:
    """Return the axis that is visited at an edge (BANK-GEN-01)."""
    return (edge - 8) % AXES


def visits() -> dict[str, Any]:
    """Return the diagram of two pulses of two axes, each ordered at a visit for its cycle."""
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
    """Return the diagram of a group of two axes: held, then GO."""
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


DIAGRAMS: dict[str, Callable[[], dict[str, Any]]] = {"visits": visits, "group": group}
