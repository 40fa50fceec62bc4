"""Commands of an axis of the bank, and the builder of ramp tables that all axes share.

The commands are those of the PPMC-104 without auxiliary pins and external clock (BANK-GEN-03). The builder:
BANK-HSK-05, BANK-INI-01, -02.
"""

from __future__ import annotations

from typing import ClassVar

from ..common.blocks import Context, Phase
from ..motion.chopper import Chopper
from ..motion.excitation import Excitation
from ..ppmc104 import commands
from ..ppmc104.chopper import Switching
from ..single.codes import Command, Error, Kind, decode
from ..single.hostport import BytePort
from .motion import Motion
from .visits import BUILD_LEAD, READY_LEAD, Visits

_LEFT_OUT = (Kind.AUX_ON, Kind.AUX_OFF, Kind.AUX_OUTPUT)
_READ_AUXILIARY = 0x85
_EXTERNAL = 0x10


class Builder:
    """`free_from`: the first edge on which it takes a new table."""

    def __init__(self) -> None:
        self.free_from = 0


class CommandUnit(commands.CommandUnit):
    """Commands of axis `axis`. completed: the visit that completed the last initialisation, or -1.
    initialised: one is complete and in force; known: visit t finds one that an earlier visit completed."""

    while_busy: ClassVar[tuple[Kind, ...]] = (Kind.STOP, Kind.SLOW_STOP)

    def __init__(
        self,
        context: Context,
        port: BytePort,
        motion: Motion,
        excitation: Excitation,
        chopper: Chopper,
        switching: Switching,
        visits: Visits,
        builder: Builder,
        axis: int,
    ) -> None:
        super().__init__(context, port, motion, excitation, chopper, switching)
        self._visits, self._builder, self._axis = visits, builder, axis
        self.completed = -1
        self.initialised = self._before = False

    def _decode(self, byte: int) -> Command:
        command = decode(byte)
        external = command.kind is Kind.INITIALISE and byte & _EXTERNAL
        if external or byte == _READ_AUXILIARY or command.kind in _LEFT_OUT:
            return Command(Kind.UNDEFINED, byte)
        return command

    def _pin(self, name: str) -> int:
        return super()._pin(name) >> self._axis & 1

    def known(self, t: int) -> bool:
        """Whether visit t finds an initialisation that was complete before it (BANK-GRP-02)."""
        return self._before if t == self.completed else self.initialised

    def refuse(self, error: Error) -> None:
        """A GO that nothing was held for (BANK-GRP-02)."""
        self._pending, self._data = None, []
        self.error = error

    def _excitation_off(self, t: int) -> None:
        super()._excitation_off(t)
        self.initialised = False

    def waits_until(self, command: bool) -> int:
        """First edge on which the next byte may be taken as far as the builder is concerned."""
        last = self._pending is not None and self._pending.kind is Kind.INITIALISE and self.expected == 1
        return self._builder.free_from if last and not command else 0

    def _complete_after(self, done: int) -> None:
        self._builder.free_from = done + BUILD_LEAD
        visit = self._visits.first(done + READY_LEAD)
        self._port.close_until(visit)
        self._context.queue.at(visit, Phase.CHOPPER, self._complete)

    def _complete(self, t: int) -> None:
        self.completed, self._before, self.initialised = t, self.initialised, True
        self._context.counter.restart(t)
        super()._complete(t)
