"""`monitor`: the same look again and again, until Ctrl-C."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Annotated

import typer

from . import output

if TYPE_CHECKING:
    from rich.table import Table

Count = Annotated[int | None, typer.Option(min=1, metavar="N", help="end after N looks")]
Every = Annotated[float, typer.Option(min=0.05, max=3600, metavar="S", help="seconds between looks")]


def watch(
    count: int | None,
    pause: Callable[[], None],
    lines: Callable[[], Iterable[str]],
    table: Callable[[], Table],
) -> None:
    """A table that changes on a terminal, else `lines` of each look; `pause` comes between two looks."""
    turns = count or 10**9
    if not output.console.is_terminal:
        for turn in range(turns):
            if turn:
                pause()
            for line in lines():
                output.say(line)
        return
    from rich.live import Live

    with Live(table(), console=output.console, auto_refresh=False) as live:
        for _ in range(turns - 1):
            pause()
            live.update(table(), refresh=True)
