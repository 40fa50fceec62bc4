"""What commands print about a PPMC-312."""

from __future__ import annotations

from typing import Any

from ...host import speeds
from ...host.ppmc312.answers import (
    Alarm,
    EncoderChange,
    Executed,
    Failed,
    InPositionChange,
    InputChange,
    InterlockEnded,
    Report,
    Stopped,
)
from ...host.ppmc312.core import TableRead
from ...host.ppmc312.part import Axis
from ...host.ppmc312.profile import Setup
from ...model.ppmc312.codes import Code, Source
from ..common import show

_DONE = {
    Code.STOP: "stopped at once",
    Code.SLOW_STOP: "stopped with a ramp",
    Code.RAMP_CHANGE: "speed changed with a ramp",
    Code.CHANGE: "speed changed at once",
}


def status_values(part: Axis[Any]) -> dict[str, Any]:
    """Everything that may be read at any time."""
    status = part.status()
    return {
        "position": part.position,
        "encoder": part.encoder,
        "moving": status.busy,
        "state": status.state.name,
        "error": "alarm" if status.in_alarm else None,
        "status": status.raw,
        "overrides": status.overrides,
        "inputs": {name: bool(on) for name, on in vars(part.inputs()).items()},
    }


def state_rows(values: dict[str, Any]) -> dict[str, str]:
    """Rows that other parts do not have."""
    return {
        "encoder": str(values["encoder"]),
        "state": values["state"],
        "overrides": str(values["overrides"] or "none"),
    }


def setup_rows(setup: Setup) -> dict[str, str]:
    """Asked and reached speeds, ramps, bytes."""
    table = setup.table
    rows = {"start speed": show.speed(setup.start), "high speed": show.speed(setup.high)}
    rows["ramp"] = f"{setup.shape}, {table.na} pulses, {setup.seconds(table.pa):.4g} s"
    if table.separate:
        rows["stop speed"] = show.speed(setup.stop)
        rows["ramp down"] = f"{table.nd} pulses, {setup.seconds(table.pd):.4g} s"
    kind = "external" if setup.clock.external else "internal"
    rows["base clock"] = f"{speeds.nearby(setup.clock.hertz)} Hz ({kind})"
    first = setup.blocks[0].hex(" ").upper()
    rows["bytes"] = first + (f" and {len(setup.blocks) - 1} blocks of data" if setup.blocks[1:] else "")
    return rows


def setup_values(setup: Setup) -> dict[str, Any]:
    """For JSON."""
    return {
        "shape": setup.shape,
        "start_pps": float(setup.start.reached),
        "stop_pps": float(setup.stop.reached),
        "high_pps": float(setup.high.reached),
        "ramp_pulses": setup.table.na,
        "down_pulses": setup.table.nd,
        "base_clock_hz": float(setup.clock.hertz),
        "blocks": [list(block) for block in setup.blocks],
    }


def table_lines(read: TableRead, setup: Setup) -> list[str]:
    """The table as a CSV that `--curve` takes: slowest stage first."""
    lines = ["pps,up,down" if read.down else "pps,up"]
    for place in range(len(read.rates) - 1, -1, -1):
        sides = [read.up, *([read.down] if read.down else [])]
        cells = [str(side[place]) if place < len(side) else "" for side in sides]
        lines.append(",".join([f"{float(setup.clock.speed(read.rates[place])):.10g}", *cells]))
    return lines


def report_line(report: Report) -> str:
    """One line for a report."""
    if isinstance(report, Executed):
        by = "override" if report.by is Source.OVERRIDE else "event"
        if report.code is None:
            return f"{by}: an instruction carried out"
        return f"{by}: {_DONE.get(Code(report.code), f'instruction {report.code:02X} carried out')}"
    if isinstance(report, (Failed, Alarm)):
        return str(report.error)
    if isinstance(report, EncoderChange):
        return f"encoder: {'outside' if report.outside else 'inside'} its range"
    if isinstance(report, InPositionChange):
        return f"position: {'not ' if report.outside else ''}reached by the encoder"
    if isinstance(report, InputChange):
        return f"inputs changed: {report.changed:08b}"
    if isinstance(report, Stopped):
        return f"stopped at position {report.position}: {report.cause.name.lower().replace('_', ' ')}"
    return "interlock position reached" if isinstance(report, InterlockEnded) else "RUN: the start went off"
