"""A line of PMC006B4 while a command talks to it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Annotated

import typer

from ...host import Pmc006, Pmc006Bus
from ...host.pmc006.part import Found, find
from ...host.pmc006.wire import ADDRESSES, FACTORY, LAST
from ..common.board import BOARD
from ..common.guard import Guard
from ..common.line_session import guarded, line_options, parse_numbers

LINE_WORDS = "rs485, rts=high, rts=low, patience=SECONDS"
Address = Annotated[
    str | None,
    typer.Option(
        "--address",
        "-a",
        metavar="N",
        envvar="OPENPPMC_ADDRESS",
        help="pmc006: controllers, as 3 or 1,5 or 1-4 (the first that answers)",
    ),
]


def parse_addresses(text: str) -> list[int]:
    """`3`, `1,5` or `1-4`. BadParameter."""
    span = f"addresses are 1 to {LAST}, factory-new controllers have {FACTORY}"
    return parse_numbers("--address", text, ADDRESSES, span, "1-4")


@dataclass
class Session:
    """An open line."""

    bus: Pmc006Bus
    guard: Guard

    def chosen(self, text: str | None) -> list[Pmc006]:
        """The controllers that --address names; without it, the first that answers."""
        if text is None:
            numbers = [find(self.bus.line, self._scanning)]
            self.guard.bar_off()
        else:
            numbers = parse_addresses(text)
            self.bus.check(numbers)
        parts = [self.bus.axis(number) for number in numbers]
        for part in parts:
            part.alone = len(parts) == 1
        return parts

    def one(self, text: str | None) -> Pmc006:
        """The only one. BadParameter for several."""
        if text is not None and len(parse_addresses(text)) > 1:
            raise typer.BadParameter(f"--address {text!r}: this is for one controller at a time")
        return self.chosen(text)[0]

    def scan(self) -> list[Found]:
        """Who is there."""
        found = self.bus.scan(progress=self._scanning)
        self.guard.bar_off()
        return found

    def _scanning(self, address: int) -> None:
        self.guard.check()
        self.guard.count_bar("looking for controllers", ADDRESSES.index(address), len(ADDRESSES))

    def counting(self, done: int, of: int) -> None:
        """Progress of a download."""
        self.guard.check()
        self.guard.count_bar("words of the program", done, of)


@contextmanager
def opened() -> Iterator[Session]:
    """The line, and Ctrl-C under control: it brings the motors to rest and ends with status 130."""
    options = line_options(BOARD.line, LINE_WORDS)
    if BOARD.baud is not None:
        options["baud"] = BOARD.baud
    with guarded(lambda: Pmc006Bus.open(BOARD.port, **options)) as (bus, guard):
        yield Session(bus, guard)
