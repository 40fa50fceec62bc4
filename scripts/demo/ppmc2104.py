"""`make demo PART=ppmc2104`: the demo's test, the text of bus accesses, waveforms and picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from openppmc.capture.ppmc2104.mnemonics import Ppmc2104Decoder
from openppmc.plot.motion import SPEED
from openppmc.plot.signals import Run, Section, Speed, Trace
from scripts.demo.demos import Demo, View, signals
from scripts.demo.scenes import Levels, bit, falls, first, micros, pin, spans, subtitle

TITLES = {
    "move": "a straight line, started by RUN:\naxis 1 1000 pulses CW, axis 2 500 pulses CCW",
    "limits": "each on its own: axis 1 into limit FL1,\naxis 2 slows down at FHL2",
}
COLOURS = {1: SPEED, 2: "#c8661a"}
SWITCHES = {1: ("FL1*", "fl_n"), 2: ("FHL2*", "fhl_n")}
PHASES = range(1, 5)
LINKED = "#1b7f79"


def axis_traces(
    axis: int, outputs: Levels, initial: Mapping[str, int], stimulus: Sequence[Any]
) -> list[Trace]:
    """Return the rows of one axis (phases, pulses, HOLD, its switch) with the names of the data sheet."""
    phases, colour = f"s{axis}_n", COLOURS[axis]
    rows = [
        Trace(f"S{n}{axis}*", initial[phases] >> (n - 1) & 1, bit(outputs[phases], n - 1), colour)
        for n in PHASES
    ]
    rows += [
        Trace(f"{name}{axis}{'*' * (port == 'pout_n')}", 1, bit(outputs[port], axis - 1), colour)
        for name, port in (("POUT", "pout_n"), ("HOLD", "hold"))
    ]
    name, port = SWITCHES[axis]
    return [*rows, Trace(name, 1, bit(pin(stimulus, port), axis - 1), colour)]


def start(pulses: Mapping[int, list[int]], run: int, clk_hz: int) -> Section:
    """Return the close-up of RUN, which starts both axes at the same time."""
    after = {axis: [t for t in found if t >= run][:6] for axis, found in pulses.items()}
    us = clk_hz // 1_000_000
    together = "on one edge" if after[1][0] == after[2][0] else "NOT on one edge"
    return Section(
        "RUN starts both",
        run - 150 * us,
        after[1][-1] + 100 * us,
        f"POUT1 and POUT2 fall {together}, {micros(after[1][0] - run, clk_hz)} after RUN",
        spans=spans(after[1], clk_hz),
    )


def ends(
    pulses: Mapping[int, list[int]], outputs: Levels, chapter: Mapping[str, Any], clk_hz: int
) -> Section:
    """Return the close-up of the end of two motions, which share one interrupt."""
    us = clk_hz // 1_000_000
    last = {axis: [t for t in found if t < chapter["end"]][-1] for axis, found in pulses.items()}
    calls = [t for t, _ in outputs["int_n"] if t >= last[1]][:4]
    high = micros(calls[2] - calls[1], clk_hz)
    return Section(
        "two ends, one INT*",
        last[1] - 60 * us,
        calls[3] + 60 * us,
        f"INT* is H for {high} after axis 1's end status was read, then L for axis 2",
        marks=[
            (last[1], "last pulse\nof axis 1"),
            (last[2], "last pulse\nof axis 2"),
            (calls[1], "80   "),
            (calls[3], "   A0"),
        ],
    )


def limit(pulses: Mapping[int, list[int]], outputs: Levels, press: int, clk_hz: int) -> Section:
    """Return the close-up in which axis 1 reaches its limit and axis 2 continues."""
    us = clk_hz // 1_000_000
    before = [t for t in pulses[1] if press - 310 * us < t < press]
    done = first(outputs["int_n"], 0, press)
    return Section(
        "limit of axis 1",
        press - 330 * us,
        press + 400 * us,
        f"no pulse of axis 1 after FL1; INT {done - press} cycles later; axis 2 continues",
        marks=[(press, "FL1 closes")],
        spans=spans(before, clk_hz),
    )


def picture(comparison: Any, chapters: Sequence[Mapping[str, Any]]) -> Run:
    """Return the content of the picture for the compared recording."""
    recording, outputs = comparison.recording, comparison.actual
    clk_hz = int(recording.params["CLK_HZ"])
    pulses = {axis: falls(bit(outputs["pout_n"], axis - 1)) for axis in COLOURS}
    by_key = {chapter["key"]: chapter for chapter in chapters}
    run = [(0, 1), *pin(recording.stimulus, "run")]
    press = first(bit(pin(recording.stimulus, "fl_n"), 0), 0, 0)
    return Run(
        title="PPMC-2104: two axes from the host bus to the motor pins",
        subtitle=subtitle(comparison, clk_hz),
        clk_hz=clk_hz,
        end=recording.end,
        traces=[
            Trace("RUN", 1, bit(run, 0), LINKED),
            *(
                row
                for axis in COLOURS
                for row in axis_traces(axis, outputs, comparison.initial, recording.stimulus)
            ),
            Trace("INT*", 1, outputs["int_n"]),
        ],
        speeds=[Speed(f"axis {axis}", COLOURS[axis], pulses[axis]) for axis in COLOURS],
        chapters=[Section(TITLES.get(c["key"], ""), c["begin"], c["end"]) for c in chapters],
        zooms=[
            start(pulses, first(bit(run, 0), 1, by_key["move"]["begin"]), clk_hz),
            ends(pulses, outputs, by_key["move"], clk_hz),
            limit(pulses, outputs, press, clk_hz),
        ],
        row_scale=0.8,
    )


_PER_AXIS = "pout_n dir hold run csel extck fl_n bl_n fhl_n bhl_n org_n alm_n".split()


def _name(port: str, axis: int) -> str:
    """Return the pin name with the axis number: pout_n becomes pout1_n, run becomes run1."""
    return f"{port.removesuffix('_n')}{axis}{'_n' if port.endswith('_n') else ''}"


def _axis_group(axis: int) -> str:
    phases = " ".join(f"s{n}{axis}_n" for n in range(1, 6))
    switches = " ".join(_name(port, axis) for port in "fl_n bl_n fhl_n bhl_n org_n alm_n".split())
    moves = f"axis{axis}.speed_pps axis{axis}.pulses run{axis} pout{axis}_n dir{axis}"
    return f"{moves} {phases} hold{axis} {switches}"


VIEW = View(
    split={
        **{port: (_name(port, 1), _name(port, 2)) for port in _PER_AXIS},
        **{f"s{axis}_n": [f"s{n}{axis}_n" for n in range(1, 6)] for axis in (1, 2)},
    },
    motors={"axis1": "pout1_n", "axis2": "pout2_n"},
    groups=signals(
        host="host.access cs_n a0 busc ds_wrs_n rw_rds_n d_i d_o d_oe int_n errint_n",
        axis_1=_axis_group(1),
        axis_2=_axis_group(2),
    ),
)

DEMO = Demo(
    name="ppmc2104",
    part="ppmc2104",
    module="cocotb_tests.ppmc2104.demo",
    test="demo_two_axes",
    words=Ppmc2104Decoder(),
    picture=picture,
    view=VIEW,
    marks=("wait", "move", "limits", "rest"),
    motors={"axis1": "axis 1", "axis2": "axis 2"},
)
