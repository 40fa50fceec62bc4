"""The program of a virtual line: modelled stations behind one pseudo-terminal, in a process of its own.

It prints `port PATH`, answers `status` and `inputs NUMBER LEVELS` on its standard input and ends with that.
"""

from __future__ import annotations

import os
import select
import sys
import termios
import time
import tty

from .lines import line_kind, line_parts, part_of

STEP = 0.005
"""Seconds of line time between two looks at the host."""
_IDLE, _LAG, _PACE_OVER = 0.05, 0.25, 0.5
_RATES = {
    getattr(termios, f"B{rate}"): rate
    for rate in (1200, 2400, 4800, 9600, 19_200, 38_400, 57_600, 115_200, 230_400)
    if hasattr(termios, f"B{rate}")
}


class LineServer:
    """Runs a line between host and clock. text: its words. ValueError for a bad one."""

    def __init__(self, text: str) -> None:
        kind = line_kind(part_of(text) or line_parts()[0])
        self.spec = kind.parse(text)
        self.line = kind.make(self.spec)
        self.master, self._slave = os.openpty()
        tty.setraw(self._slave)
        self.port = os.ttyname(self._slave)
        os.set_blocking(self.master, False)
        self._origin = time.monotonic()
        self._marks = [(self._origin, 0.0)]
        self._lost = 0

    def run(self) -> None:
        """Until standard input ends or the port is unplugged."""
        while self.line.seconds < self.spec.unplug:
            readable, _, _ = select.select([self.master, sys.stdin], [], [], self._rest())
            if sys.stdin in readable and not self._obey(sys.stdin.readline()):
                return
            if self.master in readable:
                self._from_host()
            self._to_host()
            self._advance()
            self._to_host()
            self.line.settle()

    def _obey(self, word: str) -> bool:
        """A line of standard input; False at its end."""
        words = word.split()
        if words[:1] == ["inputs"]:
            for station in self.line.stations:
                if str(station.number) == words[1]:
                    station.set_inputs(words[2])
        if words:
            print("status", self.status(), flush=True)
        return bool(word)

    # ------------------------------------------------------------------ host

    def _from_host(self) -> None:
        try:
            data = os.read(self.master, 4096)
        except (BlockingIOError, OSError):
            return
        self.line.write(data if self._fits() else b"\0" * len(data))

    def _fits(self) -> bool:
        """Whether the host sends at the speed of the line; odd speeds cannot be seen from here."""
        rate = _RATES.get(termios.tcgetattr(self._slave)[5])
        return rate is None or abs(rate / self.spec.rate - 1) < 0.03

    def _to_host(self) -> None:
        data = self.line.read()
        if not data:
            return
        try:
            os.write(self.master, data if self._fits() else b"\xff" * len(data))
        except BlockingIOError:
            self._lost += len(data)

    # ------------------------------------------------------------------ time

    @property
    def _active(self) -> bool:
        return any(station.moving for station in self.line.stations)

    def _rest(self) -> float:
        """Wall seconds until there is something to do."""
        if self.spec.speed is None:
            return 0.0 if self._active else _IDLE
        ahead = self.line.seconds / self.spec.speed - (time.monotonic() - self._origin)
        return max(0.0, min(ahead, _IDLE)) if self._active else _IDLE

    def _advance(self) -> None:
        """One step of line time, or all the time that has passed while nothing moved. What the host wants
        goes first: of that only one station is concerned."""
        if self.spec.speed is None:
            self.line.run_seconds(STEP if self._active else 4 * STEP)
            return
        behind = (time.monotonic() - self._origin) * self.spec.speed - self.line.seconds
        if behind > 0:
            self.line.run_seconds(min(behind, STEP) if self._active else behind)
        if behind > _LAG * self.spec.speed:
            self._origin += (behind - _LAG * self.spec.speed) / self.spec.speed

    # ------------------------------------------------------------------ what there is to see

    def status(self) -> str:
        """Time, pace and stations in words."""
        now = time.monotonic()
        self._marks = [mark for mark in self._marks if mark[0] > now - _PACE_OVER] or self._marks[-1:]
        began, then = self._marks[0]
        factor = (self.line.seconds - then) / max(now - began, 1e-3)
        self._marks.append((now, self.line.seconds))
        stations = ",".join(one.words() for one in self.line.stations)
        return f"seconds={self.line.seconds:.3f} factor={factor:.3f} lost={self._lost} stations={stations}"


def main(arguments: list[str]) -> int:
    """Serve until the end of standard input."""
    try:
        server = LineServer(",".join(arguments))
    except (OSError, ValueError) as error:
        print(f"error {error}", flush=True)
        return 1
    print("port", server.port, flush=True)
    try:
        server.run()
    except KeyboardInterrupt:
        pass
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
