"""Output of the PPMC-2104 on the command line, and simultaneous moves of both axes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..host import MotionResult, Ppmc2104
from ..host.axis import OnProgress
from ..host.motion import AnyMotion
from ..host.ppmc2104.registers import Status
from .common.presenter import RampPresenter


class PartPresenter(RampPresenter[Ppmc2104]):
    """Presenter of a part with two axes that have a common status register and can start together."""

    def moving(self, status: Status, number: int) -> tuple[bool, int | str | None]:
        return status.busy[number - 1], "unread" if status.error else None

    def move_together(
        self,
        part: Ppmc2104,
        pulses: Mapping[int, int],
        pps: float | None,
        progress: OnProgress,
        pulse_only: bool = False,
    ) -> Sequence[MotionResult]:
        return part.move_together(pulses[1], pulses[2], pps, pps, progress, pulse_only)

    def start_together(self, part: Ppmc2104, pulses: Mapping[int, int]) -> Mapping[int, AnyMotion]:
        return dict(zip((1, 2), part.start_moves(pulses[1], pulses[2]), strict=True))


PRESENTER = PartPresenter()
