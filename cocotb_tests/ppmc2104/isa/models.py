"""Comparison of each PPMC-2104 of the ISA module with a separate golden model, edge by edge."""

from __future__ import annotations

from itertools import groupby

from cocotb_tests.harness import RtlBench
from cocotb_tests.harness.compare import compare_recording, write_report
from openppmc.check.comparison import Comparison
from openppmc.check.records import Change, Edge, Recording

from ..bench import PPMC2104
from .setting import AXIS_INPUTS, AXIS_OUTPUTS, BASE, ISA_4AXIS, PARTS, SOURCE


def part_pins(pins: dict[str, int], number: int) -> dict[str, int]:
    """Return the levels of the input pins of part 0 or 1, derived from the pins of the module and its wiring
    rules.
    """
    mine = not pins["aen"] and pins["sa"] >> 1 == (BASE >> 1) + number
    return {
        "rst_n": int(pins["rst_n"] and not pins["reset_drv"]),
        "cs_n": int(not mine),
        "a0": pins["sa"] & 1,
        "ds_wrs_n": pins["iow_n"],
        "rw_rds_n": pins["ior_n"],
        "d_i": pins["sd_i"],
        "errint_n": pins["errint_n"],
        **{name: pins[name] >> 2 * number & 3 for name in (*AXIS_INPUTS, "auxi")},
    }


def part_stimulus(bench: RtlBench, number: int) -> list[Change]:
    """Return the pin changes of a part, with the edges of `clk` that sample them first."""
    pins = {**ISA_4AXIS.inputs, "rst_n": 1}
    seen: dict[str, int] = {"rst_n": 1, **PPMC2104.inputs}
    changes = []
    for t, group in groupby(bench.stimulus, key=lambda change: change.t):
        pins.update({change.pin: change.value for change in group})
        now = part_pins(pins, number)
        changes += [Change(t, pin, level) for pin, level in now.items() if seen[pin] != level]
        seen.update(now)
    return changes


def part_edges(bench: RtlBench, number: int) -> list[Edge]:
    """Return the output edges of a part."""
    rows: list[Edge] = []

    def add(output: str, name: str, shift: int, mask: int) -> None:
        rows.extend(Edge(t, name, value >> shift & mask) for t, value in bench.edges(output))

    for name in (*AXIS_OUTPUTS, "auxo"):
        add(name, name, 2 * number, 3)
    for axis in (1, 2):
        add(f"s{2 * number + axis}_n", f"s{axis}_n", 0, 31)
    add("d", "d_o", 8 * number, 255)
    add("d_oe", "d_oe", number, 1)
    add("int_n", "int_n", number, 1)
    return sorted(rows, key=lambda edge: edge.t)


def compare_part(bench: RtlBench, number: int) -> Comparison:
    """Compare all outputs of part 0 or 1."""
    recording = Recording(
        part="ppmc2104",
        params=PPMC2104.params(bench.config),
        seed=bench.seed,
        end=bench.now - 1,
        stimulus=part_stimulus(bench, number),
        edges=part_edges(bench, number),
        accesses=list(bench.accesses),
    )
    return compare_recording(recording)


def check_both(bench: RtlBench, at_least: int = 0) -> None:
    """Check that both parts equal their models and that irq follows int_n.

    Raises AssertionError if there is a difference; a report is then written.

    Args:
        at_least: minimum number of edges of each part to compare.
    """
    for number in range(PARTS):
        comparison = compare_part(bench, number)
        if comparison.mismatch is not None:
            text = write_report(comparison, bench.out / f"part_{'ab'[number]}", bench.repro)
            raise AssertionError(f"part {'AB'[number]}: {text}")
        count = comparison.edges_compared
        assert count >= at_least, f"part {'AB'[number]}: only {count} edges to compare"
    check_irq(bench)


def arming_writes(bench: RtlBench) -> list[tuple[int, int]]:
    """Return (edge, level) of the strobe of all writes to the source register, regardless of the byte
    (ISA-11).

    The level is 1 from the first edge that samples a write to the first edge that no longer samples it.
    """
    pins, found = {**ISA_4AXIS.inputs}, [(0, 0)]
    for t, group in groupby(bench.stimulus, key=lambda change: change.t):
        pins.update({change.pin: change.value for change in group})
        writes = int(pins["sa"] == SOURCE and not pins["aen"] and not pins["iow_n"] and bool(pins["ior_n"]))
        if writes != found[-1][1]:
            found.append((t, writes))
    return found[1:]


def check_irq(bench: RtlBench) -> None:
    """Check that irq is the registered OR of both interrupts, and low during a write to the source register
    (ISA-06, ISA-11).
    """
    # A change of int_n counts from the edge after its stamp on, a change of the pins from its stamp on.
    calls = [(t + 1, "call", int(value != 0b11)) for t, value in bench.edges("int_n")]
    events = sorted(calls + [(t, "write", level) for t, level in arming_writes(bench)])
    now, level, expected = {"call": 0, "write": 0}, 0, []
    for t, group in groupby(events, key=lambda event: event[0]):
        now.update({name: value for _, name, value in group})
        if (new := now["call"] & ~now["write"] & 1) != level:
            level = new
            expected.append((t, level))
    end = bench.now - 1
    got = [edge for edge in bench.edges("irq") if edge[0] <= end]
    bench.check("ISA-06", "edges of irq", got, [edge for edge in expected if edge[0] <= end])
