"""The motor's surroundings: limit, slow-down, origin and alarm switches along the way of one axis."""

from __future__ import annotations

from dataclasses import dataclass

FARTHEST = 1 << 31
SWITCHES = ("limit_cw", "limit_ccw", "slow_cw", "slow_ccw", "origin", "alarm")
"""In the order of the bridge's PINS byte."""
INDEX_AT = -20
"""One of the places where an encoder has its index: on the cam, off its edge."""


@dataclass(frozen=True)
class Plant:
    """Where the switches of an axis are, in pulses, CW positive; positions are -2^31 .. 2^31-1.

    cw, ccw: hard limits (active at positions >= cw and <= ccw). slow_cw, slow_ccw: slow-down limits (>= and
    <=). origin: active at positions <= origin and, with a cam, >= origin_from. alarm: active from the first
    to the last of the two positions. index: the encoder's index is active once in so many pulses, at -20;
    0: never. block: what the axle cannot pass CW, so that the encoder stands while pulses go on; None:
    nothing.
    """

    start: int = 4000
    cw: int = 40000
    ccw: int = -400
    slow_cw: int = 38000
    slow_ccw: int = 600
    origin: int = 0
    alarm: tuple[int, int] | None = None
    origin_from: int = -FARTHEST
    index: int = 0
    block: int | None = None

    def steps(self, position: int, ccw: int) -> bool:
        """Whether the axle follows a pulse."""
        return bool(ccw) or self.block is None or position < self.block

    def index_level(self, position: int) -> int:
        """Level of the encoder's index, 0 = active."""
        return int(not self.index or (position - INDEX_AT) % self.index != 0)

    def levels(self, position: int) -> dict[str, int]:
        """Levels of the switches at a position, 0 = active."""
        alarm = self.alarm is not None and self.alarm[0] <= position <= self.alarm[1]
        return {
            "limit_cw": int(position < self.cw),
            "limit_ccw": int(position > self.ccw),
            "slow_cw": int(position < self.slow_cw),
            "slow_ccw": int(position > self.slow_ccw),
            "origin": int(not self.origin_from <= position <= self.origin),
            "alarm": int(not alarm),
        }
