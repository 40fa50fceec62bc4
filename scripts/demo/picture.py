"""The demo's picture: which traces, chapters and close-ups of the recording it shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from openppmc.plot.motion import Run, Section, Trace, draw

Levels = Mapping[str, list[tuple[int, int]]]

TITLES = {
    "reset": "",
    "init": "",
    "move": "1000 pulses:\naccelerate, run, decelerate",
    "pause": "rest",
    "limit": "continuous,\nlimit L1",
    "rest": "at rest: phases chopped, HOLD rises after 34 ms",
}


def bit(changes: Sequence[tuple[int, int]], index: int) -> list[tuple[int, int]]:
    """Changes of one bit of a vector."""
    found: list[tuple[int, int]] = []
    for t, value in changes:
        level = value >> index & 1
        if not found or found[-1][1] != level:
            found.append((t, level))
    return found


def traces(outputs: Levels, initial: Mapping[str, int], stimulus: Sequence[Any]) -> list[Trace]:
    """Phases, pulses and flags, and the limit switch that the demo presses."""
    rows = [Trace(f"S{n}", initial["s"] >> (n - 1) & 1, bit(outputs["s"], n - 1)) for n in range(1, 6)]
    rows += [
        Trace(name, initial[pin], outputs[pin])
        for name, pin in (("POUT*", "pout_n"), ("HOLD", "hold"), ("INT*", "int_n"))
    ]
    rows.append(Trace("L1*", 1, [(change.t, change.value) for change in stimulus if change.pin == "l1_n"]))
    return rows


def micros(clk: int, clk_hz: int) -> str:
    """A time in µs without needless digits."""
    return f"{clk * 1e6 / clk_hz:.6g} µs"


def zooms(
    outputs: Levels, stimulus: Sequence[Any], chapters: Mapping[str, Any], pulses: Sequence[int], clk_hz: int
) -> list[Section]:
    """Start of the ramp, limit stop, chopped rest."""
    us = clk_hz // 1_000_000
    begin = chapters["move"]["begin"]
    start = next(t for t, level in outputs["hold"] if level == 0 and t >= begin)
    first = [t for t in pulses if t >= start][:7]
    spans = [(a, b, micros(b - a, clk_hz)) for a, b in zip(first, first[1:], strict=False)]
    ramp = Section(
        "start of the ramp",
        start - 150 * us,
        first[-1] + 100 * us,
        f"HOLD falls, POUT follows {micros(first[0] - start, clk_hz)} later; one phase step a pulse",
        spans=spans,
    )
    press = next(change.t for change in stimulus if change.pin == "l1_n" and change.value == 0)
    done = next(t for t, level in outputs["int_n"] if level == 0 and t >= press)
    before = [t for t in pulses if press - 310 * us < t < press]
    limit = Section(
        "limit stop",
        press - 330 * us,
        press + 170 * us,
        f"no pulse after L1; INT {done - press} clk later, until the finish status is read",
        marks=[(press, "L1 closes")],
        spans=[(a, b, micros(b - a, clk_hz)) for a, b in zip(before, before[1:], strict=False)],
    )
    rest = chapters["rest"]["begin"] + 12_000 * us
    edges = [t for t, _ in outputs["s"] if t >= rest][:6]
    chop = Section(
        "chopped rest",
        edges[0] - 60 * us,
        edges[-1] + 40 * us,
        "the two phases that hold the motor, switched on and off",
        spans=[(a, b, micros(b - a, clk_hz)) for a, b in zip(edges[:4], edges[1:5], strict=False)],
    )
    return [ramp, limit, chop]


def draw_demo(comparison: Any, chapters: Sequence[Mapping[str, Any]], path: Path) -> None:
    """Draw build/demo/profile.png from a comparison's recording."""
    recording, outputs = comparison.recording, comparison.actual
    clk_hz = int(recording.params["CLK_HZ"])
    pulses = [t for t, level in outputs["pout_n"] if level == 0]
    by_key = {chapter["key"]: chapter for chapter in chapters}
    verdict = "no difference" if comparison.mismatch is None else "DIFFERENT, see compare.txt"
    run = Run(
        title="PPMC-104 from the host bus to the motor pins",
        subtitle=f"RTL in simulation at {clk_hz / 1e6:g} MHz. {comparison.edges_compared} edges of all "
        f"outputs compared with the golden model: {verdict}. Pins with * are active low.",
        clk_hz=clk_hz,
        end=recording.end,
        traces=traces(outputs, comparison.initial, recording.stimulus),
        pulses=pulses,
        chapters=[Section(TITLES[c["key"]], c["begin"], c["end"]) for c in chapters],
        zooms=zooms(outputs, recording.stimulus, by_key, pulses, clk_hz),
    )
    draw(run, path)
