"""Commands that move motors, and the command that predicts a move."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from ...host import PpmcError, Progress, speeds
from . import output, show
from .board import BOARD
from .boards import AxisNumber
from .options import MOST_AXES, Json, Side, check_seconds, with_setup
from .session import opened, ready, setup_values, stop_all
from .view import Override, parse_override, plot_move, view_of

AxisOrAll = Annotated[
    int | None,
    typer.Option(
        "--axis", min=1, max=MOST_AXES, metavar="N", help="axis, 1 is the first (all)", show_default=False
    ),
]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--at", metavar="POS:WHAT", help="ppmc312: there stop, halt or another speed (repeatable)"),
]
AxisList = Annotated[
    str | None,
    typer.Option("--axes", metavar="N,N,…", help="axes of several numbers, in their order (1,2,…)"),
]
EncoderRange = Annotated[
    int | None,
    typer.Option("--encoder", min=1, max=65_535, metavar="N", help="ppmc312: tell if it is off by more"),
]


def override_values(texts: list[str] | None) -> list[Override]:
    """Return the values of --at. Raise BadParameter."""
    try:
        return [parse_override(text) for text in texts or ()]
    except ValueError as error:
        raise typer.BadParameter(f"--at {error}") from None


def numbers_of(text: str | None, count: int) -> tuple[int, ...]:
    """Return the axes of `count` values: those of --axes, else 1 to count. Raise BadParameter."""
    if text is None:
        return tuple(range(1, count + 1))
    words = text.split(",")
    if not all(word.strip().isascii() and word.strip().isdigit() for word in words):
        raise typer.BadParameter(f"--axes {text}: wants numbers with commas between them, as in 1,2,5")
    numbers = tuple(map(int, words))
    if len(numbers) != count:
        raise typer.BadParameter(f"--axes {text}: {len(numbers)} axes, but {count} numbers to move them")
    if len(set(numbers)) < len(numbers):
        raise typer.BadParameter(f"--axes {text}: an axis stands there twice")
    return numbers


@with_setup
def move(
    typed: dict[str, Any],
    pulses: Annotated[
        list[int],
        typer.Argument(help="pulses, CW positive; with --to a position; several: of axes 1, 2 and so on"),
    ],
    axis: AxisOrAll = None,
    axes: AxisList = None,
    to: Annotated[bool, typer.Option("--to", help="move to this position")] = False,
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed, no ramp")] = None,
    pulse_only: Annotated[bool, typer.Option("--pulse-only", help="the phases stand still")] = False,
    overrides: Overrides = None,
    encoder: EncoderRange = None,
) -> None:
    """Move so many pulses. Several numbers move as many axes of a part, begun at the same moment."""
    if speed is not None and pulse_only:
        raise typer.BadParameter("only moves with a ramp can be --pulse-only: leave --speed out")
    if axis is not None and (len(pulses) > 1 or axes is not None):
        raise typer.BadParameter("move wants one number, with --axis if need be, or one number for each axis")
    wanted = override_values(overrides)
    numbers = numbers_of(axes, len(pulses)) if axis is None else (axis,)
    with ready(typed, numbers) as session:
        guard, part, view = session.guard, session.part, session.view
        chosen = [session.axis(number) for number in numbers]
        away = [n - at.position if to else n for n, at in zip(pulses, chosen, strict=True)]
        view.prepare(part, wanted, encoder)
        if len(numbers) > 1:
            table = dict(zip(numbers, away, strict=True))
            ends = list(view.together(part, table, speed, guard.progress, pulse_only))
        elif speed is None or away[0] == 0:
            ends = [chosen[0].move(away[0], guard.progress, pulse_only)]
        else:
            ends = [chosen[0].move_constant(away[0], speed, guard.progress)]
        guard.bar_off()
        for end in ends:
            output.say(show.end_line(end))
        view.reports(part, output.say)


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
    check_seconds(seconds)
    with ready(typed, (axis,)) as session:
        motor, guard, clock = session.axis(axis), session.guard, session.part.link.clock
        motion = motor.jog(direction.code, speed, ramped)
        end_at = None if seconds is None else clock() + seconds

        def look(now: Progress) -> None:
            nonlocal end_at
            guard.progress(now)
            if end_at is not None and clock() >= end_at:
                end_at = None
                motor.stop(wait=False)

        end = motion.wait(progress=look)
        guard.bar_off()
        output.say(show.end_line(end))
        session.view.reports(session.part, output.say)


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
        motor = session.axis(axis)
        session.view.home(
            session.part,
            motor,
            direction.code,
            search,
            fast,
            to_limit,
            index,
            session.guard.progress,
        )
        session.guard.bar_off()
        output.say(f"{motor.who}position {motor.position}: origin found")


def stop(
    axis: AxisOrAll = None,
    now: Annotated[bool, typer.Option("--now", help="at once, without a ramp")] = False,
) -> None:
    """Stop a motion that was left running."""
    with opened() as session:
        ends = session.view.halt_all(session.part) if now and axis is None else None
        for end in stop_all(session.chosen(axis), now) if ends is None else ends:
            output.say(show.end_line(end))


XTAL_HZ = 16_000_000


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
    view = view_of(kind)
    setup = setup_values(typed).plan(xtal, kind)
    constant = None
    if speed is not None:
        constant = kind.constant_clock(xtal, setup.clock, speed).choose(speed)
    figures = view.figures(setup, pulses, constant)
    if plot is not None:
        try:
            plot_move(lambda n: view.course(setup, n, constant), pulses, plot)
        except OSError as error:
            raise PpmcError(f"{plot}: the plot cannot be written ({error.strerror})") from error
    if as_json:
        output.print_json({"setup": view.setup_values(setup), "move": figures})
        return
    rows = view.setup_rows(setup) if constant is None else {"speed": str(constant)}
    rows["move"] = f"{pulses} pulses, {figures['profile']}"
    rows["top speed"] = f"{speeds.nearby(figures['top_pps'])} pps"
    if "plateau_intervals" in figures:
        rows["acceleration"] = f"{figures['ramp_pulses']} pulses, {figures['ramp_seconds']:.6g} s"
        if "down_pulses" in figures:
            rows["deceleration"] = f"{figures['down_pulses']} pulses"
        rows["plateau"] = f"{figures['plateau_intervals']} intervals"
    rows["duration"] = f"{figures['seconds']:.6g} s from the first to the last pulse"
    output.console.print(output.table(rows))
    if plot is not None:
        output.say(f"plot: {plot}")
