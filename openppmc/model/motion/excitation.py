"""Phase excitation: the energised phases at each index, and the chopper.

The patterns are calculated from the definition of the excitation.

P104-PHS-01..06 (docs/ppmc104/README.md, 10.1 Patterns): the phases form a ring of 3, 4 or 5, and neighbours
are energised. A full step always energises two phases. Half steps alternately energise two phases and one
phase (3- and 4-phase motors), or two phases and three phases (5-phase motors). Patterns are integers, bit 0 =
S1.
"""

from __future__ import annotations

from itertools import product
from typing import Protocol

from ..chip import Context, Phase
from ..clock import Event

ALL_PHASES = 0b11111


def step_list(phases: int, half: bool) -> tuple[int, ...]:
    """Return the energised phases by index, 1 = on. Raises ValueError if phases is not 3, 4 or 5."""
    if phases not in (3, 4, 5):
        raise ValueError(f"{phases} phases")

    def ring(first: int, count: int) -> int:
        return sum(1 << (first + i) % phases for i in range(count))

    steps: list[int] = []
    for first in range(phases):
        steps.append(ring(first, 2))
        if half:
            # A pattern between two full steps energises the phase that both full steps have in common (1-2
            # phase), or the three phases that at least one of them energises (2-3 phase).
            steps.append(ring(first, 3) if phases == 5 else ring(first + 1, 1))
    return tuple(steps)


def step_directions() -> dict[tuple[int, int], int]:
    """Return the direction of each step by its phase levels (before, after): 1 = CW, -1 = CCW.

    One table is valid for all motors and both logics. A pair of levels that occurs with several motors has
    the same direction with all of them.
    """
    found: dict[tuple[int, int], int] = {}
    for phases, half, off in product((3, 4, 5), (False, True), (0, ALL_PHASES)):
        ring = [pattern ^ off for pattern in step_list(phases, half)]
        for was, now in zip(ring, ring[1:] + ring[:1], strict=True):
            assert found.setdefault((was, now), 1) == 1
            assert found.setdefault((now, was), -1) == -1
    return found


class Excitation:
    """The index and the output levels of the phase pins.

    Args:
        idle: level of all five pins until the first initialisation (P104-PHS-02).
    """

    def __init__(self, idle: int = 1) -> None:
        self._idle_level = ALL_PHASES if idle else 0
        self.energised = False
        self.index = 0
        self.positive = False
        self._steps: tuple[int, ...] = (0,)

    def configure(self, phases: int, half: bool, positive: bool) -> None:
        """Process the first accepted initialisation.

        It fixes motor type, excitation method and logic, and sets the index to 0.

        Rule: P104-PHS-03.
        """
        self._steps = step_list(phases, half)
        self.positive = positive
        self.index = 0
        self.energised = True

    def off(self) -> None:
        """Switch the excitation off: the pins stay at the off level of the active logic (P104-PHS-05)."""
        if self.energised:
            self._idle_level = self.off_level
            self.energised = False

    def step(self, direction: int) -> None:
        """Advance the index by one pulse: CW (0) forward, CCW (1) backward (P104-OPR-05)."""
        self.index = (self.index + (-1 if direction else 1)) % len(self._steps)

    @property
    def off_level(self) -> int:
        """Level of all five pins in the active logic when all phases are off (P104-PHS-01)."""
        return 0 if self.positive else ALL_PHASES

    @property
    def pattern(self) -> int:
        """Pin levels of the current pattern without chopping."""
        if not self.energised:
            return self._idle_level
        return self._steps[self.index] ^ self.off_level

    @property
    def chopped(self) -> int:
        """Pin levels in the OFF phase of the chopper."""
        return self.off_level if self.energised else self._idle_level


# Chopping of the phase outputs at standstill (P104-SW-01..07, P2104-SW-01..05).


class ChopperTimes(Protocol):
    """Chopper times of a part."""

    def quanta(self, on: bool) -> int:
        """Return the length of an ON or OFF phase that begins now, in quanta."""


class Chopper:
    """Chopper: alternates ON and OFF phases while it runs.

    The lengths of these phases are counted in ticks of the quantum counter.

    Attributes:
        next_phase_at: edge at which the next phase begins, `None` while the chopper does not run.
    """

    def __init__(self, context: Context, times: ChopperTimes) -> None:
        self._context = context
        self._times = times
        self.on = True
        self.next_phase_at: int | None = None
        self._tick = 0
        self._event: Event | None = None

    def start(self, t: int) -> None:
        """Begin with a complete ON phase at edge t (P104-SW-02)."""
        self.stop()
        self._tick = self._context.counter.last_tick(t)
        self._plan()

    def stop(self) -> None:
        """Stop the chopper: the pins have the full pattern, without switching (P104-SW-03)."""
        if self._event:
            self._event.cancel()
            self._event = None
        self.next_phase_at = None
        self.on = True

    def _plan(self) -> None:
        self._tick += self._length()
        self.next_phase_at = self._context.counter.edge_of(self._tick)
        self._event = self._context.queue.at(self.next_phase_at, Phase.CHOPPER, self._boundary)

    def _length(self) -> int:
        """Return the length of the phase that begins now, in quanta."""
        return self._times.quanta(self.on)

    def _boundary(self, t: int) -> None:
        self.on = not self.on
        self._plan()
