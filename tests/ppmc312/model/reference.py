"""Tables of the PPMC-312 specification, and functions for its notation of pulse lists."""

from __future__ import annotations

from itertools import groupby

from openppmc.model.ppmc312.stages import Step, build, curve

T1 = build(1000, 0, 200, 2000, 0, separate=False)
T2 = build(1000, 0, 200, 2000, 0, sigmoid=True, separate=False)
T3 = build(1000, 500, 200, 2000, 1500)
T4 = build(500, 1000, 200, 1500, 2000)
T5 = build(8192, 0, 64, 60_000, 0, sigmoid=True, separate=False)
TF = curve([100, 200, 400], [5, 4, 3])
TG = curve([100, 200, 400], [5, 4, 3], [6, 4])
TH = curve([100, 200, 400], [6, 4], [5, 4, 3])


def runs(steps: list[Step]) -> str:
    """Return pulses in the notation "rate x pulses": `400x3 200x4`."""
    groups = ((rate, len(list(group))) for rate, group in groupby(step.rate for step in steps))
    return " ".join(f"{rate}x{count}" for rate, count in groups)


def ticks(steps: list[Step]) -> int:
    """Return the ticks from pulse 1 to the end of the last interval."""
    return sum(step.rate for step in steps)
