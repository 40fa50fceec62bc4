"""`make demo PART=ppmc104`: the demo's test, the text of bus accesses, waveforms and picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from openppmc.capture.ppmc104.mnemonics import Ppmc104Decoder
from openppmc.plot.motion import SPEED
from openppmc.plot.signals import Run, Section, Speed, Trace
from scripts.demo.demos import Demo, View, signals
from scripts.demo.scenes import Levels, bit, micros, pin, spans, subtitle

TITLES = {
    "reset": "",
    "init": "",
    "move": "1000 pulses:\naccelerate, run, decelerate",
    "pause": "rest",
    "limit": "continuous,\nlimit L1",
    "rest": "at standstill: phases chopped, HOLD rises after 34 ms",
}


def traces(outputs: Levels, initial: Mapping[str, int], stimulus: Sequence[Any]) -> list[Trace]:
    """Return the rows of the picture: phases, pulses, flags, and the limit switch that the demo presses."""
    rows = [Trace(f"S{n}", initial["s"] >> (n - 1) & 1, bit(outputs["s"], n - 1)) for n in range(1, 6)]
    rows += [
        Trace(name, initial[pin], outputs[pin])
        for name, pin in (("POUT*", "pout_n"), ("HOLD", "hold"), ("INT*", "int_n"))
    ]
    rows.append(Trace("L1*", 1, pin(stimulus, "l1_n")))
    return rows


def zooms(
    outputs: Levels, stimulus: Sequence[Any], chapters: Mapping[str, Any], pulses: Sequence[int], clk_hz: int
) -> list[Section]:
    """Return the close-ups: start of the ramp, limit stop, chopped standstill."""
    us = clk_hz // 1_000_000
    begin = chapters["move"]["begin"]
    start = next(t for t, level in outputs["hold"] if level == 0 and t >= begin)
    first = [t for t in pulses if t >= start][:7]
    ramp = Section(
        "start of the ramp",
        start - 150 * us,
        first[-1] + 100 * us,
        f"HOLD falls, POUT follows {micros(first[0] - start, clk_hz)} later; one phase step a pulse",
        spans=spans(first, clk_hz),
    )
    press = next(t for t, level in pin(stimulus, "l1_n") if level == 0)
    done = next(t for t, level in outputs["int_n"] if level == 0 and t >= press)
    before = [t for t in pulses if press - 310 * us < t < press]
    limit = Section(
        "limit stop",
        press - 330 * us,
        press + 170 * us,
        f"no pulse after L1; INT {done - press} cycles later, until the finish status is read",
        marks=[(press, "L1 closes")],
        spans=spans(before, clk_hz),
    )
    rest = chapters["rest"]["begin"] + 12_000 * us
    edges = [t for t, _ in outputs["s"] if t >= rest][:6]
    chop = Section(
        "chopped rest",
        edges[0] - 60 * us,
        edges[-1] + 40 * us,
        "the two phases that hold the motor, switched on and off",
        spans=spans(edges[:5], clk_hz),
    )
    return [ramp, limit, chop]


def picture(comparison: Any, chapters: Sequence[Mapping[str, Any]]) -> Run:
    """Return the content of the picture for the compared recording."""
    recording, outputs = comparison.recording, comparison.actual
    clk_hz = int(recording.params["CLK_HZ"])
    pulses = [t for t, level in outputs["pout_n"] if level == 0]
    by_key = {chapter["key"]: chapter for chapter in chapters}
    return Run(
        title="PPMC-104 from the host bus to the motor pins",
        subtitle=subtitle(comparison, clk_hz),
        clk_hz=clk_hz,
        end=recording.end,
        traces=traces(outputs, comparison.initial, recording.stimulus),
        speeds=[Speed("", SPEED, pulses)],
        chapters=[Section(TITLES[c["key"]], c["begin"], c["end"]) for c in chapters],
        zooms=zooms(outputs, recording.stimulus, by_key, pulses, clk_hz),
    )


VIEW = View(
    split={"s": ("s1", "s2", "s3", "s4", "s5")},
    motors={"motor": "pout_n"},
    groups=signals(
        host="host.access cs_n a0 wr_n rd_n d_i d_o d_oe int_n",
        motor="motor.speed_pps motor.pulses pout_n dir s1 s2 s3 s4 s5 hold",
        switches="l1_n l2_n l3_n l4_n cnp_n alm_n",
    ),
)

DEMO = Demo(
    name="ppmc104",
    part="ppmc104",
    module="cocotb_tests.ppmc104.demo",
    test="demo_move",
    words=Ppmc104Decoder(),
    picture=picture,
    view=VIEW,
    marks=("move", "limit", "rest"),
)
