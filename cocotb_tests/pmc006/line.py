"""Several PMC006 on one pair of wires: rxd of all is the AND of the host's level and of every txd."""

from __future__ import annotations

from typing import Any

from .script_host import Host


class Line:
    """Common time of the nodes, and what is on the wires. What a part drives at edge t is there at t + 1."""

    def __init__(self) -> None:
        self.t = 0
        self.models: list[Any] = []
        self._runs: list[Any] = []
        self._host = self._level = 1
        self._look: int | None = None

    def join(self, model: Any) -> None:
        """Another part, before any time has passed."""
        self._runs.append(model.run_until)
        self.models.append(model)
        model.run_until = self.run_until

    @property
    def now(self) -> int:
        """The last edge that was run."""
        return min(int(model.now) for model in self.models)

    @property
    def next_event(self) -> int | None:
        """The next event of any part."""
        events = [model.next_event for model in self.models if model.next_event is not None]
        return min(events, default=None)

    def drive(self, t: int, level: int) -> None:
        """The host's level from edge t on."""
        t = max(t, self.now + 1)
        self.run_until(t - 1)
        self._host = level
        self._settle(t)

    def run_until(self, t: int) -> None:
        """All parts up to edge t."""
        while True:
            events = [at for at in (self.next_event, self._look) if at is not None]
            edge = min(events, default=t + 1)
            if edge > t:
                break
            if edge == self._look:
                self._look = None
                self._settle(edge)
            before = [model.outputs["txd"] for model in self.models]
            for run in self._runs:
                run(edge)
            if before != [model.outputs["txd"] for model in self.models]:
                self._look = edge + 1
        for model, run in zip(self.models, self._runs, strict=True):
            if t > model.now:
                run(t)

    def _settle(self, t: int) -> None:
        level = int(self._host and all(model.outputs["txd"] for model in self.models))
        if level != self._level:
            self._level = level
            for model in self.models:
                model.pins(t, rxd=level)


class Node(Host):
    """The host, talking to one of the parts on the line."""

    def __init__(self, line: Line, **given: Any) -> None:
        self.line = line
        super().__init__(boot=False, **given)
        line.join(self.model)

    @property
    def t(self) -> int:  # type: ignore[override]
        """The next free edge, of all nodes."""
        return self.line.t

    @t.setter
    def t(self, t: int) -> None:
        self.line.t = t

    def _drive(self, t: int, level: int) -> None:
        self.line.drive(t, level)

    def step(self) -> None:
        """Run to the next event of any part."""
        edge = self.line.next_event
        assert edge is not None
        self.go(max(self.t, edge + 1))

    def ask_other(self, other: Node, code: str, data: int = 0) -> int:
        """The same for another node on the line."""
        other.middle, other._free = self.middle, self._free
        return other.ask(code, data)
