"""The bytes of a PPMC-104 host in words."""

from __future__ import annotations

from collections.abc import Sequence

from scripts.demo.words import OneAxisWords

ERRORS = (
    "undefined command, or a stop at rest",
    "not allowed while BUSY",
    "not initialised",
    "data byte nobody asked for",
    "PA above 11220",
    "RH above RL, or PA below 4",
    "data byte nobody asked for while BUSY",
    "already decelerating",
)


class Words104(OneAxisWords):
    """One axis, error numbers in the status register."""

    errors = ERRORS
    reads = {
        0x80: ("read finish status", 1),
        0x81: ("read input signals", 1),
        0x82: ("read output signals", 1),
        0x83: ("read remaining pulses", 3),
        0x85: ("read auxiliary inputs", 1),
    }
    switches = ((0x80, "CNP"), (0x40, "ALM"), (8, "L1"), (4, "L2"), (2, "L3"), (1, "L4"))

    def setting(self, code: int, data: Sequence[int]) -> str:
        """Motor, step, level, clock, chopping, ramp."""
        step, level = "half" if code & 4 else "full", "high" if code & 8 else "low"
        phases = f"{(code & 3) + 2} phases, {step} step, {level} = on"
        clock = "CLOCK pin" if code & 0x10 else "internal clock"
        chop = "chopped at rest" if code & 0x20 else "full current at rest"
        return f"initialise: {phases}, {clock}, {chop}{self.ramp(data)}"
