"""What commands print: tables for people, JSON for programs."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from typing import Any

from rich import box
from rich.console import Console
from rich.table import Table

from ...host import AnyPart, Axis, End, Ppmc312
from ...host.basis import units
from ...host.basis.kind import AnySetup, name_of
from ...host.bridge.link import Link
from ...host.bridge.script import RATES
from ...host.ppmc312.answers import Alarm, Failed
from ...host.ppmc312.profile import Setup as Setup312
from ...host.ppmc2104.registers import Status as Status2104
from ..ppmc312 import show

out = Console(highlight=False)


def say(text: str) -> None:
    """One line on stdout, as it is."""
    print(text)


def note(text: str) -> None:
    """One line beside the results, on stderr."""
    print(text, file=sys.stderr)


def table(rows: dict[str, str], title: str | None = None) -> Table:
    """Two columns, no frame."""
    grid = Table(box=box.SIMPLE_HEAD if title else None, show_header=False, title=title, pad_edge=False)
    grid.add_column(style="bold")
    grid.add_column()
    for name, value in rows.items():
        grid.add_row(name, value)
    return grid


def print_json(values: Any) -> None:
    """One JSON document."""
    print(json.dumps(values, indent=1))


def identity_values(link: Link) -> dict[str, Any]:
    """What IDENT said."""
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


def status_values(part: AnyPart, axis: Axis) -> dict[str, Any]:
    """Everything that may be read of an axis at any time."""
    if isinstance(part, Ppmc312):
        return show.status_values(part)
    status = part.status()
    error: Any = None
    if isinstance(status, Status2104):
        moving, error = status.busy[axis.number - 1], "unread" if status.error else None
    else:
        moving, error = status.busy, None if status.error is None else int(status.error)
    return {
        "position": axis.position if part.link.identity.counter else None,
        "moving": moving,
        "error": error,
        "status": status.raw,
        "inputs": {name: bool(on) for name, on in vars(axis.inputs()).items()},
    }


def status_rows(values: dict[str, Any], prefix: str = "") -> dict[str, str]:
    """The same for people."""
    active = [name.replace("_", " ") for name, on in values["inputs"].items() if on]
    error = values["error"]
    rows = {
        "position": "no counter" if values["position"] is None else str(values["position"]),
        "motor": "moving" if values["moving"] else "at rest",
        "switches": ", ".join(active) or "none active",
        "last byte": "good" if error is None else f"error {error}",
    }
    if "state" in values:
        del rows["last byte"]
        rows |= show.state_rows(values)
    return {prefix + name: text for name, text in rows.items()}


def reports(part: AnyPart, tell: Callable[[str], None] = say) -> None:
    """What a PPMC-312 said meanwhile, a line each. Raises what went wrong, after all of it."""
    if not isinstance(part, Ppmc312):
        return
    trouble = None
    while (report := part.next_report()) is not None:
        if isinstance(report, (Failed, Alarm)):
            trouble = trouble or report.error
        else:
            tell(show.report_line(report))
    if trouble is not None:
        raise trouble


def end_line(end: End) -> str:
    """Where the motor stands, and why."""
    pulses = "" if end.pulses is None else f", {abs(end.pulses)} pulses {'CCW' if end.pulses < 0 else 'CW'}"
    return f"{end.who}position {end.position}{pulses}: {end.why}"


def setup_rows(setup: AnySetup) -> dict[str, str]:
    """Asked and reached speeds, ramp, bytes."""
    if isinstance(setup, Setup312):
        return show.setup_rows(setup)
    byte_name = "rate" if setup.clock.beyond else "divisor"

    def speed(value: units.Speed) -> str:
        text = f"{units.nearby(value.reached)} pps ({byte_name} {value.rate})"
        return text if value.reached == value.asked else f"{text}, asked {units.nearby(value.asked)} pps"

    rows = {"start speed": speed(setup.start), "high speed": speed(setup.high)}
    if not setup.ramp_pulses:
        rows["ramp"] = "none: high speed at once"
    elif not setup.flat:
        steep = units.nearby(setup.acceleration)
        rows["ramp"] = f"{setup.ramp_pulses} pulses, {setup.ramp_seconds:.4g} s, {steep} pps/s"
    clock = setup.clock
    kind = ("clock pin" if clock.beyond else "external") if clock.external else "internal"
    rows["base clock"] = f"{units.nearby(clock.hertz)} Hz ({kind})" + (", 7.5 us more" if clock.extra else "")
    rows["bytes"] = " ".join(f"{byte:02X}" for byte in (setup.code, *setup.data))
    return rows


def setup_values(setup: AnySetup) -> dict[str, Any]:
    """For JSON."""
    if isinstance(setup, Setup312):
        return show.setup_values(setup)
    return {
        "start_pps": float(setup.start.reached),
        "high_pps": float(setup.high.reached),
        "ramp_pulses": setup.ramp_pulses,
        "acceleration_pps2": setup.acceleration,
        "base_clock_hz": float(setup.clock.hertz),
        "bytes": [setup.code, *setup.data],
    }
