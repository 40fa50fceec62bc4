"""Motion engine of the PMC006B4 in steps of one microsecond, a reference for the golden model.

It follows the rules P006-MOT directly, with rational arithmetic and one state for each register, so it is
slow. It shares no code with the golden model.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import ceil, floor, isqrt


def slope(n: int) -> int:
    return 1700 * 2**n


def full(progress: Fraction, up: bool) -> int:
    """Convert the progress of a ramp in one update into units of 2^-32, at most 1, rounded up or down."""
    scaled = progress * 2**32
    return min(2**32, ceil(scaled) if up else floor(scaled))


class Reference:
    """A motion computed independently of the golden model, in steps of 1 us, until `done` is True.

    Attributes:
        steps: pairs (us, speed).
        target: target(t) returns the live target.
        off: off(t) returns whether the speed mode is switched off.
    """

    def __init__(
        self,
        n: int | None,
        vs: int,
        ve: int,
        vmax: int,
        acc: int,
        dec: int,
        target: Callable[[int], int] | None = None,
        off: Callable[[int], bool] = lambda t: False,
        straight: bool = False,
    ) -> None:
        self.target, self.off, self.straight = target or (lambda t: vmax), off, straight
        self.n, self.ve, self.acc, self.dec, self.seen = n, ve, acc, dec, vmax
        self.t = self.since = self.sum = 0
        self.done, self.phase = False, "CRUISE"
        self.steps: list[tuple[int, int]] = []
        self.speeds: list[int] = []
        self.short = n is not None and n < 256
        self.v = self.next = vs if self.short else min(vs, vmax)
        goal = vmax
        if self.short:
            if ve != vs:
                change = abs(ve - vs)
                share = Fraction(slope(dec if ve < vs else acc), 10_000 * change)
                self.ramp("RAMP", ve, max(full(share, False), self.fit(vs, n or 0)), False)
        else:
            if n is not None and vmax >= max(vs, ve):
                goal = self.plan(n, vs, vmax)
            if goal != self.v:
                self.ramp("RAMP", goal, self.by_slope(abs(goal - self.v), self.acc), True)
        self.look()

    def by_slope(self, change: int, n: int) -> int:
        return full(Fraction(slope(n), 10_000 * change), False)

    def fit(self, v: int, left: int) -> int:
        return full(Fraction(v + self.ve, 20_000 * max(1, left - 3)), True)

    def plan(self, n: int, vs: int, top: int) -> int:
        spare = floor(Fraction(top, 4096)) + 8

        def need() -> int:
            up = ceil(Fraction(top**2 - vs**2, 2 * slope(self.acc)))
            return up + ceil(Fraction(top**2 - self.ve**2, 2 * slope(self.dec))) + spare

        while need() > n:
            if self.acc == self.dec == 5:
                return min(top, isqrt(54_400 * (n - spare) + floor(Fraction(vs**2 + self.ve**2, 2))))
            self.acc, self.dec = min(5, self.acc + 1), min(5, self.dec + 1)
        return top

    def ramp(self, phase: str, to: int, step: int, smooth: bool) -> None:
        self.phase, self.origin, self.to, self.step, self.smooth = phase, self.v, to, step, smooth
        self.u = 0

    def look(self) -> None:
        """Evaluate the state after an update tick, by the list in docs/pmc006/README.md, chapter 6."""
        off = self.n is None and self.off(self.t)
        if self.phase in ("STOP", "END") and not off:
            self.phase, self.seen = "CRUISE", self.v
        if self.phase in ("RAMP", "CRUISE") and off:
            if self.v > self.ve:
                self.ramp("STOP", self.ve, self.by_slope(self.v - self.ve, self.dec), True)
            else:
                self.phase = "END"
        elif self.phase in ("RAMP", "CRUISE") and not self.short:
            target = self.target(self.t)
            if target != self.seen:
                self.seen = target
                self.phase = "CRUISE"
                if target != self.v:
                    n = self.acc if target > self.v else self.dec
                    self.ramp("RAMP", target, self.by_slope(abs(target - self.v), n), not self.straight)
            if self.n is not None and self.v > self.ve:
                away = ceil(Fraction(self.v**2 - self.ve**2, 2 * slope(self.dec)))
                if self.n <= away + self.v // 4096 + 4:
                    self.ramp("DEC", self.ve, self.fit(self.v, self.n), True)
        if self.phase in ("RAMP", "DEC", "STOP"):
            self.u += self.step
            if self.u >= 2**32:
                self.next = self.to
                self.phase = {"RAMP": "CRUISE", "DEC": "CREEP", "STOP": "END"}[self.phase]
            else:
                self.next = self.along()
        elif self.phase != "END":
            self.next = self.v

    def along(self) -> int:
        x = Fraction(self.u // 2**16, 2**16)
        part = Fraction(floor((3 * x**2 - 2 * x**3 if self.smooth else x) * 2**32), 2**32)
        way = floor(abs(self.to - self.origin) * part + Fraction(1, 2))
        return self.origin + (way if self.to > self.origin else -way)

    def tick(self) -> None:
        """Run one microsecond."""
        self.t += 1
        update = self.since == 99
        self.since = 0 if update else self.since + 1
        if update:
            if self.phase == "END" and self.off(self.t):
                self.done = True
                return
            self.v = self.next
            self.speeds.append(self.v)
        self.sum += self.v
        if self.sum >= 1_000_000:
            self.sum -= 1_000_000
            self.steps.append((self.t, self.v))
            if self.n is not None:
                self.n -= 1
                if self.n == 0:
                    self.done = True
                    return
        if update:
            self.look()

    def run(self, last: int) -> Reference:
        """Run until the motion has ended, but at most to `last` us."""
        while not self.done and self.t < last:
            self.tick()
        return self
