"""The command `decode`, which reads captures of old chips."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ... import parts
from ...capture.common.compare import Result, compare, other_timing
from ...capture.common.decoding import Decoded, decode
from ...capture.common.errors import CaptureError
from ...capture.common.files import read_capture
from ...capture.common.pinmap import PinMap, read_map
from ...capture.common.pulses import runs
from ...capture.common.signals import SECOND, US
from ...errors import PpmcError, needs
from . import output
from .board import BOARD
from .options import Json

if TYPE_CHECKING:
    from rich.table import Table

WAYS = {1: "CW", -1: "CCW", 0: "?"}
SHOWN = 10
"""Number of differences that are printed one by one."""


def decode_capture(
    capture: Annotated[Path, typer.Argument(help="VCD, CSV of Saleae or sigrok, .sr")],
    pin_map: Annotated[
        Path | None,
        typer.Option("--map", metavar="FILE", help="YAML or TOML file with the pin of each channel"),
    ] = None,
    part: Annotated[
        str, typer.Option(metavar="PART", help=f"{', '.join(row.name for row in parts.having('decode'))}")
    ] = "",
    beside: Annotated[
        bool, typer.Option("--compare", help="apply it to the golden model, compare each output edge")
    ] = False,
    tolerance: Annotated[
        float, typer.Option(min=0.0, max=1e6, metavar="US", help="permitted deviation of an edge in µs")
    ] = 10.0,
    glitch: Annotated[
        float,
        typer.Option(min=0.0, max=1e6, metavar="NS", help="ignore pulses shorter than this, on any pin"),
    ] = 30.0,
    timing: Annotated[
        str,
        typer.Option(
            metavar="FAST|DATASHEET", help="timing of the model (of map, else file, else DATASHEET)"
        ),
    ] = "",
    scope: Annotated[
        str, typer.Option(metavar="NAME", help="scope of a VCD, if names are not unique (the first)")
    ] = "",
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="plot speed over time as PNG, SVG or PDF")
    ] = None,
    as_json: Json = False,
) -> None:
    """Decode a capture of an old chip: bytes, moves, comparison with the golden model."""
    chosen = PinMap() if pin_map is None else read_map(pin_map)
    if timing:
        if timing.upper() not in ("FAST", "DATASHEET"):
            raise typer.BadParameter(f"--timing {timing}: neither FAST nor DATASHEET")
        chosen.timing = timing.upper()
    chosen.scope = scope or chosen.scope
    found = decode(read_capture(capture), chosen, part or BOARD.part, round(glitch * 1000))
    result = None if found.complaint or not beside else compare(found, round(tolerance * US))
    if as_json:
        output.print_json(_values(found, result))
    else:
        _show(found)
        if result is not None:
            _show_result(found, result, tolerance)
    if result is not None and (hint := other_timing(found, result, round(tolerance * US))):
        output.note(hint)
    if plot is not None:
        _plot(found, plot)
    if found.complaint:
        raise CaptureError(f"{capture.name}: {found.complaint}")
    if result is not None and result.differences:
        raise PpmcError(
            f"{capture.name}: {len(result.differences)} edges differ, the first at "
            f"{result.differences[0].text()}"
        )


def _show(found: Decoded) -> None:
    output.print_line(f"{found.capture}: {found.decoder.title}, {found.wires.end / SECOND:.6f} s")
    for pin, count in sorted(found.glitches.items()):
        output.note(f"{pin}: {count} pulse{'s' if count > 1 else ''} ignored, shorter than --glitch")
    if found.missing:
        output.note(f"not captured, assumed idle: {', '.join(found.missing)}")
    for note in found.notes:
        output.note(note)
    for line in found.lines:
        mark = " !" if line.invalid else "  "
        output.print_line(f"{line.t / SECOND:12.6f}{mark} {line.data:<24}  {line.text}")
    if found.moves:
        output.console.print(_table(found))


def _table(found: Decoded) -> Table:
    from rich import box
    from rich.table import Table

    grid = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for head in ("axis", "from / s", "to / s", "way", "pulses", "first / pps", "highest", "last"):
        grid.add_column(head, justify="left" if head == "way" else "right")
    for one in found.moves:
        grid.add_row(
            str(one.axis),
            f"{one.begin / SECOND:.6f}",
            f"{one.end / SECOND:.6f}",
            WAYS[one.way],
            str(one.pulses),
            f"{one.first:.0f}",
            f"{one.highest:.0f}",
            f"{one.last:.0f}",
        )
    return grid


def _show_result(found: Decoded, result: Result, tolerance: float) -> None:
    for pin, why in result.skipped.items():
        output.note(f"{pin} not compared: {why}")
    if result.begin and result.begin > found.lines[0].t:
        output.print_line(
            f"edges are compared from {result.begin / SECOND:.6f} s, where the part is initialised"
        )
    if result.ppm:
        how = "fast" if result.ppm > 0 else "slow"
        output.print_line(f"the crystal is {abs(result.ppm):.1f} ppm {how} relative to the analyser's clock")
    output.print_line(
        f"{result.compared} edges of {len(result.pins)} pins compared with the golden model "
        f"({found.timing}), {len(result.differences)} differences; at most {result.worst / US:.3f} µs apart"
        f"{f' ({result.worst_pin})' if result.worst_pin else ''}, {result.mean / US:.3f} µs on average, "
        f"tolerance {tolerance:g} µs"
    )
    blind = [pin for pin in found.missing if pin in found.decoder.inputs and pin != "rst_n"]
    if result.differences and blind:
        output.note(
            f"inputs not captured: {', '.join(blind)}; without the signal of a switch, the model continues "
            "a move that the switch ended"
        )
    for one in result.differences[:SHOWN]:
        output.print_line("  " + one.text())
    if len(result.differences) > SHOWN:
        output.print_line(f"  … and {len(result.differences) - SHOWN} more")


def _values(found: Decoded, result: Result | None) -> dict[str, Any]:
    """Return the values for JSON, with times in s."""
    values: dict[str, Any] = {
        "capture": found.capture,
        "part": found.part,
        "seconds": found.wires.end / SECOND,
        "missing": list(found.missing),
        "glitches": dict(found.glitches),
        "notes": list(found.notes),
        "lines": [
            {"t": line.t / SECOND, "data": line.data, "text": line.text, "strange": line.invalid}
            for line in found.lines
        ],
        "moves": [
            asdict(one) | {"begin": one.begin / SECOND, "end": one.end / SECOND} for one in found.moves
        ],
    }
    if result is not None:
        values["compare"] = {
            "timing": found.timing,
            "edges": result.compared,
            "pins": result.pins,
            "from": result.begin / SECOND,
            "ppm": result.ppm,
            "worst_us": result.worst / US,
            "mean_us": result.mean / US,
            "not_compared": result.skipped,
            "differences": [asdict(one) | {"t": one.t / SECOND} for one in result.differences],
        }
    return values


def _plot(found: Decoded, path: Path) -> None:
    needs("plot", "a plot", "matplotlib")
    from ...plot.capture import FORMATS, draw_capture

    if path.suffix.lower() not in FORMATS:
        raise typer.BadParameter(f"--plot {path}: unsupported suffix; use {', '.join(FORMATS)}")
    if not found.moves:
        raise CaptureError(f"{found.capture}: no pulses, so no speed to plot")
    drawn = [(one.axis, [run.tolist() for run, _ in runs(one, found.pause)]) for one in found.trains]
    try:
        draw_capture(drawn, f"{found.decoder.title}: {found.capture}", path)
    except OSError as error:
        raise PpmcError(f"{path}: cannot be written ({error.strerror})") from error
    output.print_line(f"speed over time: {path}")
