"""A line of PPMC-312 while a command talks to it, and what its options mean."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import typer
from serial.rs485 import RS485Settings

from ..host import Ppmc312Bus, Station312
from ..host.ascii312 import STATIONS, SumMode
from . import show
from .guard import Guard, Interrupted
from .session import BOARD, INTERRUPTED

LINE_WORDS = "echo, rs485, rts=high, rts=low, sum=binary, sum=chars, patience=SECONDS, xtal=HZ"


def parse_stations(text: str) -> list[int]:
    """`3`, `0,2,5` or `0-7`, in the order given. BadParameter."""
    numbers: list[int] = []
    for piece in text.split(","):
        first, dash, last = piece.strip().partition("-")
        try:
            ends = int(first), int(last if dash else first)
        except ValueError:
            raise typer.BadParameter(f"--axis {text!r}: stations are 3, 0,2,5 or 0-7") from None
        if not 0 <= ends[0] <= ends[1] < STATIONS:
            raise typer.BadParameter(f"--axis {text!r}: stations have numbers from 0 to {STATIONS - 1}")
        numbers += [number for number in range(ends[0], ends[1] + 1) if number not in numbers]
    return numbers


def line_options(text: str) -> dict[str, Any]:
    """Arguments of `Ppmc312Bus.open` from the text of --line. BadParameter."""
    options: dict[str, Any] = {}
    for item in filter(None, (piece.strip().lower() for piece in text.split(","))):
        word, _, value = item.partition("=")
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
            raise typer.BadParameter(f"--line {item!r}: there are {LINE_WORDS}")
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


@contextmanager
def opened_bus() -> Iterator[BusSession]:
    """The line, and Ctrl-C under control: it brings the motors to rest and ends with status 130."""
    options = line_options(BOARD.line)
    if BOARD.baud is not None:
        options["speed"] = BOARD.baud
    with Guard() as guard, Ppmc312Bus.open(BOARD.port, **options) as bus:
        try:
            guard.check()
            yield BusSession(bus, guard)
        except Interrupted:
            show.note(guard.bring_to_rest(bus))
            raise typer.Exit(INTERRUPTED) from None
        finally:
            guard.bar_off()
