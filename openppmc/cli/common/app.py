"""The commands. What goes wrong leaves as an exception; `main` in __init__ makes one line of it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.live import Live

from ... import __version__
from ...host import OutOfRange, Ppmc312, Ppmc2104, PpmcError, serial_ports
from ...host.basis import units
from ...host.bridge.link import DEFAULT_BAUD
from ..ppmc312 import show as show312
from ..ppmc312.line.session import LINE_WORDS
from ..ppmc312.overrides import Override, parse_override, register, watch
from . import show
from .forecast import key_figures, plot_move
from .group import PartGroup
from .options import Side, with_setup
from .player import Player, check_speeds, check_steps, positions, stop_all
from .program import read_program
from .session import BOARD, PartName, Session, initialise, opened, ready, setup_values
from .state import lasting, remember

XTAL_HZ = 16_000_000

app = typer.Typer(
    name="openppmc",
    cls=PartGroup,
    help="Drive stepper controllers of the PPMC family through their UART bridge.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    add_completion=False,
    rich_markup_mode="rich",
)
_NUMBERS = {"ignore_unknown_options": True}  # so that `move -200` is a number and not an option
Json = Annotated[bool, typer.Option("--json", help="for programs")]


AxisNumber = Annotated[int, typer.Option("--axis", min=1, max=2, metavar="N", help="axis 1 or 2")]
AnyAxis = Annotated[
    int | None,
    typer.Option("--axis", min=1, max=2, metavar="N", help="axis 1 or 2 (all)", show_default=False),
]


Overrides = Annotated[
    list[str] | None,
    typer.Option("--at", metavar="POS:WHAT", help="ppmc312: there stop, halt or another speed (repeatable)"),
]
EncoderRange = Annotated[
    int | None,
    typer.Option("--encoder", min=1, max=65_535, metavar="N", help="ppmc312: tell if it is off by more"),
]


def override_values(texts: list[str] | None) -> list[Override]:
    """The values of --at."""
    try:
        return [parse_override(text) for text in texts or ()]
    except ValueError as error:
        raise typer.BadParameter(f"--at {error}") from None


def _version(wanted: bool) -> None:
    if wanted:
        print(f"openppmc {__version__}")
        raise typer.Exit


@app.callback()
def options(
    port: Annotated[
        str,
        typer.Option(
            "--port",
            "-p",
            envvar="OPENPPMC_PORT",
            help="/dev/ttyUSB0, COM3, sim:… (the RTL; ppmc312-serial, pmc006: golden models) or model:…",
        ),
    ] = "",
    baud: Annotated[
        int | None,
        typer.Option(
            help=f"line rate to work with ({DEFAULT_BAUD}; ppmc312-serial: 19200, 38400, 83333; pmc006: 9600)"
        ),
    ] = None,
    part: Annotated[
        PartName | None,
        typer.Option(envvar="OPENPPMC_PART", help="the part (what the board has; virtual: ppmc104)"),
    ] = None,
    line: Annotated[
        str,
        typer.Option(envvar="OPENPPMC_LINE", metavar="WORDS", help=f"ppmc312-serial, pmc006: {LINE_WORDS}"),
    ] = "",
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="print it")
    ] = False,
) -> None:
    """Drive stepper controllers of the PPMC family through their UART bridge."""
    BOARD.port, BOARD.baud, BOARD.part, BOARD.line = port, baud, part, line


# ---------------------------------------------------------------------- boards


@app.command()
def ports(as_json: Json = False) -> None:
    """List the serial ports of this computer."""
    found = serial_ports()
    if as_json:
        show.print_json([{"port": device, "description": text} for device, text in found])
    elif found:
        show.out.print(show.table(dict(found)))
    else:
        show.say("no serial port; --port model: works without one")


@app.command()
def info(as_json: Json = False) -> None:
    """What board answers at the port."""
    with opened() as session:
        values = show.identity_values(session.part.link)
    if as_json:
        show.print_json(values)
    else:
        show.out.print(show.table({name.replace("_", " "): str(value) for name, value in values.items()}))


@app.command()
@with_setup
def init(typed: dict[str, Any], axis: AxisNumber = 1, as_json: Json = False) -> None:
    """Initialise an axis, and remember the set-up for this port."""
    values = setup_values(typed, axis)
    with opened() as session:
        (setup,) = initialise(session, {axis: values})
    remember(BOARD.port, values.table(), axis)
    if as_json:
        show.print_json(show.setup_values(setup))
        return
    show.out.print(show.table(show.setup_rows(setup)))
    if not lasting(BOARD.port):
        show.note("(a virtual board is new each time: nothing to remember)")


# ---------------------------------------------------------------------- motions


@app.command(context_settings=_NUMBERS)
@with_setup
def move(
    typed: dict[str, Any],
    pulses: Annotated[
        list[int], typer.Argument(help="pulses, CW positive; with --to a position; two numbers: both axes")
    ],
    axis: AnyAxis = None,
    to: Annotated[bool, typer.Option("--to", help="move to this position")] = False,
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed, no ramp")] = None,
    pulse_only: Annotated[bool, typer.Option("--pulse-only", help="the phases stand still")] = False,
    overrides: Overrides = None,
    encoder: EncoderRange = None,
) -> None:
    """Move so many pulses. Two numbers move both axes of a part, begun at the same moment."""
    if speed is not None and pulse_only:
        raise typer.BadParameter("only moves with a ramp can be --pulse-only: leave --speed out")
    if len(pulses) > 2 or (len(pulses) == 2 and axis is not None):
        raise typer.BadParameter("move wants one number, with --axis if need be, or one number for each axis")
    wanted = override_values(overrides)
    both = len(pulses) == 2
    with ready(typed, (1, 2) if both else (axis or 1,)) as session:
        guard, part = session.guard, session.part
        chosen = part.axes if both else (session.axis(axis or 1),)
        away = [n - at.position if to else n for n, at in zip(pulses, chosen, strict=True)]
        watch(part, encoder)
        register(part, wanted)
        if both and isinstance(part, Ppmc2104):
            x, y = away
            ends = list(part.together(x, y, speed, speed, guard.progress, pulse_only))
        elif speed is None or away[0] == 0:
            ends = [chosen[0].move(away[0], guard.progress, pulse_only)]
        else:
            ends = [chosen[0].move_constant(away[0], speed, guard.progress)]
        guard.bar_off()
        for end in ends:
            show.say(show.end_line(end))
        show.reports(part)


@app.command()
@with_setup
def jog(
    typed: dict[str, Any],
    direction: Annotated[Side, typer.Argument(help="where to")],
    axis: AxisNumber = 1,
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed (start speed)")] = None,
    ramped: Annotated[bool, typer.Option("--ramped", help="ramp up to the high speed")] = False,
    seconds: Annotated[float | None, typer.Option(metavar="S", help="stop after so long")] = None,
) -> None:
    """Run until Ctrl-C, a limit switch or the alarm."""
    if ramped and speed is not None:
        raise typer.BadParameter("either --speed or --ramped, not both")
    if seconds is not None and not 0 <= seconds < float("inf"):
        raise typer.BadParameter(f"--seconds {seconds:g} is not a time from 0 on")
    with ready(typed, (axis,)) as session:
        motor, guard, clock = session.axis(axis), session.guard, session.part.link.clock
        motion = motor.jog(direction.code, speed, ramped)
        end_at = None if seconds is None else clock() + seconds

        def look(now: Any) -> None:
            nonlocal end_at
            guard.progress(now)
            if end_at is not None and clock() >= end_at:
                end_at = None
                motor.stop(wait=False)

        end = motion.wait(progress=look)
        guard.bar_off()
        show.say(show.end_line(end))
        show.reports(session.part)


@app.command()
@with_setup
def home(
    typed: dict[str, Any],
    axis: AxisNumber = 1,
    direction: Annotated[Side, typer.Option(help="towards the origin switch")] = Side.CCW,
    search: Annotated[float | None, typer.Option(metavar="PPS", help="search speed (start speed)")] = None,
    fast: Annotated[bool, typer.Option("--fast", help="at high speed to the slow-down limit first")] = False,
    to_limit: Annotated[bool, typer.Option("--to-limit", help="to the hard limit first")] = False,
    index: Annotated[bool, typer.Option("--index", help="ppmc312: to the encoder's index on it")] = False,
) -> None:
    """Find the origin switch and call it position 0."""
    with ready(typed, (axis,)) as session:
        motor, progress = session.axis(axis), session.guard.progress
        if index and not isinstance(session.part, Ppmc312):
            raise OutOfRange(f"index: a {session.kind} does not have that")
        own = {"index": True} if index else {}
        motor.home(direction.code, search, fast, to_limit, progress=progress, **own)
        session.guard.bar_off()
        show.say(f"{motor.who}position {motor.position}: origin found")


@app.command()
def stop(
    axis: AnyAxis = None,
    now: Annotated[bool, typer.Option("--now", help="at once, without a ramp")] = False,
) -> None:
    """Stop a motion that was left running."""
    with opened() as session:
        for end in stop_all(session.chosen(axis), now):
            show.say(show.end_line(end))


# ---------------------------------------------------------------------- looking


def _looks(session: Session, axis: int | None) -> dict[str, dict[str, Any]]:
    """Values of the axes, by what to write in front of them."""
    chosen = session.chosen(axis)
    several = len(chosen) > 1
    return {
        f"axis {motor.number} " if several else "": show.status_values(session.part, motor)
        for motor in chosen
    }


def _rows(looks: dict[str, dict[str, Any]]) -> dict[str, str]:
    """The same as rows."""
    rows: dict[str, str] = {}
    for prefix, values in looks.items():
        rows |= show.status_rows(values, prefix)
    return rows


@app.command()
def status(axis: AnyAxis = None, as_json: Json = False) -> None:
    """Position, switches, state. Disturbs nothing."""
    with opened() as session:
        looks = _looks(session, axis)
    if not as_json:
        show.out.print(show.table(_rows(looks)))
    elif "" in looks:
        show.print_json(looks[""])
    else:
        show.print_json({prefix.strip().replace(" ", ""): values for prefix, values in looks.items()})


@app.command()
def monitor(
    axis: AnyAxis = None,
    count: Annotated[int | None, typer.Option(min=1, metavar="N", help="end after N looks")] = None,
    every: Annotated[
        float, typer.Option(min=0.05, max=3600, metavar="S", help="seconds between looks")
    ] = 0.2,
) -> None:
    """Watch position and switches until Ctrl-C."""
    with opened() as session:
        guard = session.guard
        look: Callable[[], dict[str, str]] = lambda: _rows(_looks(session, axis))  # noqa: E731
        if not show.out.is_terminal:
            for turn in range(count or 10**9):
                if turn:
                    guard.pause(session.part, every)
                show.say("  ".join(f"{name} {value}" for name, value in look().items()))
            return
        with Live(show.table(look()), console=show.out, auto_refresh=False) as live:
            for _ in range((count or 10**9) - 1):
                guard.pause(session.part, every)
                live.update(show.table(look()), refresh=True)


@app.command(context_settings=_NUMBERS)
@with_setup
def plan(
    typed: dict[str, Any],
    pulses: Annotated[int, typer.Argument(help="pulses, CW positive")],
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed, no ramp")] = None,
    plot: Annotated[Path | None, typer.Option(help="speed over time into this file (png, svg, pdf)")] = None,
    xtal: Annotated[int, typer.Option(min=1_000_000, max=XTAL_HZ, help="crystal in Hz")] = XTAL_HZ,
    as_json: Json = False,
) -> None:
    """Predict a move. Needs no board."""
    kind = BOARD.planned
    setup = setup_values(typed).plan(xtal, kind)
    constant = None
    if speed is not None:
        constant = kind.constant_clock(xtal, setup.clock, speed).choose(speed)
    figures = key_figures(setup, pulses, constant)
    if plot is not None:
        try:
            plot_move(setup, pulses, constant, plot)
        except OSError as error:
            raise PpmcError(f"{plot}: the plot cannot be written ({error.strerror})") from error
    if as_json:
        show.print_json({"setup": show.setup_values(setup), "move": figures})
        return
    rows = show.setup_rows(setup) if constant is None else {"speed": str(constant)}
    rows["move"] = f"{pulses} pulses, {figures['profile']}"
    rows["top speed"] = f"{units.nearby(figures['top_pps'])} pps"
    if "plateau_intervals" in figures:
        rows["acceleration"] = f"{figures['ramp_pulses']} pulses, {figures['ramp_seconds']:.6g} s"
        if "down_pulses" in figures:
            rows["deceleration"] = f"{figures['down_pulses']} pulses"
        rows["plateau"] = f"{figures['plateau_intervals']} intervals"
    rows["duration"] = f"{figures['seconds']:.6g} s from the first to the last pulse"
    show.out.print(show.table(rows))
    if plot is not None:
        show.say(f"plot: {plot}")


@app.command()
@with_setup
def table(
    typed: dict[str, Any],
    out: Annotated[Path | None, typer.Option("--out", help="write it into this file instead")] = None,
) -> None:
    """Read the ramps back from a PPMC-312, as the CSV that --curve takes."""
    with ready(typed, (1,)) as session:
        part = session.part
        if not isinstance(part, Ppmc312):
            raise OutOfRange(f"table: a {session.kind} cannot be asked for it")
        lines = show312.table_lines(part.read_table(), part.known_setup())
    if out is None:
        show.say("\n".join(lines))
        return
    try:
        out.write_text("\n".join(lines) + "\n", encoding="utf-8")
    except OSError as error:
        raise PpmcError(f"{out}: cannot be written ({error.strerror})") from error
    show.say(f"{len(lines) - 1} stages: {out}")


# ---------------------------------------------------------------------- script files


@app.command()
@with_setup
def script(
    typed: dict[str, Any],
    file: Annotated[Path, typer.Argument(help="text file, one command a line; - for standard input")],
) -> None:
    """Carry out a file of commands."""
    name = "stdin" if str(file) == "-" else str(file)
    try:
        text = typer.get_text_stream("stdin").read() if name == "stdin" else file.read_text(encoding="utf-8")
    except OSError as error:
        raise PpmcError(f"{file}: cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise PpmcError(f"{file}: not a text file in UTF-8") from error
    steps = read_program(text, name)
    with opened() as session:
        used = check_steps(steps, name, session.kind)
        values = {axis: setup_values(typed, axis) for axis in used}
        check_speeds(steps, dict(values), session.xtal_hz, name, session.kind)
        initialise(session, values)
        Player(session, values, name, show.say).run(steps)
        session.guard.bar_off()
        show.say(f"done, {positions(session.axis(number) for number in used)}")
