"""Handling of signals: they end a program after its motors have stopped."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .motion import Progress
    from .part import Device, Stoppable

# The command line imports this module first. To keep this import fast, functions import other modules.

LONGEST_WAIT = 10.0
"""Seconds allowed for motors to decelerate.

A motor that is still moving after this time is stopped immediately.
"""
SIGNALS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name)
)
"""Signals that `stop_on_signals` handles, as far as this operating system has them."""
NO_MOTION = "nothing was moving"
"""Beginning of the result of `stop_motors` if no motor was moving."""
NOT_KNOWN = "not known whether a motor moves"
"""Beginning of the result of `stop_motors` if a part does not answer and no motor was stopped."""
arrived: list[int] = []
"""Signals that the command line received before it opened a board.

A handler stores them here and raises an exception, but Python may ignore this exception.
"""


class Signalled(SystemExit):
    """A signal ends the program.

    Args:
        number: number of the signal; the exit status is 128 + number.
    """

    def __init__(self, number: int) -> None:
        super().__init__(128 + number)
        self.number = number


def name_of(number: int) -> str:
    """Return the usual name of the signal with this number.

    >>> name_of(2), name_of(15)
    ('interrupted', 'SIGTERM')
    """
    return "interrupted" if number == signal.SIGINT else signal.Signals(number).name


@contextmanager
def handled(handler: Callable[[int, FrameType | None], Any]) -> Iterator[None]:
    """Handle SIGNALS with a function inside the block.

    SIGTERM and SIGHUP that are ignored (nohup) stay ignored.

    Outside the main thread, the context manager has no effect.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {}
    try:
        for number in SIGNALS:
            if number == signal.SIGINT or signal.getsignal(number) != signal.SIG_IGN:
                before[number] = signal.signal(number, handler)
        yield
    finally:
        for number, old in before.items():
            signal.signal(number, signal.SIG_DFL if old is None else old)


def stop_motors(
    devices: Sequence[Device],
    seconds: float = LONGEST_WAIT,
    stop_now: Callable[[], bool] = lambda: False,
    every: bool = False,
) -> str:
    """Decelerate the motors of devices, wait until they stop, and return one line for the user.

    This line also reports errors.

    Args:
        seconds: longest wait; motors that still move after it are stopped immediately.
        stop_now: called about ten times a second; if it returns True, the motors are stopped immediately.
        every: True to stop all motions, False to stop only motions that these objects started.
    """
    from .errors import AlreadyDecelerating, NothingToStop, NotInitialised, PpmcError, Timeout

    axes: list[Stoppable] = [axis for device in devices for axis in device.axes]
    moving: list[tuple[Device, Stoppable]] = []
    how, errors, halted = NO_MOTION, [], False

    def halt() -> None:
        nonlocal halted, how
        if not halted:
            halted, how = True, "stopped immediately"
            for _, axis in moving:
                with suppress(PpmcError):
                    axis.halt(wait=False)

    def check(now: Progress) -> None:
        if stop_now():
            halt()

    for device in devices:
        for axis in device.axes:
            try:
                motion = axis.motion
                if not every and (motion is None or motion.over or motion.poll() is None):
                    continue
                with suppress(AlreadyDecelerating):
                    axis.stop(wait=False)
                moving.append((device, axis))
                how = "stopped"
            except (NothingToStop, NotInitialised):
                pass
            except PpmcError as error:
                errors.append(str(error))
    ends = {id(device): device.link.clock() + seconds for device in devices}
    for device, axis in moving:
        if axis.motion is None:
            continue
        try:
            axis.motion.wait(max(0.1, ends[id(device)] - device.link.clock()), check)
        except Timeout:
            halt()
            how = f"stopped immediately after {seconds:g} s"
        except PpmcError as error:
            errors.append(str(error))
    if errors and how == NO_MOTION:
        how = NOT_KNOWN
    with suppress(PpmcError):
        errors[:0] = [f"{axis._message_prefix}position {axis.position}" for axis in axes]
    return ", ".join([how, *errors])


def print_line(line: str) -> None:
    """Print one line on stderr; ignore a closed terminal."""
    try:
        print(line, file=sys.stderr, flush=True)
    except OSError:
        with suppress(OSError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            for number in (1, 2):
                os.dup2(nowhere, number)


@contextmanager
def stop_on_signals(*devices: Device, seconds: float = LONGEST_WAIT) -> Iterator[None]:
    """Stop the motors when SIGINT, SIGTERM or SIGHUP ends the program inside the block.

    The first signal raises Signalled, a SystemExit, which leaves the block. Then the motors decelerate; a
    motor that still moves after `seconds` is stopped immediately. One line is printed on stderr, and the
    program exits with status 128 + the number of the signal. The second signal stops the motors immediately;
    the third signal ends the program without waiting. A signal that was ignored before (nohup) stays ignored.

        with Ppmc104.open("/dev/ttyUSB0") as axis, stop_on_signals(axis):
            axis.move(100_000)

    Args:
        devices: open parts, banks or lines; all their axes are stopped.
        seconds: longest deceleration, more than 0.

    Raises:
        OutOfRange: the caller is not in the main thread, or `seconds` is not positive.
    """
    from .check import exact
    from .errors import OutOfRange

    if exact(seconds, "seconds") <= 0:
        raise OutOfRange(f"seconds {seconds} is not more than 0")
    if threading.current_thread() is not threading.main_thread():
        raise OutOfRange("signals reach the main thread only: use stop_on_signals there")
    resting, later = False, 0

    def handler(number: int, frame: FrameType | None) -> None:
        nonlocal later
        if not resting:
            raise Signalled(number)
        later += 1
        if later > 1:
            os._exit(128 + number)

    with handled(handler):
        try:
            yield
        except Signalled as stop:
            resting = True
            print_line(
                f"{name_of(stop.number)}: {stop_motors(devices, seconds, lambda: later > 0, every=True)}"
            )
            raise
