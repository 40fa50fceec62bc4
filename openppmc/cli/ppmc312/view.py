"""What a PPMC-312 shows on the command line, and what only it can do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ...host import Ppmc312, speeds
from ...host.axis import OnProgress
from ...host.part import AnyAxis
from ...host.ppmc312.answers import Alarm, Failed
from ...host.ppmc312.profile import Setup
from ..common.forecast import Course
from ..common.override import Override
from ..common.view import View
from . import forecast, show
from .overrides import register


class PartView(View[Ppmc312, Setup]):
    """Tables of ramps, an encoder, overrides, and reports that the part sends by itself."""

    def status_values(self, part: Ppmc312, axis: AnyAxis) -> dict[str, Any]:
        return show.status_values(part)

    def status_rows(self, values: dict[str, Any]) -> dict[str, str]:
        rows = super().status_rows(values)
        del rows["last byte"]
        return rows | show.state_rows(values)

    def reports(self, part: Ppmc312, tell: Callable[[str], None]) -> None:
        trouble = None
        while (report := part.next_report()) is not None:
            if isinstance(report, (Failed, Alarm)):
                trouble = trouble or report.error
            else:
                tell(show.report_line(report))
        if trouble is not None:
            raise trouble

    def setup_rows(self, setup: Setup) -> dict[str, str]:
        return show.setup_rows(setup)

    def setup_values(self, setup: Setup) -> dict[str, Any]:
        return show.setup_values(setup)

    def figures(self, setup: Setup, pulses: int, speed: speeds.Speed | None) -> dict[str, Any]:
        return forecast.figures(setup, pulses, speed)

    def course(self, setup: Setup, pulses: int, speed: speeds.Speed | None) -> Course:
        return forecast.course(setup, pulses, speed)

    def prepare(self, part: Ppmc312, overrides: Sequence[Override], encoder: int | None) -> None:
        if encoder is not None:
            part.watch_encoder(encoder)
        register(part, overrides)

    def home(
        self,
        part: Ppmc312,
        axis: AnyAxis,
        direction: int,
        pps: float | None,
        fast: bool,
        to_limit: bool,
        index: bool,
        progress: OnProgress,
    ) -> None:
        part.home(direction, pps, fast, to_limit, progress=progress, index=index)

    def table_lines(self, part: Ppmc312) -> list[str]:
        return show.table_lines(part.read_table(), part.known_setup())


VIEW = PartView()
