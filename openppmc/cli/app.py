"""The commands. What goes wrong leaves as an exception; `main` in __init__ makes one line of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.live import Live

from .. import __version__
from ..host import Ppmc104, PpmcError, serial_ports, units
from ..host.link import DEFAULT_BAUD
from . import show
from .forecast import key_figures, plot_move
from .guard import Guard, Interrupted
from .options import SetupValues, Side, with_setup
from .player import Player, check_speeds
from .program import read_program
from .state import lasting, recall, remember

INTERRUPTED = 130
XTAL_HZ = 16_000_000

app = typer.Typer(
    name="openppmc",
    help="Drive stepper controllers of the PPMC family through their UART bridge.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    add_completion=False,
    rich_markup_mode="rich",
)
_NUMBERS = {"ignore_unknown_options": True}  # so that `move -200` is a number and not an option
Json = Annotated[bool, typer.Option("--json", help="for programs")]


@dataclass
class Board:
    """Which board, from the options in front of the command."""

    port: str = ""
    baud: int = DEFAULT_BAUD


_board = Board()


def _version(wanted: bool) -> None:
    if wanted:
        print(f"openppmc {__version__}")
        raise typer.Exit


@app.callback()
def options(
    port: Annotated[
        str,
        typer.Option("--port", "-p", envvar="OPENPPMC_PORT", help="/dev/ttyUSB0, COM3, sim:… or model:…"),
    ] = "",
    baud: Annotated[int, typer.Option(help="line rate to work with")] = DEFAULT_BAUD,
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="print it")
    ] = False,
) -> None:
    """Drive stepper controllers of the PPMC family through their UART bridge."""
    _board.port, _board.baud = port, baud


@contextmanager
def _opened() -> Iterator[tuple[Ppmc104, Guard]]:
    """The board, and Ctrl-C under control: it brings the motor to rest and ends with status 130."""
    with Guard() as guard, Ppmc104.open(_board.port, _board.baud) as axis:
        try:
            guard.check()
            yield axis, guard
        except Interrupted:
            show.note(guard.bring_to_rest(axis))
            raise typer.Exit(INTERRUPTED) from None
        finally:
            guard.bar_off()


def _values(typed: dict[str, Any]) -> SetupValues:
    """Defaults, then what `init` remembered for this port, then what was typed."""
    return SetupValues().merged(recall(_board.port)).merged(typed)


@contextmanager
def _ready(typed: dict[str, Any]) -> Iterator[tuple[Ppmc104, Guard]]:
    """The board with its part initialised."""
    values = _values(typed)
    with _opened() as (axis, guard):
        axis.apply(values.plan(axis.link.identity.xtal_hz))
        yield axis, guard


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
    with _opened() as (axis, _):
        values = show.identity_values(axis.link)
    if as_json:
        show.print_json(values)
    else:
        show.out.print(show.table({name.replace("_", " "): str(value) for name, value in values.items()}))


@app.command()
@with_setup
def init(typed: dict[str, Any], as_json: Json = False) -> None:
    """Initialise the part, and remember the set-up for this port."""
    values = _values(typed)
    with _opened() as (axis, _):
        setup = axis.apply(values.plan(axis.link.identity.xtal_hz))
    remember(_board.port, values.table())
    if as_json:
        show.print_json(show.setup_values(setup))
        return
    show.out.print(show.table(show.setup_rows(setup)))
    if not lasting(_board.port):
        show.note("(a virtual board is new each time: nothing to remember)")


# ---------------------------------------------------------------------- motions


@app.command(context_settings=_NUMBERS)
@with_setup
def move(
    typed: dict[str, Any],
    pulses: Annotated[int, typer.Argument(help="pulses, CW positive; with --to a position")],
    to: Annotated[bool, typer.Option("--to", help="move to this position")] = False,
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed, no ramp")] = None,
    pulse_only: Annotated[bool, typer.Option("--pulse-only", help="the phases stand still")] = False,
) -> None:
    """Move so many pulses."""
    if speed is not None and pulse_only:
        raise typer.BadParameter("only moves with a ramp can be --pulse-only: leave --speed out")
    with _ready(typed) as (axis, guard):
        distance = pulses - axis.position if to else pulses
        if speed is None or distance == 0:
            end = axis.move(distance, guard.progress, pulse_only)
        else:
            end = axis.move_constant(distance, speed, guard.progress)
        guard.bar_off()
        show.say(show.end_line(end))


@app.command()
@with_setup
def jog(
    typed: dict[str, Any],
    direction: Annotated[Side, typer.Argument(help="where to")],
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed (start speed)")] = None,
    ramped: Annotated[bool, typer.Option("--ramped", help="ramp up to the high speed")] = False,
    seconds: Annotated[float | None, typer.Option(metavar="S", help="stop after so long")] = None,
) -> None:
    """Run until Ctrl-C, a limit switch or the alarm."""
    if ramped and speed is not None:
        raise typer.BadParameter("either --speed or --ramped, not both")
    if seconds is not None and not 0 <= seconds < float("inf"):
        raise typer.BadParameter(f"--seconds {seconds:g} is not a time from 0 on")
    with _ready(typed) as (axis, guard):
        motion = axis.jog(direction.code, speed, ramped)
        end_at = None if seconds is None else axis.link.clock() + seconds

        def look(now: Any) -> None:
            nonlocal end_at
            guard.progress(now)
            if end_at is not None and axis.link.clock() >= end_at:
                end_at = None
                axis.stop(wait=False)

        end = motion.wait(progress=look)
        guard.bar_off()
        show.say(show.end_line(end))


@app.command()
@with_setup
def home(
    typed: dict[str, Any],
    direction: Annotated[Side, typer.Option(help="towards the origin switch")] = Side.CCW,
    search: Annotated[float | None, typer.Option(metavar="PPS", help="search speed (start speed)")] = None,
    fast: Annotated[bool, typer.Option("--fast", help="at high speed to the slow-down limit first")] = False,
    to_limit: Annotated[bool, typer.Option("--to-limit", help="to the hard limit first")] = False,
) -> None:
    """Find the origin switch and call it position 0."""
    with _ready(typed) as (axis, guard):
        axis.home(direction.code, search, fast, to_limit, progress=guard.progress)
        guard.bar_off()
        show.say(f"position {axis.position}: origin found")


@app.command()
def stop(now: Annotated[bool, typer.Option("--now", help="at once, without a ramp")] = False) -> None:
    """Stop a motion that was left running."""
    with _opened() as (axis, _):
        end = axis.halt() if now else axis.stop()
        if end is not None:
            show.say(show.end_line(end))


# ---------------------------------------------------------------------- looking


@app.command()
def status(as_json: Json = False) -> None:
    """Position, switches, state. Disturbs nothing."""
    with _opened() as (axis, _):
        values = show.status_values(axis)
    if as_json:
        show.print_json(values)
    else:
        show.out.print(show.table(show.status_rows(values)))


@app.command()
def monitor(
    count: Annotated[int | None, typer.Option(min=1, metavar="N", help="end after N looks")] = None,
    every: Annotated[
        float, typer.Option(min=0.05, max=3600, metavar="S", help="seconds between looks")
    ] = 0.2,
) -> None:
    """Watch position and switches until Ctrl-C."""
    with _opened() as (axis, guard):
        look: Callable[[], dict[str, str]] = lambda: show.status_rows(show.status_values(axis))  # noqa: E731
        if not show.out.is_terminal:
            for turn in range(count or 10**9):
                if turn:
                    guard.pause(axis, every)
                show.say("  ".join(f"{name} {value}" for name, value in look().items()))
            return
        with Live(show.table(look()), console=show.out, auto_refresh=False) as live:
            for _ in range((count or 10**9) - 1):
                guard.pause(axis, every)
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
    setup = _values(typed).plan(xtal)
    constant = None
    if speed is not None:
        clock = setup.clock
        if not clock.external:
            clock = units.any_clock(xtal, speed, clock.vsel, clock.csel)
        constant = clock.choose(speed)
    figures = key_figures(setup, pulses, constant)
    if plot is not None:
        try:
            plot_move(setup, pulses, constant, xtal, plot)
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
        rows["plateau"] = f"{figures['plateau_intervals']} intervals"
    rows["duration"] = f"{figures['seconds']:.6g} s from the first to the last pulse"
    show.out.print(show.table(rows))
    if plot is not None:
        show.say(f"plot: {plot}")


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
    values = _values(typed)
    with _opened() as (axis, guard):
        check_speeds(steps, values, axis.link.identity.xtal_hz, name)
        axis.apply(values.plan(axis.link.identity.xtal_hz))
        Player(axis, guard, values, name, show.say).run(steps)
        guard.bar_off()
        show.say(f"done, position {axis.position}")
