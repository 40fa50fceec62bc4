"""What instructions of the PPMC-312 need of the part: its blocks and its state. `ppmc312.core.Core` is it."""

from __future__ import annotations

from typing import Protocol

from ...common.blocks import Context
from ..codes import Alarm, Source, State
from ..front.responses import Responses
from ..front.side import HostSide
from ..motion.inputs import InputChange
from ..motion.operation import Operation
from ..motion.outputs import Outputs
from ..motion.position import Counters, Interlock, Watch
from ..pace import Pace
from ..stages.curve import FreeCurve
from ..stages.tables import Table
from .overrides import EventBuffer, Fifo


class Core(Protocol):
    """table: of the last setting, None in state INI. transfer: a free curve that is being sent. version: of
    the firmware."""

    table: Table | None
    transfer: FreeCurve | None
    context: Context
    pace: Pace
    version: int
    host: HostSide
    responses: Responses
    counters: Counters
    interlock: Interlock
    fifo: Fifo
    events: tuple[EventBuffer, EventBuffer]
    outputs: Outputs
    operation: Operation
    watch: Watch
    input_change: InputChange

    @property
    def state(self) -> State:
        """The operation state of chapter 4."""

    def reset(self, t: int, source: Source, /) -> None:
        """The part's software reset, which answers."""

    def forget_table(self) -> None:
        """State INI: no table, no registered instructions."""

    def set_table(self, table: Table) -> None:
        """State NOR with a new table."""

    def drop_overrides(self, t: int) -> None:
        """An override has failed."""

    def alarm(self, t: int, status: Alarm) -> None:
        """Multiple occurrence."""

    def clear_alarm(self, t: int) -> None:
        """24."""
