"""Stop-time switching of the phase outputs (P104-SW-01..07, P104-INI-08, P104-AUX-03)."""

from __future__ import annotations

from .parts104 import Context, Phase
from .scheduler import Event

DEFAULT_QUANTA = (260, 435)


class Chopper:
    """Alternates ON and OFF phases, counted in ticks of the quantum counter, while it is allowed to run."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self.reset()

    def reset(self) -> None:
        """Stopped, default times."""
        self.on = True
        self._parameters: tuple[int, int] | None = None
        self._tick = 0
        self._event: Event | None = None

    def set_parameters(self, p_on: int, p_off: int) -> None:
        """0x84: both values, 0..255, used from the next phase boundary on (P104-AUX-03)."""
        self._parameters = (p_on, p_off)

    def start(self, t: int) -> None:
        """Begin with a complete ON phase at edge t (P104-SW-02)."""
        self.stop()
        self._tick = self._context.counter.last_tick(t)
        self._plan()

    def stop(self) -> None:
        """Full pattern, no switching (P104-SW-03)."""
        if self._event:
            self._event.cancel()
            self._event = None
        self.on = True

    def phase_quanta(self, on: bool) -> int:
        """Length of a phase that begins now (P104-SW-04, -05)."""
        if self._parameters is None:
            return DEFAULT_QUANTA[0 if on else 1]
        plain = self._context.levels["vsel"]
        p_on, p_off = self._parameters
        if on:
            return 12 * p_on + (108 if plain else 100)
        return 12 * p_off + (132 if plain else 115)

    def _plan(self) -> None:
        self._tick += self.phase_quanta(self.on)
        edge = self._context.counter.edge_of(self._tick)
        self._event = self._context.queue.at(edge, Phase.CHOPPER, self._boundary)

    def _boundary(self, t: int) -> None:
        self.on = not self.on
        self._plan()
