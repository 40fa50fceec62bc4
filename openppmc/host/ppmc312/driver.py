"""Driver of a PPMC-312 behind a UART bridge."""

from __future__ import annotations

from ..axis.part import Part
from ..bridge.link import Link
from ..bridge.script import Script
from . import blocks
from .axis import Axis
from .kind import KIND
from .motion import Motion
from .window import Window

RUN, EVENT_1, EVENT_2 = 0x01, 0x02, 0x04
"""Strap bits of the board: RUN, and the event inputs (0 = active)."""


class Ppmc312(Axis[Motion], Part):
    """One PPMC-312: part and axis in one object; see `part.Part`.

    Directions: 0 or CW, 1 or CCW. Speeds in pulses per second, those of motions within the table; pulses and
    positions signed, CW positive. Any method may raise LinkErrors; instructions raise what the part refuses
    (CommandRefused, `errors`). Motions: `axis`, settings and tables: `settings`, overrides and events:
    `overrides`, registers and outputs: `core`.
    """

    kind = KIND
    link: Link

    def __init__(self, link: Link) -> None:
        self._straps = 0xFF
        super().__init__(link)

    def _make_motion(self, asked: int | None, direction: int, begin: int | None) -> Motion:
        return Motion(self, asked, direction, begin)

    def _make_window(self) -> Window:
        return Window(self.link, self._arrived)

    @property
    def axes(self) -> tuple[Ppmc312, ...]:
        return (self,)

    def reset(self) -> None:
        """Reset of the part by its pin, in any state: pulses end at once, no table, position 0."""
        self.link.execute(Script().reset())
        self.forget()

    def allow_run(self, on: bool) -> None:
        """Level of the part's RUN input by the board's strap; a switch at the pin can still forbid."""
        self._strap(RUN, on)

    def pulse_event(self, event: int) -> None:
        """A pulse at event input 1 or 2 by the board's strap: 30 ms long, so DATASHEET timing sees it too."""
        bit = {1: EVENT_1, 2: EVENT_2}[blocks.buffer_number(event) + 1]
        self._strap(bit, False)
        self.link.pause(0.03)
        self._strap(bit, True)

    def _strap(self, bit: int, high: bool) -> None:
        self._straps = self._straps & ~bit | (bit if high else 0)
        self.link.execute(Script().straps(self._straps))
