"""Which board a command talks to, and the board while it does."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from ... import parts
from ...host import End, NothingToStop, PpmcError, open_part
from ...host.kind import Kind
from ...host.link import DEFAULT_BAUD
from ...host.part import AnyAxis, Part
from . import output
from .board import BOARD
from .guard import Guard
from .options import SetupValues
from .state import recall
from .version import misfit
from .view import AnyView, view_of


@dataclass
class Session:
    """An open board."""

    part: Part
    guard: Guard

    @property
    def kind(self) -> Kind:
        """What part it is."""
        return self.part.kind

    @property
    def view(self) -> AnyView:
        """What it shows, and what not all parts have."""
        return view_of(self.kind)

    @property
    def xtal_hz(self) -> int:
        """Its crystal."""
        return self.part.link.identity.xtal_hz

    def axis(self, number: int = 1) -> AnyAxis:
        """One axis; OutOfRange if the part does not have it."""
        return self.part.axes[self.kind.check_axis(number) - 1]

    def chosen(self, number: int | None) -> Sequence[AnyAxis]:
        """That axis, or all."""
        return self.part.axes if number is None else (self.axis(number),)


def setup_values(typed: dict[str, Any], axis: int = 1) -> SetupValues:
    """Defaults, then what `init` remembered for this port and axis, then what was typed."""
    return SetupValues().merged(recall(BOARD.port, axis)).merged(typed)


@contextmanager
def opened() -> Iterator[Session]:
    """The board, and signals under control: they bring the motors to rest and end with status 128 + n. A lost
    stdout brings the motors to rest, too."""
    number = None if BOARD.part is None else parts.part(BOARD.part).number
    with (
        open_part(BOARD.spec, BOARD.baud or DEFAULT_BAUD, number) as part,
        Guard() as guard,
        guard.resting(part),
    ):
        if line := misfit(part.link.build(), part.link.identity.part):
            output.note(f"note: {line}")
        yield Session(part, guard)


@contextmanager
def ready(typed: dict[str, Any], axes: Iterable[int]) -> Iterator[Session]:
    """The board with these axes initialised."""
    with opened() as session:
        initialise(session, {axis: setup_values(typed, axis) for axis in axes})
        yield session


def initialise(session: Session, values: dict[int, SetupValues]) -> list[Any]:
    """Initialise axes, all plans made before the first; returns what is reached."""
    plans = {
        axis: table.plan(session.xtal_hz, session.kind, session.kind.check_axis(axis))
        for axis, table in values.items()
    }
    return [session.part.axes[axis - 1].apply(plan) for axis, plan in plans.items()]


def stop_all(axes: Sequence[AnyAxis], now: bool = False) -> list[End]:
    """Stop motions, perhaps of another program, and wait for their ends. All are stopped before an error is
    told; that one rests already is none as long as another moves."""
    errors: list[PpmcError] = []
    moving = []
    for axis in axes:
        try:
            (axis.halt if now else axis.stop)(wait=False)
            moving.append(axis)
        except PpmcError as error:
            errors.append(error)
    ends = [axis.motion.wait() for axis in moving if axis.motion is not None]
    for told in errors:
        if len(errors) == len(axes) or not isinstance(told, NothingToStop):
            raise told
    return ends
