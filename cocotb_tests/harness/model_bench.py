"""`ModelBench`: the golden model in place of the RTL, for the same `async def` tests without a simulator.

No call suspends: `until` and `edge` run the model up to the requested edge. Therefore `on_model` can run a
complete coroutine with one `send(None)`. Scheduled pin changes wait in a queue sorted by time.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Coroutine, Generator, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count
from typing import Any, TypeVar

from openppmc.check.records import Change

from .config import F16, Config
from .dut_bench import TIMEOUT, DutBench, PinChange, new_model
from .part import Part

T = TypeVar("T")
F = TypeVar("F")


@dataclass(frozen=True)
class OnModel:
    """Argument that a test receives in place of the simulator's `dut`; it selects the golden model.

    `config` is the build of the model.
    """

    config: Config = F16
    seed: int = 1


class _Later:
    """Future pin changes, in order of time; `step` advances to the next change of any pin."""

    def __init__(self, changes: Iterator[PinChange], step: Callable[[], None]) -> None:
        self.changes = changes
        self.over = False
        self._step = step

    def cancel(self) -> None:
        """Stop changing the pins."""
        self.over = True

    def __await__(self) -> Generator[Any, Any, None]:
        """Advance the time to the last change; no call suspends."""
        while not self.over:
            self._step()
        yield from ()


class ModelBench(DutBench):
    """Bench with a golden model `settle` cycles (0 or more) after its reset.

    `pins` are as for `RtlBench.start`. Time begins with edge 0: the first reset itself is not visible.
    `model` replaces the golden model of the part.
    """

    simulated = False

    def __init__(self, part: Part, on: OnModel, settle: int = 4, model: Any = None, **pins: int) -> None:
        super().__init__(part, on.config, on.seed)
        part = self.part
        params = part.params(on.config)
        self.model: Any = model or new_model(part.name, params)
        self.pins = {**part.inputs, "rst_n": 1}
        levels = part.reset_levels(params)
        self.initial = {name: levels[name] for name in part.watched}
        self._edges: dict[str, list[tuple[int, int]]] = {name: [] for name in part.watched}
        self._taken = 0
        self._due: list[tuple[int, int, Mapping[str, int], _Later]] = []
        self._order = count()
        self._now = 0
        self.set(**pins)
        self._go(settle)

    # ---------------------------------------------------------------- time

    @property
    def golden(self) -> Any:
        """See `DutBench.golden`; the golden model is the model of this bench."""
        return self.model

    @property
    def now(self) -> int:
        """Index of the next rising edge of `clk`; the model has run up to the edge before it."""
        return self._now

    async def until(self, edge: int) -> int:
        """See `DutBench.until`. It never suspends."""
        if edge < self._now:
            raise ValueError(f"until({edge}): it is already edge {self._now}")
        self._go(edge)
        return edge

    async def align(self) -> int:
        """Return `now`; time is always at the falling edge before edge `now`."""
        return self._now

    def _go(self, edge: int) -> None:
        """Advance the time to an edge and make all pin changes scheduled up to that edge."""
        while self._due and self._due[0][0] <= edge:
            self._now, _, levels, later = heapq.heappop(self._due)
            if not later.over:
                self.set(**levels)
                self._schedule(later)
        self._now = edge
        if self.model.now < edge - 1:
            self.model.run_until(edge - 1)

    # ---------------------------------------------------------------- pins

    def set(self, **levels: int) -> int:
        """See `DutBench.set`. It may be called at any moment."""
        for pin, level in levels.items():
            if self.pin(pin) == level:
                continue
            port, value = self._levelled(pin, level)
            self.pins[port] = value
            self.model.pins(self._now, **{port: value})
            self.stimulus.append(Change(self._now, port, value))
        return self._now

    async def set_between(self, share: float = 0.5, /, **levels: int) -> int:
        """See `DutBench.set_between`. The model has no time between two edges."""
        return self.set(**levels)

    def drive(self, changes: Iterable[PinChange]) -> _Later:
        """See `DutBench.drive`."""
        later = _Later(iter(changes), lambda: self._go(self._due[0][0]))
        self._later.append(later)
        self._schedule(later)
        return later

    def _schedule(self, later: _Later) -> None:
        for edge, levels in later.changes:
            heapq.heappush(self._due, (edge, next(self._order), levels, later))
            return
        later.over = True

    # ---------------------------------------------------------------- outputs

    @property
    def outputs(self) -> tuple[str, ...]:
        """See `DutBench.outputs`."""
        return tuple(self.model.outputs)

    def _port_level(self, port: str) -> int:
        level: int = self.model.outputs[port]
        return level

    def _output_changes(self) -> dict[str, list[tuple[int, int]]]:
        """See `DutBench`. The effect of an asynchronous reset at `now` is added at the next edge."""
        edges = self.model.edges
        while self._taken < len(edges) and edges[self._taken].t < self._now:
            t, signal, value = edges[self._taken]
            self._edges[signal].append((t, value))
            self._taken += 1
        return self._edges

    async def edge(self, output: str, level: int | None = None, timeout: int = TIMEOUT) -> int:
        """See `DutBench.edge`."""
        end, before = self._now + timeout, self.level(output)
        edges: Sequence[Any] = self.model.edges
        last = edges[-1] if edges else None
        while self._now < end:
            event = self.model.next_event
            stop = end if event is None else min(end, event + 1)
            self._go(min(stop, self._due[0][0]) if self._due else stop)
            if not edges or edges[-1] is last:
                continue
            last = edges[-1]
            was, before = before, self.level(output)
            if before != was and level in (None, before):
                return self._now - 1
        want = "a change" if level is None else f"level {level}"
        raise TimeoutError(f"no {want} of {output} within {timeout} cycles\n{self.context()}")


def on_model(test: Coroutine[Any, Any, T]) -> T:
    """Run a coroutine that works on a `ModelBench` to its end; return its result.

    Raises RuntimeError if the coroutine waits for something that only a simulator has.
    """
    try:
        test.send(None)
    except StopIteration as end:
        result: T = end.value
        return result
    test.close()
    raise RuntimeError("the test waits for something that only a simulator has")


def rtl_only(why: str) -> Callable[[F], F]:
    """Mark a cocotb test that the golden model cannot run, with the reason.

    The decorator is placed above the other decorators.
    """

    def mark(test: F) -> F:
        test.func._openppmc_rtl_only = why  # type: ignore[attr-defined]
        return test

    return mark
