"""A line of PPMC-312 while a command talks to it, and what its options mean."""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TypeVar

import typer
from serial.rs485 import RS485Settings

from ....host import Ppmc312Bus, Station312
from ....host.axis.motion import Progress
from ....host.line.bus import LineBus
from ....host.ppmc312.line.ascii import STATIONS, SumMode
from ...common import show
from ...common.guard import Guard, Interrupted
from ...common.session import BOARD, INTERRUPTED

Bus = TypeVar("Bus", bound=LineBus)
LINE_WORDS = "echo, rs485, rts=high, rts=low, sum=binary, sum=chars, patience=SECONDS, xtal=HZ"


def parse_stations(text: str) -> list[int]:
    """`3`, `0,2,5` or `0-7`, in the order given. BadParameter."""
    last = STATIONS - 1
    return parse_numbers("--axis", text, range(STATIONS), f"stations have numbers from 0 to {last}", "0-7")


def parse_numbers(option: str, text: str, known: Container[int], span: str, example: str) -> list[int]:
    """Numbers and ranges, in the order given. known: what they may be; span: the same in words, beginning
    with what they number. BadParameter."""
    numbers: list[int] = []
    for piece in text.split(","):
        first, dash, last = piece.strip().partition("-")
        try:
            ends = int(first), int(last if dash else first)
        except ValueError:
            what = span.partition(" ")[0]
            raise typer.BadParameter(f"{option} {text!r}: {what} are 3, 0,2,5 or {example}") from None
        if ends[0] not in known or ends[1] not in known or ends[0] > ends[1]:
            raise typer.BadParameter(f"{option} {text!r}: {span}")
        numbers += [number for number in range(ends[0], ends[1] + 1) if number not in numbers]
    return numbers


def line_options(text: str, known: str = LINE_WORDS) -> dict[str, Any]:
    """Arguments of a bus's `open` from the text of --line. known: words that it may have. BadParameter."""
    options: dict[str, Any] = {}
    for item in filter(None, (piece.strip().lower() for piece in text.split(","))):
        word, _, value = item.partition("=")
        if not re.search(rf"\b{re.escape(word)}\b", known):
            raise typer.BadParameter(f"--line {item!r}: there are {known}")
        if item == "echo":
            options["echo"] = True
        elif item in ("rs485", "rts=high"):
            options["rs485"] = RS485Settings(rts_level_for_tx=True, rts_level_for_rx=False)
        elif item == "rts=low":
            options["rs485"] = RS485Settings(rts_level_for_tx=False, rts_level_for_rx=True)
        elif item in ("sum=binary", "sum=chars"):
            options["sum_mode"] = SumMode(value)
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


@dataclass
class BusSession:
    """An open line."""

    bus: Ppmc312Bus
    guard: Guard

    def chosen(self, text: str | None) -> list[Station312]:
        """The stations that --axis names (they must answer); without it, all that answer."""
        if text is not None:
            numbers = parse_stations(text)
            self.bus.check(numbers)
        else:
            numbers = [one.station for one in self.bus.scan(progress=self._scanning)]
            self.guard.bar_off()
        return [self.bus.axis(number) for number in numbers]

    def _scanning(self, number: int) -> None:
        self.guard.check()
        self.guard.count_bar("looking for stations", number, STATIONS)

    def scan(self) -> list[Any]:
        """Who is there, with a bar where it takes long."""
        found = self.bus.scan(progress=self._scanning)
        self.guard.bar_off()
        return found


def check_seconds(seconds: float | None) -> None:
    """BadParameter for a value of --seconds that is no time."""
    if seconds is not None and not 0 <= seconds < float("inf"):
        raise typer.BadParameter(f"--seconds {seconds:g} is not a time from 0 on")


def ending_after(
    seconds: float | None, bus: LineBus, guard: Guard, axes: Sequence[Any]
) -> Callable[[Progress], None]:
    """A progress callback that shows a bar and brakes after so many seconds of the line's time."""
    clock = bus.line.clock
    end_at = None if seconds is None else clock() + seconds

    def look(now: Progress) -> None:
        nonlocal end_at
        guard.progress(now)
        if end_at is not None and clock() >= end_at:
            end_at = None
            for axis in axes:
                axis.brake()

    return look


@contextmanager
def opened_bus() -> Iterator[BusSession]:
    """The line, and Ctrl-C under control: it brings the motors to rest and ends with status 130."""
    options = line_options(BOARD.line)
    if BOARD.baud is not None:
        options["speed"] = BOARD.baud
    with guarded(lambda: Ppmc312Bus.open(BOARD.port, **options)) as (bus, guard):
        yield BusSession(bus, guard)


@contextmanager
def guarded(make: Callable[[], Bus]) -> Iterator[tuple[Bus, Guard]]:
    """A line that `make` opens, and Ctrl-C under control."""
    with Guard() as guard, make() as bus:
        try:
            guard.check()
            yield bus, guard
        except Interrupted:
            show.note(guard.bring_to_rest(bus))
            raise typer.Exit(INTERRUPTED) from None
        finally:
            guard.bar_off()
