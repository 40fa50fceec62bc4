"""Commands for a line of PPMC-312 in serial mode: `openppmc --part ppmc312-serial …`."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from ....host import PpmcError, Station312
from ...common import output, show
from ...common.board import BOARD
from ...common.hal import Axes, Name, serve_line
from ...common.ioc import Prefix, check_prefix, with_units
from ...common.ioc import serve as serve_ioc
from ...common.line_session import ending_after
from ...common.options import Direction, Json, check_seconds, with_setup
from ...common.session import setup_values, store_setup, stores_setup
from ..presenter import PRESENTER
from . import show as show_line
from .session import Session, open_bus, opened, parse_stations

Axis = Annotated[
    str, typer.Option("--axis", metavar="N", help="ppmc312-serial: stations, as 3, 0,2,5 or 0-7")
]
AnyAxis = Annotated[
    str | None,
    typer.Option("--axis", metavar="N", help="ppmc312-serial: stations, as 3, 0,2,5 or 0-7 (all)"),
]


# ---------------------------------------------------------------------- scan and status


def scan(as_json: Json = False) -> None:
    """ppmc312-serial, pmc006: List devices. Clears the error counters of ppmc312."""
    with opened() as session:
        found = session.scan()
    if as_json:
        output.print_json(show_line.found_values(found))
    elif found:
        output.console.print(show_line.found_table(found))
        for one in found:
            if one.problem:
                output.print_line(f"station {one.station}: {one.problem}")
    else:
        raise PpmcError(show_line.no_station_message(session.bus.line.name))


def poll(
    axis: AnyAxis = None,
    count: Annotated[int | None, typer.Option(min=1, metavar="N", help="end after N rounds")] = None,
    every: Annotated[
        float, typer.Option(min=0.0, max=3600, metavar="S", help="seconds between rounds")
    ] = 0.1,
) -> None:
    """ppmc312-serial: Poll stations, print reports until Ctrl-C."""
    with opened() as session:
        axes = session.selected_axes(axis)
        for turn in range(count or 10**9):
            if turn:
                session.guard.pause(session.bus, every)
            for one in axes:
                session.guard.check()
                for report in one.poll():
                    output.print_line(show_line.report_line(one.number, report))
        for one in axes:
            state = "busy" if one.window.busy else "ready"
            lost = one.counters.lost_reports
            output.print_line(f"station {one.number}: {state}" + (f", {lost} polls garbled" if lost else ""))


def status(axis: AnyAxis = None, as_json: Json = False) -> None:
    """Print position, switches and state of stations without side effects."""
    with opened() as session:
        axes = session.selected_axes(axis)
        if as_json:
            output.print_json({one.number: show_line.status_values(one) for one in axes})
        else:
            output.console.print(show_line.status_table(axes))


def reset(axis: Axis) -> None:
    """ppmc312-serial: Reset stations. Pulses end immediately; table and position are cleared."""
    with opened() as session:
        for one in session.selected_axes(axis):
            one.reset()
            output.print_line(f"station {one.number}: reset")


# ---------------------------------------------------------------------- motions


def _initialise(session: Session, axes: list[Station312], typed: dict[str, Any]) -> list[Any]:
    """Plan the set-ups of all stations, then initialise the stations; return the set-ups that are reached."""
    xtal_hz = session.bus.line.identity.xtal_hz
    plans: list[Any] = [setup_values(typed, one.number).plan(xtal_hz, one.kind, one.number) for one in axes]
    reached = []
    for one, made in zip(axes, plans, strict=True):
        session.guard.check()
        reached.append(one.apply(made))
    return reached


@with_setup
def init(typed: dict[str, Any], axis: Axis, as_json: Json = False) -> None:
    """Initialise stations and store the set-up for this port."""
    with opened() as session:
        axes = session.selected_axes(axis)
        setups = _initialise(session, axes, typed)
    for one in axes:
        store_setup(BOARD.port, setup_values(typed, one.number).table(), one.number)
    if as_json:
        values = {one.number: PRESENTER.setup_values(setup) for one, setup in zip(axes, setups, strict=True)}
        output.print_json(values)
        return
    output.console.print(output.table(PRESENTER.setup_rows(setups[0])))
    output.print_line(f"initialised: station{'s' if len(axes) > 1 else ''} {_list(axes)}")
    if not stores_setup(BOARD.port):
        output.note("(a virtual board is new each time; the set-up is not stored)")


@with_setup
def move(
    typed: dict[str, Any],
    pulses: Annotated[int, typer.Argument(help="pulses, CW positive; with --to a position")],
    axis: Axis,
    to: Annotated[bool, typer.Option("--to", help="move to this position")] = False,
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed, no ramp")] = None,
    keep: Annotated[bool, typer.Option("--keep", help="keep the table that `init` loaded")] = False,
) -> None:
    """Move stations by PULSES, all at the same time."""
    with opened() as session:
        axes = session.selected_axes(axis)
        if not keep:
            _initialise(session, axes, typed)
        motions = []
        for one in axes:
            session.guard.check()
            away = pulses - one.position if to else pulses
            if away:
                motions.append(one.start_move(away) if speed is None else one.start_constant(away, speed))
            else:
                output.print_line(show.end_line(one.move(0)))
        _finish(session, motions, abs(pulses))


def _finish(session: Session, motions: list[Any], asked: int | None = None) -> None:
    """Wait for all motions and print their results.

    Args:
        asked: number of requested pulses. If it is not None, an error is raised for the first motion that
            ended early.
    """
    ends = session.bus.wait(motions, progress=session.guard.progress)
    session.guard.bar_off()
    for end in ends:
        output.print_line(show.end_line(end))
    show_line.reports(session.bus.axes)
    if asked is not None:
        for motion, end in zip(motions, ends, strict=True):
            end.check(motion.requested)


@with_setup
def jog(
    typed: dict[str, Any],
    direction: Annotated[Direction, typer.Argument(help="direction of rotation")],
    axis: Axis,
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed (start speed)")] = None,
    ramped: Annotated[bool, typer.Option("--ramped", help="accelerate to the high speed")] = False,
    seconds: Annotated[float | None, typer.Option(metavar="S", help="stop after this time")] = None,
) -> None:
    """Run stations until Ctrl-C, a limit switch or the alarm."""
    if ramped and speed is not None:
        raise typer.BadParameter("--speed and --ramped exclude each other; omit one")
    check_seconds(seconds)
    with opened() as session:
        axes = session.selected_axes(axis)
        _initialise(session, axes, typed)
        motions = [one.jog(direction.code, speed, ramped) for one in axes]
        ends = session.bus.wait(motions, progress=ending_after(seconds, session.bus, session.guard, axes))
        session.guard.bar_off()
        for end in ends:
            output.print_line(show.end_line(end))
        show_line.reports(axes)


@with_setup
def home(
    typed: dict[str, Any],
    axis: Axis,
    direction: Annotated[Direction, typer.Option(help="towards the origin switch")] = Direction.CCW,
    search: Annotated[float | None, typer.Option(metavar="PPS", help="search speed (start speed)")] = None,
    fast: Annotated[bool, typer.Option("--fast", help="first a zero return at high speed")] = False,
    to_limit: Annotated[bool, typer.Option("--to-limit", help="first run to the hard limit")] = False,
    index: Annotated[
        bool, typer.Option("--index", help="origin is the first encoder index on the switch")
    ] = False,
) -> None:
    """Find the origin switch of each station in turn, and set the position to 0 there."""
    with opened() as session:
        axes = session.selected_axes(axis)
        _initialise(session, axes, typed)
        for one in axes:
            one.home(direction.code, search, fast, to_limit, progress=session.guard.progress, index=index)
            session.guard.bar_off()
            output.print_line(f"station {one.number}: position {one.position}: origin found")


@with_setup
def hal(typed: dict[str, Any], axes: Axes = None, name: Name = "openppmc") -> None:
    """Serve axes as a component of LinuxCNC's HAL, loaded by loadusr -W."""
    numbers = None if axes is None else parse_stations(axes)
    serve_line(name, numbers, open_bus, lambda number: setup_values(typed, number).request(number))


def stop(
    axis: AnyAxis = None,
    now: Annotated[bool, typer.Option("--now", help="stop immediately, without a ramp")] = False,
) -> None:
    """Stop stations that are still running; without --axis, all."""
    with opened() as session:
        axes = session.selected_axes(axis)
        ends = session.bus.stop([one.number for one in axes], now)
        for end in ends:
            output.print_line(show.end_line(end))
        if not ends:
            output.print_line("nothing was moving")


@with_setup
@with_units
def ioc(typed: dict[str, Any], units: dict[str, str], prefix: Prefix, axis: AnyAxis = None) -> None:
    """Serve a motor record for each station to EPICS clients."""
    check_prefix(prefix)
    with opened() as session:
        axes = session.selected_axes(axis)
        _initialise(session, axes, typed)
        requests = {one.number: setup_values(typed, one.number).request(one.number) for one in axes}
        serve_ioc(session.bus, session.guard, prefix, units, requests, open_bus)


def _list(axes: list[Station312]) -> str:
    return ", ".join(str(one.number) for one in axes)
