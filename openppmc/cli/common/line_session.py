"""Serial line with stations that a command has opened, and options of the line."""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

import typer

from ...host.line import LineBus
from ...host.motion import Progress
from ...host.part import Stoppable
from .session import Guard

Bus = TypeVar("Bus", bound=LineBus[Any, Any])


def parse_numbers(option: str, text: str, known: Container[int], span: str, example: str) -> list[int]:
    """Return the numbers of a list with ranges, in the order of the list.

    Raise BadParameter if the list is invalid.

    Args:
        known: the allowed numbers.
        span: text about the allowed numbers for messages. It begins with the name of the numbered objects.
    """
    numbers: list[int] = []
    for piece in text.split(","):
        first, dash, last = piece.strip().partition("-")
        try:
            ends = int(first), int(last if dash else first)
        except ValueError:
            what = span.partition(" ")[0]
            raise typer.BadParameter(
                f"{option} {text!r}: not a list of {what}; write 3, 0,2,5 or {example}"
            ) from None
        if ends[0] not in known or ends[1] not in known or ends[0] > ends[1]:
            raise typer.BadParameter(f"{option} {text!r}: {span}")
        numbers += [number for number in range(ends[0], ends[1] + 1) if number not in numbers]
    return numbers


def line_options(text: str, known: str) -> dict[str, Any]:
    """Return arguments for the method `open` of a bus, from the text of --line.

    Raise BadParameter if the text is invalid.

    The argument `sum_mode` is returned as text.

    Args:
        known: option names that this kind of line supports.
    """
    options: dict[str, Any] = {}
    for item in filter(None, (piece.strip().lower() for piece in text.split(","))):
        word, _, value = item.partition("=")
        if not re.search(rf"\b{re.escape(word)}\b", known):
            raise typer.BadParameter(f"--line {item!r}: there are {known}")
        if item == "echo":
            options["echo"] = True
        elif item in ("rs485", "rts=high", "rts=low"):
            from serial.rs485 import RS485Settings

            level = item != "rts=low"
            options["rs485"] = RS485Settings(rts_level_for_tx=level, rts_level_for_rx=not level)
        elif item in ("sum=binary", "sum=chars"):
            options["sum_mode"] = value
        elif word in ("patience", "xtal"):
            options["patience" if word == "patience" else "xtal_hz"] = _number(word, value)
        else:
            raise typer.BadParameter(f"--line {item!r}: there are {known}")
    return options


def _number(word: str, value: str) -> float | int:
    try:
        return float(value) if word == "patience" else int(float(value))
    except (ValueError, OverflowError):
        raise typer.BadParameter(f"--line {word}={value}: not a number") from None


def ending_after(
    seconds: float | None, bus: LineBus[Any, Any], guard: Guard, stations: Sequence[Stoppable]
) -> Callable[[Progress], None]:
    """Return a progress callback.

    The callback shows a bar, and decelerates the stations when the time limit has passed.

    Args:
        seconds: time limit, measured with the clock of the line; None for no limit.
    """
    clock = bus.line.clock
    end_at = None if seconds is None else clock() + seconds

    def check(now: Progress) -> None:
        nonlocal end_at
        guard.progress(now)
        if end_at is not None and clock() >= end_at:
            end_at = None
            for station in stations:
                if station.motion is not None and not station.motion.over:
                    station.stop(wait=False)

    return check


@contextmanager
def guarded(make: Callable[[], Bus]) -> Iterator[tuple[Bus, Guard]]:
    """Open a line with `make`. A signal n stops the motors, and the exit status is then 128 + n.

    The motors are also stopped if stdout is lost.
    """
    with make() as bus, Guard() as guard, guard.stop_motors_on_exit(bus):
        yield bus, guard
