"""Compares each RTL station edge by edge with a golden model that receives the same input levels."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import groupby, zip_longest

from cocotb_tests.harness import RtlBench
from cocotb_tests.harness.compare import compare_recording, write_report
from openppmc.check.comparison import Comparison
from openppmc.check.records import Change, Edge, Recording, by_signal
from openppmc.model.ppmc312.part import Ppmc312

from ..bench import PPMC312
from .models import heard, straps
from .setting import ALL, LINE, OUTPUTS, SINGLE, STATIONS


def line_recording(bench: RtlBench) -> Recording:
    """Return the complete recording of a bench of the line, which was not reset after its start."""
    recording = bench.recording()
    recording.part = LINE.name
    return recording


def driven(edges: Mapping[str, list[tuple[int, int]]]) -> Iterator[tuple[int, int]]:
    """Yield (edge, levels) that the drivers of the stations output to the line."""
    txd, snd = ALL, 0
    changes = [(t, name, value) for name in ("txd", "snd") for t, value in edges[name]]
    for t, group in groupby(sorted(changes), key=lambda change: change[0]):
        for _, name, value in group:
            txd, snd = (value, snd) if name == "txd" else (txd, value)
        yield t, txd | ALL & ~snd


def stimulus(recording: Recording, outputs: Mapping[str, list[tuple[int, int]]]) -> list[list[Change]]:
    """Return the pin changes of each station: those of its own pins, and those of its rxd, which master and
    stations drive.

    The other stations receive a level one edge after a station drives it.
    """
    levels, level = dict(LINE.inputs), ALL
    steps = [(t + 1, "", value) for t, value in driven(outputs)]
    steps += [(change.t, change.pin, change.value) for change in recording.stimulus]
    found: list[list[Change]] = [[] for _ in range(STATIONS)]
    rxd = [1] * STATIONS
    for t, group in groupby(sorted(steps, key=lambda step: step[0]), key=lambda step: step[0]):
        for _, pin, value in group:
            if not pin:
                level = value
                continue
            before, levels[pin] = levels[pin], value
            for number in range(STATIONS) if pin in SINGLE else ():
                if (before ^ value) >> number & 1:
                    found[number].append(Change(t, pin, value >> number & 1))
        for number in range(STATIONS):
            if (now := heard(levels, level, number)) != rxd[number]:
                rxd[number] = now
                found[number].append(Change(t, "rxd", now))
    return found


def station_edges(outputs: Mapping[str, list[tuple[int, int]]], number: int) -> list[Edge]:
    """Return the output edges of one station."""
    rows: list[Edge] = []
    for name, (width, first) in OUTPUTS.items():
        level = first
        for t, value in outputs[name]:
            now = value >> width * number & (1 << width) - 1
            if now != level:
                level = now
                rows.append(Edge(t, name, now))
    return sorted(rows, key=lambda edge: edge.t)


def compare_line(recording: Recording) -> list[Comparison]:
    """Compare all outputs of all stations with golden models that have the same addresses and speeds."""
    outputs = by_signal(recording.edges, {name: level for name, (_, level) in LINE.outputs.items()})
    first = {**LINE.inputs, **{c.pin: c.value for c in recording.stimulus if c.t == 0}}
    params = {name: v for name, v in recording.params.items() if name in PPMC312.parameters + ("SUM_MODE",)}
    comparisons = []
    for number, changes in enumerate(stimulus(recording, outputs)):
        edges = station_edges(outputs, number)
        accesses = [access for access in recording.accesses if access.reg == number]
        own = Recording("ppmc312", params, recording.seed, recording.end, changes, edges, accesses)
        model = Ppmc312(**{name.lower(): v for name, v in params.items()}, straps=straps(first, number))
        comparisons.append(compare_recording(own, model))
    return comparisons


def check_line(bench: RtlBench, at_least: int = 0) -> list[Comparison]:
    """Check that every station equals its model.

    Raises AssertionError with a report for the first station that differs.

    Args:
        at_least: minimum number of edges that all comparisons together must contain.
    """
    recording = line_recording(bench)
    comparisons = compare_line(recording)
    for number, comparison in enumerate(comparisons):
        if comparison.mismatch is not None:
            text = write_report(comparison, bench.out / f"station_{number}", bench.repro)
            raise AssertionError(f"station {number}: {text}")
    count = sum(comparison.edges_compared for comparison in comparisons)
    assert count >= at_least, f"only {count} edges to compare"
    check_wire(recording)
    return comparisons


def check_wire(recording: Recording) -> None:
    """Check that the line is low if and only if the master or an enabled driver pulls it low."""
    outputs = by_signal(recording.edges, {name: level for name, (_, level) in LINE.outputs.items()})
    steps = [(t, 0, int(level == ALL)) for t, level in driven(outputs)]
    steps += [(change.t, 1, change.value) for change in recording.stimulus if change.pin == "master"]
    levels, line, want = [1, 1], 1, []
    for t, group in groupby(sorted(steps), key=lambda step: step[0]):
        for _, which, level in group:
            levels[which] = level
        if min(levels) != line and t <= recording.end:
            line = min(levels)
            want.append((t, line))
    got = outputs["line"]
    differ = next((pair for pair in zip_longest(want, got) if pair[0] != pair[1]), None)
    assert differ is None, f"the line should do {differ[0]}, does {differ[1]}"
