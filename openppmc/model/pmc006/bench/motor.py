"""Motor and comparators on a PMC006B4: two windings between the half bridges.

Between two changes of the bridges, the currents are calculated exactly from resistance, inductance, supply
and a sinusoidal back EMF. Switches and diodes are ideal. Times are edges of `clk` in the public methods, and
seconds in the other code.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import atan2, exp, hypot, pi, sin
from typing import NamedTuple, Protocol, TypeVar

FULL_SCALE_A, FULL_CODE = 4.0, 255
WINDOW_S = 20e-6
"""Shortest time in s between two changes of a comparator with a back EMF."""
BRIDGES = {
    "a": ("bridge_a_en", "m10", "m11", "phase_a_ref", "phase_a_sign", "cmp_a"),
    "b": ("bridge_b_en", "m20", "m21", "phase_b_ref", "phase_b_sign", "cmp_b"),
}
QUARTER = {"a": pi / 2, "b": 0.0}
"""Phase angle of each sine in rad. Phase A is a cosine, phase B a sine."""


class Part(Protocol):
    """Members of the golden model that the motor uses."""

    @property
    def now(self) -> int:
        """Last edge that was simulated."""

    @property
    def next_event(self) -> int | None:
        """Next edge with an event that needs no input change."""

    @property
    def outputs(self) -> Mapping[str, int]:
        """Output levels after edge `now`."""

    def run_until(self, t: int) -> None:
        """Run all edges up to and including t."""

    def pins(self, t: int, **levels: int) -> None:
        """Set input levels from edge t on."""


@dataclass(frozen=True)
class Motor:
    """Winding and supply of the bridges; `ohm` and `henry` are greater than 0."""

    ohm: float = 1.0
    henry: float = 2e-3
    volt: float = 24.0


class Emf(NamedTuple):
    """Back EMF: volt * sin(rad_s * t + angle)."""

    volt: float = 0.0
    rad_s: float = 0.0
    angle: float = 0.0


class CurrentSegment:
    """Current segment from `begin` (s) on, with a constant voltage on the winding and a back EMF."""

    __slots__ = ("_amplitude", "_decay", "_emf", "_free", "_lag", "_level", "begin", "zero_from")

    def __init__(self, motor: Motor, begin: float, ampere: float, volt: float, emf: Emf) -> None:
        self.begin, self._emf = begin, emf
        self._decay = motor.ohm / motor.henry
        self._level = volt / motor.ohm
        reactance = emf.rad_s * motor.henry
        self._amplitude = emf.volt / hypot(motor.ohm, reactance)
        self._lag = emf.angle - atan2(reactance, motor.ohm)
        self._free = 0.0
        self.zero_from = float("inf")
        self._free = ampere - self.at(begin)

    def at(self, t: float) -> float:
        """Return the current in A at t >= begin."""
        if t >= self.zero_from:
            return 0.0
        current = self._level + self._free * exp(self._decay * (self.begin - t))
        if self._amplitude:
            current -= self._amplitude * sin(self._emf.rad_s * t + self._lag)
        return current

    def stop_at_zero(self, positive: bool) -> None:
        """Set the current to 0 from its zero crossing on: the diodes block the other direction."""
        low, high = self.begin, self.begin + WINDOW_S
        while (self.at(high) > 0) == positive:
            low, high = high, high + WINDOW_S
        for _ in range(40):
            middle = (low + high) / 2
            low, high = (middle, high) if (self.at(middle) > 0) == positive else (low, middle)
        self.zero_from = high


class ReferenceSegment:
    """Reference in A from `begin` on, after a first-order low-pass filter.

    For `tau` = 0, there is no filter.
    """

    __slots__ = ("_from", "_tau", "begin", "sign", "to")

    def __init__(self, begin: float, before: float, to: float, sign: int, tau: float) -> None:
        self.begin, self._from, self.to, self.sign, self._tau = begin, before, to, sign, tau

    def at(self, t: float) -> float:
        """Return the magnitude of the reference in A at t >= begin."""
        if not self._tau:
            return self.to
        return self.to + (self._from - self.to) * exp((self.begin - t) / self._tau)


Piece = TypeVar("Piece", CurrentSegment, ReferenceSegment)


class Winding:
    """One phase: its current segment and comparator level, and all earlier segments."""

    def __init__(self, motor: Motor, name: str, begin: float, tau: float) -> None:
        self._motor, self._tau = motor, tau
        self._pins = BRIDGES[name]
        self.cmp_pin = self._pins[-1]
        self.emf = Emf()
        self._last_outputs: tuple[int, ...] = ()
        self.cmp = 0
        self.segments = [CurrentSegment(motor, begin, 0.0, 0.0, self.emf)]
        self.segments[0].zero_from = begin
        self.levels = [ReferenceSegment(begin, 0.0, 0.0, 0, tau)]

    def on_outputs(self, t: float, outputs: Mapping[str, int], emf_changed: bool = False) -> None:
        """Process the outputs of the part at time t.

        Args:
            emf_changed: True if the back EMF has changed at t.
        """
        levels = tuple(outputs[pin] for pin in self._pins[:-1])
        if levels[:3] != self._last_outputs[:3] or emf_changed:
            self._switch(t, *levels[:3])
        if levels[3:] != self._last_outputs[3:]:
            to = levels[3] * FULL_SCALE_A / FULL_CODE
            self.levels.append(ReferenceSegment(t, self.levels[-1].at(t), to, levels[4], self._tau))
        self._last_outputs = levels

    def _switch(self, t: float, on: int, plus: int, minus: int) -> None:
        current = self.segments[-1].at(t)
        volt = self._motor.volt
        if on:
            segment = CurrentSegment(self._motor, t, current, volt * (plus - minus), self.emf)
        else:
            segment = CurrentSegment(self._motor, t, current, -volt if current > 0 else volt, self.emf)
            if current:
                segment.stop_at_zero(current > 0)
            else:
                segment.zero_from = t
        self.segments.append(segment)

    def above(self, t: float) -> int:
        """Return the level of the comparator.

        It is 1 if the current in the direction of the sign has reached the reference.
        """
        level, current = self.levels[-1], self.segments[-1].at(t)
        return int((-current if level.sign else current) >= level.at(t))

    def current(self, t: float) -> float:
        """Return the current in A at any time."""
        return _of(self.segments, t).at(t)

    def reference(self, t: float) -> float:
        """Return the reference with its sign in A at any time."""
        level = _of(self.levels, t)
        return -level.at(t) if level.sign else level.at(t)


def _of(pieces: list[Piece], t: float) -> Piece:
    """Return the segment of `pieces` that contains t."""
    return pieces[max(0, bisect_right(pieces, t, key=lambda piece: piece.begin) - 1)]


class Plant:
    """Motor on a golden model.

    The motor replaces `model.run_until`, and sets the comparator pins with `model.pins`.

    Attributes:
        clk_hz: frequency of the model.
        tau: time constant of the reference's low-pass filter in s; 0 for an ideal reference.
        windings: the phases, by their names "a" and "b".
    """

    def __init__(self, model: Part, clk_hz: int, motor: Motor | None = None, tau: float = 0.0) -> None:
        self._model, self._run, self._hz = model, model.run_until, clk_hz
        self.motor = motor or Motor()
        now = self.seconds(model.now)
        self.windings = {name: Winding(self.motor, name, now, tau) for name in BRIDGES}
        self._update_windings()
        # `run_until` is replaced, so that any caller that runs the model, for example a host, also advances
        # the currents.
        model.run_until = self.run_until  # type: ignore[method-assign]

    def seconds(self, t: int) -> float:
        """Return the time of an edge in s."""
        return t / self._hz

    def spin(self, volt: float, hz: float, angle: float = 0.0) -> None:
        """Set the back EMF from now on.

        Args:
            volt: amplitude.
            hz: electrical frequency.
            angle: angle at edge 0 in rad. Winding A has the cosine of the angle, winding B its sine.

        Raises:
            ValueError: the amplitude reaches the supply.
        """
        if abs(volt) >= self.motor.volt:
            raise ValueError(f"{volt} V of back EMF with a supply of {self.motor.volt} V")
        for name, winding in self.windings.items():
            winding.emf = Emf(volt, 2 * pi * hz, angle + QUARTER[name])
        self._update_windings(emf_changed=True)

    def detach(self) -> None:
        """Remove the motor; afterwards, the model runs without a motor again."""
        self._model.run_until = self._run  # type: ignore[method-assign] # restored

    # ------------------------------------------------------------------ time

    def run_until(self, t: int) -> None:
        """Run the model to edge t; currents and comparators follow."""
        for edge, levels in self.pieces(t):
            self._run(edge)
            if levels:
                self._model.pins(edge + 1, **levels)

    def pieces(self, t: int) -> Iterator[tuple[int, dict[str, int]]]:
        """Yield the time up to edge t in pieces in which no comparator level changes.

        A piece is yielded as its last edge and the comparator levels after this edge. Before the next piece,
        the caller runs the part to this edge and sets the levels.
        """
        model = self._model
        while model.now < t:
            event = model.next_event
            edge = t if event is None else min(t, event)
            flips = [self._flip(winding, edge) for winding in self.windings.values()]
            flip = min((at for at in flips if at is not None), default=None)
            if flip is None:
                yield edge, {}
            else:
                changed = [w for w, at in zip(self.windings.values(), flips, strict=True) if at == flip]
                for winding in changed:
                    winding.cmp ^= 1
                yield flip - 1, {winding.cmp_pin: winding.cmp for winding in changed}
                yield flip, {}
            self._update_windings()

    def _update_windings(self, emf_changed: bool = False) -> None:
        for winding in self.windings.values():
            winding.on_outputs(self.seconds(self._model.now), self._model.outputs, emf_changed)

    def _flip(self, winding: Winding, last: int) -> int | None:
        """Return the first edge up to `last` that samples another level of the comparator.

        The result is `None` if there is no such edge.
        """
        begin = self._model.now
        window = int(WINDOW_S * self._hz)
        before, hz = winding.cmp, self._hz
        while begin < last:
            end = min(last, begin + window)
            if winding.above(end / hz) != before:
                while end - begin > 1:
                    middle = (begin + end) // 2
                    if winding.above(middle / hz) != before:
                        end = middle
                    else:
                        begin = middle
                return end
            begin = end
        return None
