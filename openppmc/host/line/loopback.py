"""The port `model:` of a line: golden models of the stations with their motors, in virtual time."""

from __future__ import annotations

from ...sim.common.lines import line_kind
from ..basis.errors import Disconnected, PortError
from ..ports.pacer import Pacer, whole


class ModelLine:
    """A line that needs no hardware. text: words of the part's virtual line. baud: line rate. part:
    of the stations. Raises PortError for a bad text."""

    def __init__(self, text: str, baud: int, part: str) -> None:
        self.name = "model:" + text
        kind = line_kind(part)
        try:
            self.spec = kind.parse(kind.at_rate(text, baud))
            self.line = kind.make(self.spec)
        except ValueError as error:
            raise PortError(f"{self.name}: {error}") from error
        self.set_baud(baud)
        self._closed = False
        self._pacer = Pacer(self.spec.speed)

    def read(self, timeout: float) -> bytes:
        self._check()
        self._catch_up()
        end = self.line.seconds + timeout
        data = self.line.read()
        while not data and (left := end - self.line.seconds) > 0:
            self._run(self._pacer.step(left))
            self._pacer.wait(self.line.seconds)
            self._check()
            data = self.line.read()
        return data

    def write(self, data: bytes) -> None:
        self._check()
        self._catch_up()
        whole(lambda: self.line.write(data if self._fits else bytes(len(data))))

    def set_baud(self, baud: int) -> None:
        self._fits = abs(baud / self.spec.rate - 1) < 0.03

    def clock(self) -> float:
        return self.line.seconds

    def close(self) -> None:
        self._closed = True

    def _check(self) -> None:
        if self._closed or self.line.seconds >= self.spec.unplug:
            raise Disconnected(f"{self.name}: the port went away: plug it in and run the command again")

    def _catch_up(self) -> None:
        """The line went on while the program did something else."""
        if behind := self._pacer.behind(self.line.seconds):
            self._run(behind)

    def _run(self, seconds: float) -> None:
        whole(lambda: self.line.run_seconds(seconds))
