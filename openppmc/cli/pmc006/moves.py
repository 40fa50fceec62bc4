"""Commands that move motors with PMC006B4, read its state, or set it up."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import Enum
from typing import TYPE_CHECKING, Annotated

import typer

from ...host import BACKWARD, FORWARD, OutOfRange, Pmc006, PpmcError
from ...host.axis import OnProgress
from ...host.pmc006.motion import Motion
from ...host.pmc006.settings import setting
from ..common import output
from ..common.hal import Axes, Name, serve_line
from ..common.ioc import Prefix, check_prefix, serve, with_units
from ..common.line_session import ending_after
from ..common.options import Json, check_seconds
from ..common.show import Count, Every, watch
from .session import (
    Address,
    Session,
    end_line,
    found_table,
    found_values,
    io_values,
    open_bus,
    opened,
    parse_addresses,
    prefix,
    settings_rows,
    settings_values,
    status_rows,
    status_values,
)

if TYPE_CHECKING:
    from rich.table import Table

Speed = Annotated[int | None, typer.Option(metavar="PPS", help="new max_speed, in steps/s")]


class Direction(str, Enum):
    """Directions as users type them."""

    FORWARD = "forward"
    BACKWARD = "backward"

    @property
    def sign(self) -> int:
        """Sign of the direction: 1 for forward, -1 for backward."""
        return FORWARD if self is Direction.FORWARD else BACKWARD


def move(
    steps: Annotated[int, typer.Argument(help="steps, forward positive; with --to a position")],
    address: Address = None,
    to: Annotated[bool, typer.Option("--to", help="move to this position")] = False,
    speed: Speed = None,
) -> None:
    """Move controllers by STEPS, all at the same time."""
    with opened() as session:
        motions = []
        for part in session.selected_axes(address):
            session.guard.check()
            away = steps - part.position if to else steps
            if away:
                motions.append(part.start_move(away, speed))
            else:
                output.print_line(end_line(part.move(0)))
        _finish(session, motions, True)


def jog(
    direction: Annotated[Direction, typer.Argument(help="direction of rotation")],
    address: Address = None,
    speed: Speed = None,
    seconds: Annotated[float | None, typer.Option(metavar="S", help="stop after this time")] = None,
) -> None:
    """Run until Ctrl-C, an EXT stop or a stall."""
    check_seconds(seconds)
    with opened() as session:
        parts = session.selected_axes(address)
        motions = [part.jog(direction.sign, speed) for part in parts]
        _finish(session, motions, False, ending_after(seconds, session.bus, session.guard, parts))


def _finish(session: Session, motions: list[Motion], judge: bool, look: OnProgress | None = None) -> None:
    """Wait for all motions and print their results.

    Args:
        judge: True to raise an error for the first motion that ended early.
    """
    ends = session.bus.wait(motions, progress=look or session.guard.progress)
    session.guard.bar_off()
    for end in ends:
        output.print_line(end_line(end))
    for motion, end in zip(motions, ends, strict=True):
        if judge:
            end.check(motion.requested)


def speed(
    pps: Annotated[int, typer.Argument(help="steps/s, forward positive; 0 stops")], address: Address = None
) -> None:
    """Start motors at this speed and return. `stop` stops them."""
    with opened() as session:
        for part in session.selected_axes(address):
            session.guard.check()
            if pps == 0 or not _goes(part, pps):
                if part.flags().busy:
                    part.stop()
                if pps:
                    part.jog(FORWARD if pps > 0 else BACKWARD, abs(pps))
            state = f"runs at {pps} steps/s" if pps else f"position {part.position}: stopped"
            output.print_line(prefix(part) + state)


def _goes(part: Pmc006, pps: int) -> bool:
    """If the motor already runs in this direction, change its speed and return True; else return False."""
    modes = part.modes()
    if not modes.running or modes.forward != (pps > 0):
        return False
    part.change_speed(abs(pps))
    return True


def stop(
    address: Address = None,
    now: Annotated[bool, typer.Option("--now", help="stop immediately, without a ramp")] = False,
) -> None:
    """Stop motors that are still running."""
    with opened() as session:
        ends = session.bus.stop([part.address for part in session.selected_axes(address)], now)
        for end in ends:
            output.print_line(end_line(end))
        if not ends:
            output.print_line("nothing was moving")


def home(
    address: Address = None,
    switch: Annotated[int, typer.Option(min=1, max=2, metavar="N", help="EXT1 or EXT2")] = 1,
    direction: Annotated[Direction, typer.Option(help="towards the switch")] = Direction.BACKWARD,
    speed: Annotated[
        int, typer.Option(metavar="PPS", help="speed of the first approach to the switch")
    ] = 1000,
    slow: Annotated[int, typer.Option(metavar="PPS", help="speed of the second approach")] = 200,
    off: Annotated[int, typer.Option(metavar="STEPS", help="distance from the switch to position 0")] = 100,
) -> None:
    """Find a switch, move off it and set the position to 0; one controller after the other."""
    with opened() as session:
        for part in session.selected_axes(address):
            part.home(switch, direction.sign, speed, slow, off, session.guard.progress)
            session.guard.bar_off()
            output.print_line(
                f"{prefix(part)}position {part.position}: {off} steps from the edge of EXT{switch}"
            )


@with_units
def ioc(units: dict[str, str], prefix: Prefix, address: Address = None) -> None:
    """Serve a motor record for each controller to EPICS clients."""
    check_prefix(prefix)
    with opened() as session:
        parts = session.selected_axes(address)
        requests = dict.fromkeys((part.address for part in parts), None)
        serve(session.bus, session.guard, prefix, units, requests, open_bus)


def hal(axes: Axes = None, name: Name = "openppmc") -> None:
    """Serve axes as a component of LinuxCNC's HAL, loaded by loadusr -W."""
    serve_line(name, None if axes is None else parse_addresses(axes), open_bus, lambda number: None)


# ---------------------------------------------------------------------- scan and status


def scan(as_json: Json = False) -> None:
    """List the controllers on the line: address 255, then 1 to 120."""
    with opened() as session:
        found = session.scan()
    if as_json:
        output.print_json(found_values(found))
    elif found:
        output.console.print(found_table(found))
        for one in found:
            if one.problem:
                output.print_line(one.problem)
    else:
        raise PpmcError(f"{session.bus.line.name}: no controller replies; check power, baud rate and wires")


def info(address: Address = None, as_json: Json = False) -> None:
    """Print firmware and settings of a controller. `save` stores those with a star."""
    with opened() as session:
        part = session.one(address)
        version, values = part.version(), settings_values(part)
        number = part.address
    if as_json:
        output.print_json({"address": number, "version": version, "settings": values})
    else:
        output.print_line(f"PMC006B4 at address {number}, firmware {version}")
        _settings(values)


def status(address: Address = None, as_json: Json = False) -> None:
    """Print position, state, stops, inputs and outputs without side effects."""
    with opened() as session:
        values = [status_values(part) for part in session.selected_axes(address)]
    if as_json:
        output.print_json(values if len(values) > 1 else values[0])
        return
    for one in values:
        output.console.print(output.table(status_rows(one)))


def monitor(address: Address = None, count: Count = None, every: Every = 0.2) -> None:
    """Show position, state and stops until Ctrl-C."""
    with opened() as session:
        parts = session.selected_axes(address)

        def lines() -> Iterator[str]:
            for part in parts:
                session.guard.check()
                yield "  ".join(f"{name} {text}" for name, text in _row(part).items())

        watch(count, lambda: session.guard.pause(session.bus, every), lines, lambda: _table(parts))


def _row(part: Pmc006) -> dict[str, str]:
    return status_rows(status_values(part))


def _table(parts: Iterable[Pmc006]) -> Table:
    return output.grid({f"controller {part.address}": _row(part) for part in parts})


# ---------------------------------------------------------------------- settings


def set_values(
    values: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME=VALUE|NAME]…", help="without argument: print all")
    ] = None,
    address: Address = None,
) -> None:
    """Change or print settings: `set current=1500 microsteps=32`. `save` stores them."""
    assignments = [_assignment(text) for text in values or ()]
    with opened() as session:
        for part in session.selected_axes(address):
            session.guard.check()
            for name, value in assignments:
                if value is not None:
                    setattr(part, name, value)
            names = [name for name, _ in assignments]
            known = settings_values(part, names) if names else settings_values(part)
            if prefix(part):
                output.print_line(prefix(part).rstrip(": "))
            _settings(known)


def _settings(values: dict[str, int]) -> None:
    output.print_rows(settings_rows(values), "<><<<<")


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
    values: Annotated[
        list[str] | None, typer.Argument(metavar="[gpoN=0|1]…", help="without argument: only read")
    ] = None,
    address: Address = None,
    as_json: Json = False,
) -> None:
    """Print inputs and outputs; `io gpo1=1 gpo3=0` sets outputs."""
    levels = [_output(text) for text in values or ()]
    with opened() as session:
        for part in session.selected_axes(address):
            for number, on in levels:
                part.set_output(number, on)
            pins = io_values(part)
            if as_json:
                output.print_json(pins)
            else:
                words = (f"{name.upper()} {level}" for name, level in pins.items())
                output.print_line(prefix(part) + "  ".join(words))


def _output(text: str) -> tuple[int, bool]:
    name, _, level = text.lower().replace(" ", "").partition("=")
    if name not in {f"gpo{number}" for number in range(1, 6)} or level not in ("0", "1"):
        raise typer.BadParameter(f"{text}: not an output level; write gpo1=0 … gpo5=1")
    return int(name[3:]), level == "1"


def address(
    new: Annotated[int, typer.Argument(metavar="NEW", help="new address, 1 to 120")], address: Address = None
) -> None:
    """Change the address of a controller immediately. `save` stores it."""
    with opened() as session:
        part = session.one(address)
        before = part.address
        part.set_address(new)
        output.print_line(f"controller {before} has address {new} now")


def save(address: Address = None) -> None:
    """Store the settings with a star in `info` for the next power-up."""
    with opened() as session:
        for part in session.selected_axes(address):
            part.save()
            output.print_line(f"{prefix(part)}saved")


def reset_flags(address: Address = None) -> None:
    """Clear the flags of EXT1, EXT2 and stall, so that motors can start. Nothing moves."""
    with opened() as session:
        for part in session.selected_axes(address):
            part.clear_stops()
            part.clear_stall()
            output.print_line(f"{prefix(part)}flags cleared")
