"""The commands for PMC006B4: `openppmc --part pmc006 …`."""

from __future__ import annotations

from typing import Annotated

import typer

from ...host import OutOfRange, PpmcError
from ...host.pmc006.settings import setting
from ..common import show
from . import show as show006
from .moves import app006
from .program import program
from .session import Address, opened006

app006.add_typer(program, name="program")
Json = Annotated[bool, typer.Option("--json", help="for programs")]


# ---------------------------------------------------------------------- who is there


@app006.command()
def scan(as_json: Json = False) -> None:
    """Who is on the line: 255, then 1 to 120."""
    with opened006() as session:
        found = session.scan()
    if as_json:
        show.print_json(show006.found_values(found))
    elif found:
        show.out.print(show006.found_table(found))
        for one in found:
            if one.trouble:
                show.say(one.trouble)
    else:
        raise PpmcError(
            f"{session.bus.line.name}: no controller replies: are they powered, are baud rate and the wires "
            "right?"
        )


@app006.command()
def info(address: Address = None, as_json: Json = False) -> None:
    """Firmware and all settings of a controller; a star: kept by `save`."""
    with opened006() as session:
        part = session.one(address)
        version, values = part.version(), show006.settings_values(part)
        number = part.address
    if as_json:
        show.print_json({"address": number, "version": version, "settings": values})
    else:
        show.say(f"PMC006B4 at address {number}, firmware {version}")
        _settings(values)


@app006.command()
def status(address: Address = None, as_json: Json = False) -> None:
    """Position, state, stops, inputs, outputs. Disturbs nothing."""
    with opened006() as session:
        values = [show006.status_values(part) for part in session.chosen(address)]
    if as_json:
        show.print_json(values if len(values) > 1 else values[0])
        return
    for one in values:
        show.out.print(show.table(show006.status_rows(one)))


# ---------------------------------------------------------------------- settings


@app006.command("set")
def set_values(
    values: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME=VALUE|NAME]…", help="none: tell all")
    ] = None,
    address: Address = None,
) -> None:
    """Change settings, or tell them: `set current=1500 microsteps=32`. `save` keeps them."""
    wanted = [_assignment(text) for text in values or ()]
    with opened006() as session:
        for part in session.chosen(address):
            session.guard.check()
            for name, value in wanted:
                if value is not None:
                    setattr(part, name, value)
            names = [name for name, _ in wanted]
            known = show006.settings_values(part, names) if names else show006.settings_values(part)
            if part.who:
                show.say(part.who.rstrip(": "))
            _settings(known)


def _settings(values: dict[str, int]) -> None:
    for line in show006.settings_lines(values):
        show.say(line)


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


@app006.command()
def io(
    values: Annotated[list[str] | None, typer.Argument(metavar="[gpoN=0|1]…", help="none: only look")] = None,
    address: Address = None,
    as_json: Json = False,
) -> None:
    """Inputs and outputs: `io gpo1=1 gpo3=0` switches outputs."""
    levels = [_output(text) for text in values or ()]
    with opened006() as session:
        for part in session.chosen(address):
            for number, on in levels:
                part.set_output(number, on)
            pins = show006.io_values(part)
            if as_json:
                show.print_json(pins)
            else:
                words = (f"{name.upper()} {level}" for name, level in pins.items())
                show.say(part.who + "  ".join(words))


def _output(text: str) -> tuple[int, bool]:
    name, _, level = text.lower().replace(" ", "").partition("=")
    if name not in {f"gpo{number}" for number in range(1, 6)} or level not in ("0", "1"):
        raise typer.BadParameter(f"{text}: write gpo1=0 … gpo5=1")
    return int(name[3:]), level == "1"


@app006.command()
def address(
    new: Annotated[int, typer.Argument(metavar="NEW", help="1 to 120")], address: Address = None
) -> None:
    """Give a controller another address, at once; `save` keeps it."""
    with opened006() as session:
        part = session.one(address)
        before = part.address
        part.set_address(new)
        show.say(f"controller {before} has address {new} now")


@app006.command()
def save(address: Address = None) -> None:
    """Keep the settings for the next power-up (those with a star in `info`)."""
    with opened006() as session:
        for part in session.chosen(address):
            part.save()
            show.say(f"{part.who}saved")


@app006.command("reset-flags")
def reset_flags(address: Address = None) -> None:
    """Clear the flags of EXT1, EXT2 and a stall, so that motors may start again. Nothing moves."""
    with opened006() as session:
        for part in session.chosen(address):
            part.clear_stops()
            part.clear_stall()
            show.say(f"{part.who}flags cleared")
