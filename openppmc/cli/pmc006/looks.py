"""Commands that look at PMC006B4 and set them up."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from ...host import OutOfRange, Pmc006, PpmcError
from ...host.pmc006.settings import setting
from ..common import output
from ..common.options import Json
from ..common.watching import Count, Every, watch
from . import show
from .session import Address, opened

if TYPE_CHECKING:
    from rich.table import Table

# ---------------------------------------------------------------------- who is there


def scan(as_json: Json = False) -> None:
    """Who is on the line: 255, then 1 to 120."""
    with opened() as session:
        found = session.scan()
    if as_json:
        output.print_json(show.found_values(found))
    elif found:
        output.console.print(show.found_table(found))
        for one in found:
            if one.trouble:
                output.say(one.trouble)
    else:
        raise PpmcError(
            f"{session.bus.line.name}: no controller replies: are they powered, are baud rate and the wires "
            "right?"
        )


def info(address: Address = None, as_json: Json = False) -> None:
    """Firmware and all settings of a controller; a star: kept by `save`."""
    with opened() as session:
        part = session.one(address)
        version, values = part.version(), show.settings_values(part)
        number = part.address
    if as_json:
        output.print_json({"address": number, "version": version, "settings": values})
    else:
        output.say(f"PMC006B4 at address {number}, firmware {version}")
        _settings(values)


def status(address: Address = None, as_json: Json = False) -> None:
    """Position, state, stops, inputs, outputs. Disturbs nothing."""
    with opened() as session:
        values = [show.status_values(part) for part in session.chosen(address)]
    if as_json:
        output.print_json(values if len(values) > 1 else values[0])
        return
    for one in values:
        output.console.print(output.table(show.status_rows(one)))


def monitor(address: Address = None, count: Count = None, every: Every = 0.2) -> None:
    """Watch position, state and stops until Ctrl-C."""
    with opened() as session:
        parts = session.chosen(address)

        def lines() -> Iterator[str]:
            for part in parts:
                session.guard.check()
                yield "  ".join(f"{name} {text}" for name, text in _row(part).items())

        watch(count, lambda: session.guard.pause(session.bus, every), lines, lambda: _table(parts))


def _row(part: Pmc006) -> dict[str, str]:
    return show.status_rows(show.status_values(part))


def _table(parts: Iterable[Pmc006]) -> Table:
    return output.grid({f"controller {part.address}": _row(part) for part in parts})


# ---------------------------------------------------------------------- settings


def set_values(
    values: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME=VALUE|NAME]…", help="none: tell all")
    ] = None,
    address: Address = None,
) -> None:
    """Change settings, or tell them: `set current=1500 microsteps=32`. `save` keeps them."""
    wanted = [_assignment(text) for text in values or ()]
    with opened() as session:
        for part in session.chosen(address):
            session.guard.check()
            for name, value in wanted:
                if value is not None:
                    setattr(part, name, value)
            names = [name for name, _ in wanted]
            known = show.settings_values(part, names) if names else show.settings_values(part)
            if part.who:
                output.say(part.who.rstrip(": "))
            _settings(known)


def _settings(values: dict[str, int]) -> None:
    output.print_rows(show.settings_rows(values), "<><<<<")


def _assignment(text: str) -> tuple[str, int | None]:
    name, equals, value = (piece.strip() for piece in text.partition("="))
    try:
        known = setting(name).name
    except OutOfRange as error:
        raise typer.BadParameter(str(error)) from None
    try:
        return known, int(value, 0) if equals else None
    except ValueError:
        raise typer.BadParameter(f"{text}: not a whole number") from None


def io(
    values: Annotated[list[str] | None, typer.Argument(metavar="[gpoN=0|1]…", help="none: only look")] = None,
    address: Address = None,
    as_json: Json = False,
) -> None:
    """Inputs and outputs: `io gpo1=1 gpo3=0` switches outputs."""
    levels = [_output(text) for text in values or ()]
    with opened() as session:
        for part in session.chosen(address):
            for number, on in levels:
                part.set_output(number, on)
            pins = show.io_values(part)
            if as_json:
                output.print_json(pins)
            else:
                words = (f"{name.upper()} {level}" for name, level in pins.items())
                output.say(part.who + "  ".join(words))


def _output(text: str) -> tuple[int, bool]:
    name, _, level = text.lower().replace(" ", "").partition("=")
    if name not in {f"gpo{number}" for number in range(1, 6)} or level not in ("0", "1"):
        raise typer.BadParameter(f"{text}: write gpo1=0 … gpo5=1")
    return int(name[3:]), level == "1"


def address(
    new: Annotated[int, typer.Argument(metavar="NEW", help="1 to 120")], address: Address = None
) -> None:
    """Give a controller another address, at once; `save` keeps it."""
    with opened() as session:
        part = session.one(address)
        before = part.address
        part.set_address(new)
        output.say(f"controller {before} has address {new} now")


def save(address: Address = None) -> None:
    """Keep the settings for the next power-up (those with a star in `info`)."""
    with opened() as session:
        for part in session.chosen(address):
            part.save()
            output.say(f"{part.who}saved")


def reset_flags(address: Address = None) -> None:
    """Clear the flags of EXT1, EXT2 and a stall, so that motors may start again. Nothing moves."""
    with opened() as session:
        for part in session.chosen(address):
            part.clear_stops()
            part.clear_stall()
            output.say(f"{part.who}flags cleared")
