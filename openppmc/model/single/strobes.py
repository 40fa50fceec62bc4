"""What is special in the host port of the PPMC-104: its strobes, and the over-speed rule."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from .codes import Kind, decode


def strobes(pins: Mapping[str, int]) -> tuple[bool, bool]:
    """Write strobe and read strobe; both low at once is neither (P104-BUS-02)."""
    selected = not pins["cs_n"]
    writing = selected and not pins["wr_n"] and bool(pins["rd_n"])
    reading = selected and not pins["rd_n"] and bool(pins["wr_n"])
    return writing, reading


class SpeedGate:
    """DATASHEET: above a speed only stop commands are taken (P104-DS-12).

    retry(t): lets the host port look again at a waiting byte.
    """

    def __init__(self, retry: Callable[[int], None]) -> None:
        self._retry = retry
        self._fast = (False, False, 0)

    def set(self, t: int, fast: bool) -> None:
        """From edge t on only stop commands are taken, or everything again."""
        self._fast = (self._is_fast(t), fast, t)
        if not fast:
            self._retry(t)

    def _is_fast(self, t: int) -> bool:
        before, after, since = self._fast
        return after if t >= since else before

    def waits(self, t: int, byte: int, command: bool) -> bool:
        """Whether this byte must stay in the buffer at edge t."""
        stop = command and decode(byte).kind in (Kind.STOP, Kind.SLOW_STOP)
        return self._is_fast(t) and not stop
