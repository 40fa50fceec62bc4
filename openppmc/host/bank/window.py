"""The window of a bank through the UART bridge, which sees the registers of one axis at a time.

A write to register 3 selects it. Every script selects anew, so a lost answer, a reset or another program
cannot leave the wrong axis behind; inside a script only a change does.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..errors import WrongDevice
from ..link import Link
from ..script import LONGEST_SCRIPT, MOST_DATA, Answer, Identity, Result, Script
from .words import INFO, MARK, SELECT, SIZES, VERSION, Info, refused

_SELECT_BYTES = 2
Piece = tuple[int, Script]
"""Number of an axis, 1 the first, and what to do there."""


class AxisLink:
    """A link as the driver of one axis uses it; see `link.Link`. number: of the axis, from 1."""

    def __init__(self, link: Link, number: int) -> None:
        self._link = link
        self._number = number

    @property
    def name(self) -> str:
        """The port as the user named it."""
        return self._link.name

    @property
    def identity(self) -> Identity:
        """What the bridge said about itself."""
        return self._link.identity

    def clock(self) -> float:
        """Time of the port in s."""
        return self._link.clock()

    def pause(self, seconds: float) -> None:
        """Let time of the port pass."""
        self._link.pause(seconds)

    def close(self) -> None:
        """Close the port, for all axes."""
        self._link.close()

    def wait_event(self, timeout: float) -> int | None:
        """The next event of any axis."""
        return self._link.wait_event(timeout)

    def forget_events(self) -> None:
        """Drop events that came earlier."""
        self._link.forget_events()

    def execute(self, script: Script) -> Answer:
        """Run a script at this axis completely."""
        return self.judge(self.attempt(script))

    def attempt(self, script: Script) -> Answer:
        """Run a script at this axis and return its answer whatever its result is."""
        return self._link.attempt(Script().write(SELECT, self._number - 1).extend(script))

    def judge(self, answer: Answer) -> Answer:
        """The answer itself if all ops were done, otherwise the exception, with the axis in its words."""
        if answer.result is Result.REFUSED:
            raise refused(answer.last, self._number)
        return self._link.judge(answer)


def visit(link: Link, pieces: Sequence[Piece]) -> list[tuple[bytes, ...]]:
    """Do something at each of several axes, in as few frames as it takes; returns the values of each.

    Raises what `Link.execute` does; a refusal names its axis, and what comes behind it is not done.
    """
    values: list[tuple[bytes, ...]] = []
    for frame in _frames(pieces):
        values += _run(link, frame)
    return values


def _frames(pieces: Sequence[Piece]) -> Iterator[list[Piece]]:
    """As many in a row as fit."""
    frame: list[Piece] = []
    room, data = LONGEST_SCRIPT, MOST_DATA
    for number, script in pieces:
        size = _SELECT_BYTES + len(bytes(script))
        if frame and (size > room or script.gives > data):
            yield frame
            frame, room, data = [], LONGEST_SCRIPT, MOST_DATA
        frame.append((number, script))
        room, data = room - size, data - script.gives
    if frame:
        yield frame


def _run(link: Link, frame: Sequence[Piece]) -> list[tuple[bytes, ...]]:
    whole, selected = Script(), 0
    owners: list[int] = []
    for number, piece in frame:
        if number != selected:
            whole.write(SELECT, number - 1)
        selected = number
        whole.extend(piece)
        owners += [number] * (len(whole.ops) - len(owners))
    answer = link.attempt(whole)
    if answer.result is Result.REFUSED:
        place = next(place for place, op in enumerate(whole.ops) if op is answer.failed)
        raise refused(answer.last, owners[place])
    values = iter(link.judge(answer).values)
    return [tuple(next(values) for op in piece.ops if op.gives) for _, piece in frame]


def read_info(link: Link) -> Info:
    """INFO, checked (BANK-WIN-03). WrongDevice for what is no bank, or one unknown here."""
    # Register bytes of the bank are told apart by the axis, of which there are four at least.
    mark, version, axes = (
        value[0][0] for value in visit(link, [(k, Script().read(INFO)) for k in (1, 2, 3)])
    )
    if mark != MARK:
        raise WrongDevice(
            f"{link.name}: INFO of the bank begins with {mark:#04x}, not with {MARK:#04x} (B): there is no "
            "bank in this bitstream, or it is in reset"
        )
    if version != VERSION:
        newer = "this package" if version > VERSION else "the board's bitstream"
        raise WrongDevice(
            f"{link.name}: the bank's window is of version {version}, this package knows {VERSION}: "
            f"renew {newer}"
        )
    if axes not in SIZES:
        raise WrongDevice(
            f"{link.name}: the bank tells of {axes} axes, and there are such of {', '.join(map(str, SIZES))}"
        )
    return Info(version, axes)
