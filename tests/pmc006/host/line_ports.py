"""Ports for tests of PMC006B4: a modelled line that damages frames and replies, opened with a driver."""

from __future__ import annotations

from collections.abc import Callable

from openppmc.host import Pmc006, Pmc006Bus
from openppmc.host.pmc006.wire import reply
from openppmc.sim.pmc006.line import Node
from tests.common.host.line_ports import BREAK_FRAME, BREAK_REPLY, LOSE_FRAME, LOSE_REPLY, Spoiled

CUT_FRAME, CUT_REPLY, DOUBLE_REPLY = "cut frame", "cut reply", "double reply"
MERGED_REPLY, CHANGED_REPLY, LATE_REPLY = "merged reply", "changed reply", "late reply"
HARMLESS = (DOUBLE_REPLY, MERGED_REPLY)
"""Faults that require no repeat."""
UNHEARD = (LOSE_FRAME, BREAK_FRAME, CUT_FRAME)
"""Faults after which the controller has executed nothing."""
HEARD = (LOSE_REPLY, BREAK_REPLY, CUT_REPLY, CHANGED_REPLY, LATE_REPLY)
"""Faults after which the controller has executed the instruction."""
FATES = (*UNHEARD, *HEARD, *HARMLESS)


class SpoiledLine(Spoiled):
    """Modelled line of PMC006B4 that damages frames and replies."""

    def __init__(self, text: str, baud: int = 9600) -> None:
        super().__init__(f"speed=max,{text}", baud, "pmc006")
        self._held = self._early = self._late = b""

    def read(self, timeout: float) -> bytes:
        if self._early and timeout:
            early, self._early = self._early, b""
            return early
        return super().read(timeout)

    def forward(self, data: bytes) -> None:
        self._held = b""
        super().forward(data[:5] if self._fate == CUT_FRAME else data)
        self._early, self._late = self._late, b""

    def spoil(self, data: bytes) -> bytes:
        if self._fate not in (*HEARD[1:], *HARMLESS):
            return data
        self._held += data
        if len(self._held) < 8:
            return self.read(1.0)
        whole, fate, self._fate = self._held, self._fate, None
        if fate == LATE_REPLY:
            self._late = whole
            super().read(1.0)
            return b""
        if fate == CUT_REPLY:
            return whole[:6]
        if fate == DOUBLE_REPLY:
            return whole * 2
        if fate == MERGED_REPLY:
            return reply(77, 3) + whole
        place = 3 if fate == CHANGED_REPLY else 0
        return whole[:place] + bytes([whole[place] ^ 4]) + whole[place + 1 :]

    def node(self, number: int = 255) -> Node:
        """Return the model of a controller."""
        node: Node = self.line.station(number)
        return node


def once(letter: str, fate: str, times: int = 1, skip: int = 0) -> Callable[[bytes], str | None]:
    """Return a plan that skips `skip` frames with this instruction; the next `times` have the fault
    `fate`.
    """
    left, passed = times, skip

    def plan(frame: bytes) -> str | None:
        nonlocal left, passed
        if frame[2] != ord(letter) or not left:
            return None
        if passed:
            passed -= 1
            return None
        left -= 1
        return fate

    return plan


def one(text: str = "eeprom=none", address: int = 255) -> tuple[SpoiledLine, Pmc006]:
    """Return a port that damages frames, and the driver of one controller on it."""
    port = SpoiledLine(text)
    return port, Pmc006.open(port, address)


def several(text: str = "address=1..2") -> tuple[SpoiledLine, Pmc006Bus]:
    """Return a port that damages frames, and the driver of the bus on it."""
    port = SpoiledLine(text)
    return port, Pmc006Bus.open(port)
