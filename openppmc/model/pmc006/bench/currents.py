"""Phase currents that a PMC006B4 regulates.

The module sets up measurements on the golden model, and calculates ripple, error and distortion of the
currents.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from math import atan2, cos, hypot, pi, sin, sqrt
from typing import NamedTuple

from ..line import command
from ..part import Pmc006
from .motor import Motor, Plant, Winding

CLK_HZ, BAUD, ADDRESS = 16_000_000, 115_200, 255
SAMPLE_S = 1e-6
HARMONICS = 40
MS = CLK_HZ // 1000


@dataclass(frozen=True)
class Case:
    """Set-up of a measurement.

    Attributes:
        cur: requested current in mA.
        mstep: microsteps per full step; 0 for full steps.
        full: speed in full steps/s. The speed in steps/s, full * max(1, mstep), is at most 16000.
        emf: amplitude of the back EMF in V; its phase is 90 degrees ahead of the reference.
        scomp: speed compensation P.
        periods: number of electrical cycles that are measured.
    """

    cur: int = 1000
    mstep: int = 16
    full: int = 1000
    emf: float = 0.0
    motor: Motor = Motor()
    tau: float = 0.0
    scomp: int = 1250
    periods: int = 2

    @property
    def hz(self) -> float:
        """Electrical frequency in Hz."""
        return self.full / 4


class Waves(NamedTuple):
    """Samples of one phase: time in s since the first sample, current and reference in A."""

    time: list[float]
    current: list[float]
    reference: list[float]


class WaveMetrics(NamedTuple):
    """Results of a measurement.

    Attributes:
        amplitude: amplitude of the fundamental of the reference in A.
        error: rms of the current minus the fundamental of the reference, relative to the rms of this
            fundamental.
        follows: rms of the current minus the reference, relative to the rms of the reference.
        thd: rms of harmonics 2..40 of the current, relative to the rms of its fundamental.
        all: rms of the current without its fundamental, relative to the rms of its fundamental.
    """

    amplitude: float
    error: float
    follows: float
    thd: float
    all: float


class BootedMotor:
    """Golden model after its boot, with a motor."""

    def __init__(self, case: Case) -> None:
        self.case = case
        self.part = Pmc006(CLK_HZ, baud=BAUD, straps={"sda_i": 0})
        self._go(MS)
        for code, data in (("e", case.cur), ("m", case.mstep), ("M", 100), ("P", case.scomp), ("a", 0)):
            self.send(code, data)

    def _go(self, clk: int) -> None:
        self.part.run_until(self.part.now + clk)

    def send(self, code: str, data: int) -> None:
        """Send a frame and wait for its reply."""
        bit = CLK_HZ / BAUD
        begin = self.part.now + 1
        for number, byte in enumerate(command(ADDRESS, code, data)):
            self.part.on_char(begin + round((10 * number + 9.5) * bit), byte)
        self._go(round(165 * bit))

    def hold(self, angle_steps: int = 0) -> Plant:
        """Return the motor in steady state at standstill, with full current.

        Args:
            angle_steps: distance in steps between the angle after a reset and the angle at which the motor
                stands.
        """
        if angle_steps:
            self.send("s", angle_steps)
            self._go(MS * angle_steps * 2)
        plant = Plant(self.part, CLK_HZ, self.case.motor, self.case.tau)
        self._go(20 * MS)
        return plant

    def cruise(self) -> Plant:
        """Return the motor in steady state at constant speed."""
        speed = self.case.full * max(1, self.case.mstep)
        slow = min(3000, speed)
        for code, data in (("u", 5), ("v", speed), ("L", slow), ("S", slow), ("N", 1)):
            self.send(code, data)
        self._go(MS * (20 + (speed - slow) // 54))
        plant = Plant(self.part, CLK_HZ, self.case.motor, self.case.tau)
        cycle = round(CLK_HZ / self.case.hz)
        begin = self.part.now
        self._go(cycle)
        if self.case.emf:
            _, angle = _component(waves(plant, "b", begin, begin + cycle).reference, 1)
            emf_angle = angle - 2 * pi * self.case.hz * plant.seconds(begin) + pi / 2
            plant.spin(self.case.emf, self.case.hz, emf_angle)
        self._go(max(cycle, round(5 * CLK_HZ * self.case.motor.henry / self.case.motor.ohm)))
        return plant


def waves(plant: Plant, phase: str, first: int, last: int, step: float = SAMPLE_S) -> Waves:
    """Return samples of phase "a" or "b" every `step` s, from edge `first` to before edge `last`."""
    winding: Winding = plant.windings[phase]
    begin = plant.seconds(first)
    times = [number * step for number in range(round((plant.seconds(last) - begin) / step))]
    current = [winding.current(begin + t) for t in times]
    return Waves(times, current, [winding.reference(begin + t) for t in times])


def cruising(case: Case) -> tuple[Waves, Waves]:
    """Return the samples of both phases over whole electrical cycles at constant speed."""
    booted = BootedMotor(case)
    plant = booted.cruise()
    first = booted.part.now
    last = first + round(CLK_HZ / case.hz) * case.periods
    booted.part.run_until(last)
    return waves(plant, "a", first, last), waves(plant, "b", first, last)


def holding(case: Case, angle_steps: int = 0, us: int = 400) -> tuple[Waves, Waves]:
    """Return the samples of both phases at standstill, over `us` microseconds."""
    booted = BootedMotor(case)
    plant = booted.hold(angle_steps)
    first = booted.part.now
    last = first + us * CLK_HZ // 1_000_000
    booted.part.run_until(last)
    step = SAMPLE_S / 8
    return waves(plant, "a", first, last, step), waves(plant, "b", first, last, step)


# ---------------------------------------------------------------------- results


def _component(samples: Sequence[float], cycles: int) -> tuple[float, float]:
    """Return amplitude and angle of the harmonic that has `cycles` cycles over all samples."""
    turn = 2 * pi * cycles / len(samples)
    along = sum(value * sin(turn * n) for n, value in enumerate(samples)) * 2 / len(samples)
    across = sum(value * cos(turn * n) for n, value in enumerate(samples)) * 2 / len(samples)
    return hypot(along, across), atan2(across, along)


def _rms(samples: Sequence[float]) -> float:
    return sqrt(sum(value * value for value in samples) / len(samples))


def spectrum(samples: Sequence[float], periods: int, harmonics: int = HARMONICS) -> list[float]:
    """Return the amplitudes of harmonics 1, 2, .. of samples over whole cycles."""
    return [_component(samples, periods * number)[0] for number in range(1, harmonics + 1)]


def wave_metrics(measured: Waves, periods: int) -> WaveMetrics:
    """Return the results of one phase over whole cycles."""
    size, angle = _component(measured.reference, periods)
    turn = 2 * pi * periods / len(measured.reference)
    fundamental = [size * sin(turn * n + angle) for n in range(len(measured.reference))]
    from_fundamental = _rms([a - b for a, b in zip(measured.current, fundamental, strict=True)])
    from_reference = _rms([a - b for a, b in zip(measured.current, measured.reference, strict=True)])
    lines = spectrum(measured.current, periods)
    rest = _rms(measured.current) ** 2 - lines[0] ** 2 / 2
    return WaveMetrics(
        size,
        from_fundamental / _rms(fundamental),
        from_reference / _rms(measured.reference),
        hypot(*lines[1:]) / lines[0],
        sqrt(max(0.0, rest) * 2) / lines[0],
    )


def residual_current(measured: Waves) -> tuple[float, float]:
    """Return (maximum, minimum) of the mean currents of steps whose reference is 0, in A.

    The mean is calculated over the second half of each step. The value 0 is always included, so the maximum
    is at least 0, and the minimum at most 0.
    """
    means = [0.0]
    for zero, span in groupby(zip(measured.reference, measured.current, strict=True), lambda one: not one[0]):
        currents = [current for _, current in span]
        if zero:
            late = currents[len(currents) // 2 :]
            means.append(sum(late) / len(late))
    return max(means), min(means)


def ripple(measured: Waves) -> tuple[float, float]:
    """Return mean and peak-to-peak value of a current at standstill, in A."""
    return sum(measured.current) / len(measured.current), max(measured.current) - min(measured.current)
