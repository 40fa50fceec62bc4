"""Output of commands for a line of PPMC-312."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from ....host import PpmcError, Station312
from ....host.ppmc312.answers import Alarm, Failed, Report
from ....host.ppmc312.line.bus import ScanResult
from ...common import output
from ..presenter import axis_values, report_text

if TYPE_CHECKING:
    from rich.table import Table

_HEADS = ("station", "version", "state", "position", "framing", "overrun", "checksum", "line faults")


def found_table(found: Iterable[ScanResult]) -> Table:
    """Return a table of the stations, with the error counters of each station and those of the master."""
    from rich.table import Table

    grid = Table(box=None, pad_edge=False)
    for head in _HEADS:
        grid.add_column(head, justify="right")
    for one in found:
        counts = ("-", "-", "-") if one.errors is None else tuple(map(str, one.errors))
        grid.add_row(
            str(one.station),
            "-" if one.version is None else f"{one.version:02X}",
            "-" if one.status is None else one.status.state.name,
            "-" if one.position is None else str(one.position),
            *counts,
            str(one.counters.faults),
        )
    return grid


def found_values(found: Iterable[ScanResult]) -> list[dict[str, Any]]:
    """Return the values for JSON."""
    return [
        {
            "station": one.station,
            "version": one.version,
            "state": None if one.status is None else one.status.state.name,
            "position": one.position,
            "errors": None if one.errors is None else one.errors._asdict(),
            "line": asdict(one.counters),
            "trouble": one.problem,
        }
        for one in found
    ]


def status_values(axis: Station312) -> dict[str, Any]:
    """Return the values that may be read at any time, and the error counters of the line."""
    return {**axis_values(axis), "line": asdict(axis.counters)}


def status_table(axes: Iterable[Station312]) -> Table:
    """Return a table with one row for each station."""
    from rich import box
    from rich.table import Table

    grid = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for head in ("station", "state", "position", "encoder", "overrides", "switches", "line faults"):
        grid.add_column(head, justify="left" if head in ("state", "switches") else "right")
    for axis in axes:
        values = axis_values(axis)
        active = [name.replace("_", " ") for name, on in values["inputs"].items() if on]
        grid.add_row(
            str(axis.number),
            values["state"],
            str(values["position"]),
            str(values["encoder"]),
            str(values["overrides"]),
            ", ".join(active) or "none active",
            str(axis.counters.faults),
        )
    return grid


def status_line(axis: Station312) -> str:
    """Return the state of a station as one line."""
    values = axis_values(axis)
    active = [name.replace("_", " ") for name, on in values["inputs"].items() if on]
    return (
        f"station {axis.number}  state {values['state']}  position {values['position']}  "
        f"encoder {values['encoder']}  switches {', '.join(active) or 'none active'}"
    )


def no_station_message(port: str) -> str:
    """Return the message for a line on which no station replies."""
    return f"{port}: no station replies; check power, speed (MOD, --baud), MODE and the two wires"


def report_line(number: int, report: Report) -> str:
    """Return a report of a station as one line."""
    text = report_text(report)
    who = f"station {number}: "
    return text if text.startswith(who) else who + text


def reports(axes: Iterable[Station312], print_line: Callable[[str], None] = output.print_line) -> None:
    """Pass each new report to `print_line` as a line; then raise the first error among the reports."""
    first_error: PpmcError | None = None
    for axis in axes:
        for report in axis.poll():
            print_line(report_line(axis.number, report))
            if isinstance(report, (Failed, Alarm)):
                first_error = first_error or report.error
    if first_error is not None:
        raise first_error
