"""Output of the bank on the command line, and simultaneous moves of several axes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..host import MotionResult, NothingToStop, PpmcBank
from ..host.axis import OnProgress
from ..host.motion import AnyMotion
from ..host.part import AnyAxis
from .common.presenter import RampPresenter


class BankPresenter(RampPresenter[PpmcBank]):
    """Presenter of a bank: prints a snapshot with a row for each axis, and starts moves in the same cycle."""

    wide = True

    def status_values(self, part: PpmcBank, axis: AnyAxis) -> dict[str, Any]:
        return self.status_of(part, (axis,))[axis.number]

    def status_of(self, part: PpmcBank, axes: Sequence[AnyAxis]) -> dict[int, dict[str, Any]]:
        return {
            number: {
                "position": seen.position,
                "moving": seen.status.busy,
                "error": None if seen.status.error is None else int(seen.status.error),
                "status": seen.status.raw,
                "inputs": {name: bool(on) for name, on in vars(seen.inputs).items()},
            }
            for number, seen in part.snapshot(axis.number for axis in axes).items()
        }

    def busy(self, part: PpmcBank, axes: Sequence[AnyAxis]) -> tuple[AnyAxis, ...]:
        moving = part.status().busy
        return tuple(axis for axis in axes if axis.number in moving)

    def move_together(
        self,
        part: PpmcBank,
        pulses: Mapping[int, int],
        pps: float | None,
        progress: OnProgress,
        pulse_only: bool = False,
    ) -> Sequence[MotionResult]:
        return list(part.move_together(pulses, pps, progress, pulse_only).values())

    def start_together(self, part: PpmcBank, pulses: Mapping[int, int]) -> Mapping[int, AnyMotion]:
        return part.start_moves(pulses)

    def halt_all(self, part: PpmcBank) -> list[MotionResult]:
        ends = part.stop_all()
        if not ends:
            raise NothingToStop(0, "nothing to stop: no axis is moving")
        return list(ends.values())


PRESENTER = BankPresenter()
