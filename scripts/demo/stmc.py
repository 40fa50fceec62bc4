"""`make demo PART=stmc`: the demo's test, the text of bus accesses, waveforms and picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from openppmc.capture.stmc.mnemonics import StmcDecoder
from openppmc.check.records import steps
from openppmc.plot.motion import COLOURS, SPEED
from openppmc.plot.signals import Run, Section, Speed, Trace
from scripts.demo.demos import Demo, View, signals
from scripts.demo.scenes import Levels, bit, first, micros, pin, spans, subtitle

TITLES = {
    "move": "300 steps:\naccelerate, run, decelerate",
    "limit": "to the limit: decelerate\nat L3, stop at L1",
    "reference": "back to the\nreference point",
    "rest": "at rest",
}
SWITCHES = (("L3*", "l3_n"), ("L1*", "l1_n"), ("CNP*", "cnp_n"))


def traces(outputs: Levels, initial: Mapping[str, int], stimulus: Sequence[Any]) -> list[Trace]:
    """Return the rows of the picture: driver outputs, flags, and the switches that the demo presses."""
    rows = [
        Trace(f"DRV{n}", initial["drv"] >> (n - 1) & 1, bit(outputs["drv"], n - 1), COLOURS[f"S{n}"])
        for n in range(1, 5)
    ]
    rows += [Trace(name, initial[port], outputs[port]) for name, port in (("HOLD", "hold"), ("IRQ", "irq"))]
    return rows + [Trace(name, 1, pin(stimulus, port)) for name, port in SWITCHES]


def start(outputs: Levels, moves: Sequence[int], begin: int, clk_hz: int) -> Section:
    """Return the close-up of the first steps of the ramp."""
    us = clk_hz // 1_000_000
    fall = first(outputs["hold"], 0, begin)
    shown = [t for t in moves if t >= fall][:5]
    return Section(
        "start of the ramp",
        fall - 300 * us,
        shown[-1] + 200 * us,
        f"HOLD falls; step 0 with the first tick of 48.675 kHz {micros(shown[0] - fall, clk_hz)} later",
        spans=spans(shown, clk_hz),
    )


def stop(outputs: Levels, moves: Sequence[int], press: int, clk_hz: int) -> Section:
    """Return the close-up in which the stop limit acts in the deceleration ramp."""
    us = clk_hz // 1_000_000
    before = [t for t in moves if t < press][-4:]
    end = first(outputs["irq"], 1, press)
    return Section(
        "stop limit in the deceleration ramp",
        before[0] - 150 * us,
        press + 600 * us,
        f"no step after L1; IRQ {end - press} cycles later, until the finish status is read",
        marks=[(press, "L1 closes")],
        spans=spans(before, clk_hz),
    )


def reference(outputs: Levels, moves: Sequence[int], press: int, clk_hz: int) -> Section:
    """Return the close-up of the reference point and the chopping after it."""
    us = clk_hz // 1_000_000
    before = [t for t in moves if t < press][-3:]
    off = [t for t, level in outputs["drv"] if t > press][:3]
    return Section(
        "reference point, then chopped",
        before[0] - 150 * us,
        off[-1] + 400 * us,
        "the windings that hold the motor, switched "
        f"{micros(off[2] - off[1], clk_hz)} on, {micros(off[1] - off[0], clk_hz)} off",
        marks=[(press, "CNP closes")],
        spans=spans(before, clk_hz),
    )


def picture(comparison: Any, chapters: Sequence[Mapping[str, Any]]) -> Run:
    """Return the content of the picture for the compared recording."""
    recording, outputs = comparison.recording, comparison.actual
    clk_hz = int(recording.params["CLK_HZ"])
    moves = steps(outputs["drv"])
    by_key = {chapter["key"]: chapter for chapter in chapters}
    stimulus = recording.stimulus
    return Run(
        title="J105 STMC: the PC/104 board from the ISA bus to the driver",
        subtitle=subtitle(comparison, clk_hz),
        clk_hz=clk_hz,
        end=recording.end,
        traces=traces(outputs, comparison.initial, stimulus),
        speeds=[Speed("", SPEED, moves)],
        chapters=[Section(TITLES.get(c["key"], ""), c["begin"], c["end"]) for c in chapters],
        zooms=[
            start(outputs, moves, by_key["move"]["begin"], clk_hz),
            stop(outputs, moves, first(pin(stimulus, "l1_n"), 0, 0), clk_hz),
            reference(outputs, moves, first(pin(stimulus, "cnp_n"), 0, 0), clk_hz),
        ],
        unit="1000 steps/s",
    )


VIEW = View(
    split={"s": ("s1", "s2", "s3", "s4", "s5"), "drv": ("drv1", "drv2", "drv3", "drv4")},
    motors={"motor": "s"},
    groups=signals(
        ISA_bus="host.access sa aen iow_n ior_n sd_i sd_o sd_oe irq",
        motor="motor.speed_pps motor.pulses drv1 drv2 drv3 drv4 hold",
        switches="l1_n l2_n l3_n l4_n cnp_n mon",
    ),
    pulses=steps,
)

DEMO = Demo(
    name="stmc",
    part="j105_stmc",
    module="cocotb_tests.stmc.demo",
    test="demo_board",
    words=StmcDecoder("FAMILY"),
    picture=picture,
    view=VIEW,
    marks=("move", "limit", "reference", "rest"),
)
