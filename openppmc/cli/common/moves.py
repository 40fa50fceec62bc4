"""Commands that move motors, and the command that predicts a move."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from ...host import PpmcError, Progress, speeds
from . import output, show
from .board import BOARD
from .boards import AxisNumber
from .options import MOST_AXES, Direction, Json, check_seconds, with_setup
from .presenter import Override, parse_override, plot_move, presenter_of
from .session import opened, ready, setup_values, stop_all

AxisOrAll = Annotated[
    int | None,
    typer.Option(
        "--axis",
        min=1,
        max=MOST_AXES,
        metavar="N",
        help="number of the axis, from 1 (all)",
        show_default=False,
    ),
]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--at", metavar="POS:WHAT", help="ppmc312: stop, halt or new speed at POS (repeatable)"),
]
AxisList = Annotated[
    str | None,
    typer.Option("--axes", metavar="N,N,…", help="axes for several PULSES, in the same order (1,2,…)"),
]
EncoderRange = Annotated[
    int | None,
    typer.Option(
        "--encoder",
        min=1,
        max=65_535,
        metavar="N",
        help="ppmc312: report an encoder deviation of more than N",
    ),
]


def override_values(texts: list[str] | None) -> list[Override]:
    """Return the values of --at. Raise BadParameter if a value is invalid."""
    try:
        return [parse_override(text) for text in texts or ()]
    except ValueError as error:
        raise typer.BadParameter(f"--at {error}") from None


def numbers_of(text: str | None, count: int) -> tuple[int, ...]:
    """Return the axis numbers for `count` values: those of --axes, else 1 to `count`.

    Raise BadParameter if the list is invalid or its length is not `count`.
    """
    if text is None:
        return tuple(range(1, count + 1))
    words = text.split(",")
    if not all(word.strip().isascii() and word.strip().isdigit() for word in words):
        raise typer.BadParameter(f"--axes {text}: not a list of axes; write 1,2,5")
    numbers = tuple(map(int, words))
    if len(numbers) != count:
        raise typer.BadParameter(
            f"--axes {text}: {len(numbers)} axes for {count} values; give one axis for each value"
        )
    if len(set(numbers)) < len(numbers):
        raise typer.BadParameter(f"--axes {text}: an axis occurs twice; name each axis once")
    return numbers


@with_setup
def move(
    typed: dict[str, Any],
    pulses: Annotated[
        list[int],
        typer.Argument(help="pulses, CW positive; with --to: position; one for each axis"),
    ],
    axis: AxisOrAll = None,
    axes: AxisList = None,
    to: Annotated[bool, typer.Option("--to", help="move to this position")] = False,
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed, no ramp")] = None,
    pulse_only: Annotated[
        bool, typer.Option("--pulse-only", help="output pulses, do not change the phases")
    ] = False,
    overrides: Overrides = None,
    encoder: EncoderRange = None,
) -> None:
    """Move by PULSES. Several values move several axes of the part; all start together."""
    if speed is not None and pulse_only:
        raise typer.BadParameter("--pulse-only: only for moves with a ramp; omit --speed")
    if axis is not None and (len(pulses) > 1 or axes is not None):
        raise typer.BadParameter(f"--axis {axis}: only for one value and without --axes; omit it")
    chosen_overrides = override_values(overrides)
    numbers = numbers_of(axes, len(pulses)) if axis is None else (axis,)
    with ready(typed, numbers) as session:
        guard, part, presenter = session.guard, session.part, session.presenter
        chosen = [session.axis(number) for number in numbers]
        away = [n - at.position if to else n for n, at in zip(pulses, chosen, strict=True)]
        presenter.prepare(part, chosen_overrides, encoder)
        if len(numbers) > 1:
            table = dict(zip(numbers, away, strict=True))
            ends = list(presenter.move_together(part, table, speed, guard.progress, pulse_only))
        elif speed is None or away[0] == 0:
            ends = [chosen[0].move(away[0], guard.progress, pulse_only)]
        else:
            ends = [chosen[0].move_constant(away[0], speed, guard.progress)]
        guard.bar_off()
        for end in ends:
            output.print_line(show.end_line(end))
        presenter.reports(part, output.print_line)


@with_setup
def jog(
    typed: dict[str, Any],
    direction: Annotated[Direction, typer.Argument(help="direction of rotation")],
    axis: AxisNumber = 1,
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed (start speed)")] = None,
    ramped: Annotated[bool, typer.Option("--ramped", help="accelerate to the high speed")] = False,
    seconds: Annotated[float | None, typer.Option(metavar="S", help="stop after this time")] = None,
) -> None:
    """Run until Ctrl-C, a limit switch or the alarm."""
    if ramped and speed is not None:
        raise typer.BadParameter("--speed and --ramped exclude each other; omit one")
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
        output.print_line(show.end_line(end))
        session.presenter.reports(session.part, output.print_line)


@with_setup
def home(
    typed: dict[str, Any],
    axis: AxisNumber = 1,
    direction: Annotated[Direction, typer.Option(help="towards the origin switch")] = Direction.CCW,
    search: Annotated[float | None, typer.Option(metavar="PPS", help="search speed (start speed)")] = None,
    fast: Annotated[
        bool, typer.Option("--fast", help="first run to the slow-down limit at high speed")
    ] = False,
    to_limit: Annotated[bool, typer.Option("--to-limit", help="first run to the hard limit")] = False,
    index: Annotated[
        bool, typer.Option("--index", help="ppmc312: origin is the first encoder index on the switch")
    ] = False,
) -> None:
    """Find the origin switch and set the position to 0 there."""
    with ready(typed, (axis,)) as session:
        motor = session.axis(axis)
        session.presenter.home(
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
        output.print_line(f"{show.prefix(motor)}position {motor.position}: origin found")


def stop(
    axis: AxisOrAll = None,
    now: Annotated[bool, typer.Option("--now", help="stop immediately, without a ramp")] = False,
) -> None:
    """Stop a motion that is still running."""
    with opened() as session:
        ends = session.presenter.halt_all(session.part) if now and axis is None else None
        for end in stop_all(session.selected_axes(axis), now) if ends is None else ends:
            output.print_line(show.end_line(end))


XTAL_HZ = 16_000_000


@with_setup
def plan(
    typed: dict[str, Any],
    pulses: Annotated[int, typer.Argument(help="pulses, CW positive")],
    speed: Annotated[float | None, typer.Option(metavar="PPS", help="constant speed, no ramp")] = None,
    plot: Annotated[
        Path | None, typer.Option(help="write a plot of speed over time (.png, .svg, .pdf)")
    ] = None,
    xtal: Annotated[int, typer.Option(min=1_000_000, max=XTAL_HZ, help="crystal frequency in Hz")] = XTAL_HZ,
    as_json: Json = False,
) -> None:
    """Predict a move; no board is needed."""
    kind = BOARD.planned
    presenter = presenter_of(kind)
    setup = setup_values(typed).plan(xtal, kind)
    constant = None
    if speed is not None:
        constant = kind.constant_clock(xtal, setup.clock, speed).choose(speed)
    figures = presenter.figures(setup, pulses, constant)
    if plot is not None:
        try:
            plot_move(lambda n: presenter.trajectory(setup, n, constant), pulses, plot)
        except OSError as error:
            raise PpmcError(f"{plot}: the plot cannot be written ({error.strerror})") from error
    if as_json:
        output.print_json({"setup": presenter.setup_values(setup), "move": figures})
        return
    rows = presenter.setup_rows(setup) if constant is None else {"speed": str(constant)}
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
        output.print_line(f"plot: {plot}")
