"""Window of a bank through the UART bridge, which gives access to the registers of one axis at a time.

A write to register 3 selects the axis. Every script selects its axis at the beginning, because the selection
may have changed: by a script whose response was lost, by a reset, or by another program. Within a script,
register 3 is written only if the axis changes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..errors import WrongDevice
from ..link import Link
from ..script import LONGEST_SCRIPT, MOST_DATA, Answer, Identity, Result, Script
from .registers import INFO, INFO_MARK, INFO_VERSION, SELECT, SIZES, Info, command_error

_SELECT_BYTES = 2
Piece = tuple[int, Script]
"""Number of an axis, from 1, and the script that is executed while this axis is selected."""


class AxisLink:
    """Link for the driver of one axis; see `link.Link`.

    Args:
        number: number of the axis, from 1.
    """

    def __init__(self, link: Link, number: int) -> None:
        self._link = link
        self._number = number

    @property
    def name(self) -> str:
        """Port as the user named it."""
        return self._link.name

    @property
    def identity(self) -> Identity:
        """Identity that the bridge reported."""
        return self._link.identity

    def clock(self) -> float:
        """Return the time of the port in s."""
        return self._link.clock()

    def pause(self, seconds: float) -> None:
        """Wait for a number of seconds, measured with the clock of the port."""
        self._link.pause(seconds)

    def close(self) -> None:
        """Close the port for all axes."""
        self._link.close()

    def wait_event(self, timeout: float) -> int | None:
        """Return the next event of any axis, `None` after timeout seconds."""
        return self._link.wait_event(timeout)

    def forget_events(self) -> None:
        """Discard the events received so far."""
        self._link.forget_events()

    def execute(self, script: Script) -> Answer:
        """Execute a script completely while this axis is selected, and return its answer."""
        return self.check_answer(self.attempt(script))

    def attempt(self, script: Script) -> Answer:
        """Execute a script while this axis is selected, and return its answer for any result."""
        return self._link.attempt(Script().write(SELECT, self._number - 1).extend(script))

    def check_answer(self, answer: Answer) -> Answer:
        """Return the answer if all operations were executed, else raise the error that it reports.

        The error of a rejected command names the axis.
        """
        if answer.result is Result.REFUSED:
            raise command_error(answer.last, self._number)
        return self._link.check_answer(answer)


def visit(link: Link, pieces: Sequence[Piece]) -> list[tuple[bytes, ...]]:
    """Execute scripts for several axes in as few frames as possible; return the values of each script.

    The call raises the errors of `Link.execute`. If a command is rejected, the error names the axis, and the
    following scripts are not executed.
    """
    values: list[tuple[bytes, ...]] = []
    for frame in _frames(pieces):
        values += _run(link, frame)
    return values


def _frames(pieces: Sequence[Piece]) -> Iterator[list[Piece]]:
    """Split the scripts into frames, each as long as possible."""
    frame: list[Piece] = []
    room, data = LONGEST_SCRIPT, MOST_DATA
    for number, script in pieces:
        size = _SELECT_BYTES + len(bytes(script))
        if frame and (size > room or script.response_size > data):
            yield frame
            frame, room, data = [], LONGEST_SCRIPT, MOST_DATA
        frame.append((number, script))
        room, data = room - size, data - script.response_size
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
        raise command_error(answer.last, owners[place])
    values = iter(link.check_answer(answer).values)
    return [tuple(next(values) for op in piece.ops if op.response_size) for _, piece in frame]


def read_info(link: Link) -> Info:
    """Read and check INFO (BANK-WIN-03).

    Raises:
        WrongDevice: this is no bank, or a bank of an unknown version or size.
    """
    # The selected axis determines which byte of INFO is read. All banks have at least four axes.
    mark, version, axes = (
        value[0][0] for value in visit(link, [(k, Script().read(INFO)) for k in (1, 2, 3)])
    )
    if mark != INFO_MARK:
        raise WrongDevice(
            f"{link.name}: INFO of the bank begins with {mark:#04x}, not with {INFO_MARK:#04x} (B): there is "
            "no bank in this bitstream, or it is in reset"
        )
    if version != INFO_VERSION:
        newer = "this package" if version > INFO_VERSION else "the board's bitstream"
        raise WrongDevice(
            f"{link.name}: the bank's window is of version {version}, this package knows {INFO_VERSION}: "
            f"renew {newer}"
        )
    if axes not in SIZES:
        raise WrongDevice(
            f"{link.name}: the bank reports {axes} axes; expected one of {', '.join(map(str, SIZES))}"
        )
    return Info(version, axes)
