"""Output of the shared commands as rows of text, or as JSON for programs; `monitor` repeats the output."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ...host import MotionResult, speeds
from ...host.capabilities import name_of
from ...host.link import Link
from ...host.part import AnyAxis
from ...host.script import RATES
from . import output

if TYPE_CHECKING:
    from rich.table import Table


def identity_values(link: Link) -> dict[str, Any]:
    """Return the values of the answer to IDENT."""
    identity = link.identity
    return {
        "port": link.name,
        "part": name_of(identity.part),
        "axes": identity.axes,
        "protocol": identity.version,
        "timing": "DATASHEET" if identity.datasheet else "FAST",
        "pulse_counter": identity.counter,
        "crystal_hz": identity.xtal_hz,
        "clock_hz": identity.clk_hz,
        "baud": link.baud,
        "best_baud": RATES[identity.best_rate],
    }


def prefix(axis: AnyAxis) -> str:
    """Return the prefix of lines about an axis; empty if the part has one axis."""
    return f"axis {axis.number}: " if axis.kind.axes > 1 else ""


def end_line(end: MotionResult) -> str:
    """Return one line with position, pulses, and the cause of the end of the motion."""
    pulses = "" if end.pulses is None else f", {abs(end.pulses)} pulses {'CCW' if end.pulses < 0 else 'CW'}"
    return f"{end.message_prefix}position {end.position}{pulses}: {end.cause_text}"


def switches(axis_inputs: dict[str, bool]) -> str:
    """Return the names of the active switches as text."""
    return ", ".join(name.replace("_", " ") for name, on in axis_inputs.items() if on) or "none active"


def speed(value: speeds.Speed, byte_name: str = "rate") -> str:
    """Return a speed as text: as reached, with its rate or divisor, and as requested if that differs."""
    text = f"{speeds.nearby(value.reached)} pps ({byte_name} {value.rate})"
    return (
        text
        if value.reached == value.requested
        else f"{text}, requested {speeds.nearby(value.requested)} pps"
    )


# ---------------------------------------------------------------------- the ramp of the PPMC family


def setup_rows(setup: speeds.Setup) -> dict[str, str]:
    """Return rows with the requested and reached speeds, the ramp and the bytes."""
    byte_name = "rate" if setup.clock.beyond else "divisor"
    rows = {"start speed": speed(setup.start, byte_name), "high speed": speed(setup.high, byte_name)}
    if not setup.ramp_pulses:
        rows["ramp"] = "none: high speed immediately"
    elif not setup.flat:
        steep = speeds.nearby(setup.acceleration)
        rows["ramp"] = f"{setup.ramp_pulses} pulses, {setup.ramp_seconds:.4g} s, {steep} pps/s"
    clock = setup.clock
    kind = ("clock pin" if clock.beyond else "external") if clock.external else "internal"
    rows["base clock"] = f"{speeds.nearby(clock.hertz)} Hz ({kind})" + (
        ", 7.5 us more" if clock.extra else ""
    )
    rows["bytes"] = " ".join(f"{byte:02X}" for byte in (setup.code, *setup.data))
    return rows


def setup_values(setup: speeds.Setup) -> dict[str, Any]:
    """Return the values for JSON."""
    return {
        "start_pps": float(setup.start.reached),
        "high_pps": float(setup.high.reached),
        "ramp_pulses": setup.ramp_pulses,
        "acceleration_pps2": setup.acceleration,
        "base_clock_hz": float(setup.clock.hertz),
        "bytes": [setup.code, *setup.data],
    }


Count = Annotated[int | None, typer.Option(min=1, metavar="N", help="end after N readings")]
Every = Annotated[float, typer.Option(min=0.05, max=3600, metavar="S", help="seconds between readings")]


def watch(
    count: int | None,
    pause: Callable[[], None],
    lines: Callable[[], Iterable[str]],
    table: Callable[[], Table],
) -> None:
    """On a terminal, show `table` and update it; elsewhere, print the `lines` of each reading.

    Args:
        pause: function that is called between two readings.
    """
    turns = count or 10**9
    if not output.console.is_terminal:
        for turn in range(turns):
            if turn:
                pause()
            for line in lines():
                output.print_line(line)
        return
    from rich.live import Live

    with Live(table(), console=output.console, auto_refresh=False) as live:
        for _ in range(turns - 1):
            pause()
            live.update(table(), refresh=True)
