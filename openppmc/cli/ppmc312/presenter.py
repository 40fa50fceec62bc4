"""Forecasts, overrides, output and script commands of the PPMC-312 on the command line.

A forecast is computed from the tables of the golden model. Only a PPMC-312 has the script commands `at`,
`event`, `pulse` and `watch`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import accumulate
from typing import Any

from ...host import Ppmc312, speeds
from ...host.axis import OnProgress
from ...host.capabilities import Capabilities
from ...host.errors import OutOfRange
from ...host.part import AnyAxis
from ...host.ppmc312 import blocks
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
from ...host.ppmc312.profile import CAPABILITIES, Setup
from ...model.ppmc312.codes import SHAPES, Code, Source
from ...model.ppmc312.stages import Plan, constant, ramped
from ..common import show
from ..common.options import Direction
from ..common.presenter import Override, Presenter, Trajectory, parse_override
from ..common.script_parser import PartCommand, Values

LONGEST_MOVE = (1 << 32) - 1


def _plan(setup: Setup, pulses: int, speed: speeds.Speed | None) -> Plan:
    if not 1 <= pulses <= LONGEST_MOVE:
        raise OutOfRange(f"{pulses} pulses: a move has 1 to {LONGEST_MOVE} pulses either way")
    if speed is None:
        return ramped(setup.table, setup.table.high, pulses)
    return constant(setup.table, setup.rate_of(speed.requested), pulses)


def figures(setup: Setup, pulses: int, speed: speeds.Speed | None) -> dict[str, Any]:
    """Return the figures of an undisturbed move, as `presenter.key_figures` does.

    The ramps are computed interval by interval, the motion between them by a formula.
    """
    n = abs(pulses)
    plan = _plan(setup, n, speed)
    sloped = [*range(1, plan.up + 1), *range(n - plan.down + 1, n + 1)]
    rates = {number: plan.step(number).rate for number in sloped}
    plateau = n - len(sloped)
    ticks = sum(rates.values()) + plateau * plan.rate
    ticks -= rates.get(n, plan.rate)  # no interval follows the last pulse
    fastest = min([*rates.values(), *([plan.rate] if plateau else [])])
    period = setup.clock.period
    values: dict[str, Any] = {
        "pulses": pulses,
        "profile": "constant speed" if speed is not None else SHAPES[plan.kind],
        "top_pps": float(setup.clock.speed(fastest)),
        "seconds": float(ticks * period),
    }
    if speed is None:
        rise = sum(rates[number] for number in range(1, plan.up + 1))
        values |= {
            "ramp_pulses": plan.up,
            "plateau_intervals": plateau,
            "down_pulses": plan.down,
            "ramp_seconds": float(rise * period),
        }
    return values


def trajectory(setup: Setup, pulses: int, speed: speeds.Speed | None) -> Trajectory:
    """Compute the trajectory of a move with the ramps of the table, or at constant `speed`.

    Args:
        pulses: 1 or more.
    """
    rates = [step.rate for step in _plan(setup, pulses, speed).steps()[:-1]]
    period = float(setup.clock.period)
    seconds = [ticks * period for ticks in accumulate(rates, initial=0)]
    return Trajectory(seconds, [1 / (rate * period) for rate in rates])


MOST = 8


def register(part: Ppmc312, overrides: Sequence[Override]) -> None:
    """Register the overrides in this order. Raise OutOfRange if the part does not support one of them."""
    if len(overrides) > MOST:
        raise OutOfRange(f"{len(overrides)} overrides: too many; a {part.kind} stores {MOST}")
    for one in overrides:
        if one.speed is None:
            part.override_stop(at=one.at, slow=not one.now)
        else:
            part.override_speed(one.speed, at=one.at)


_DONE = {
    Code.STOP: "stopped without a ramp",
    Code.SLOW_STOP: "stopped with a ramp",
    Code.RAMP_CHANGE: "speed changed with a ramp",
    Code.CHANGE: "speed changed without a ramp",
}


def axis_values(part: Axis[Any]) -> dict[str, Any]:
    """Return all values that may be read at any time."""
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
    """Return rows with the values that only a PPMC-312 has."""
    return {
        "encoder": str(values["encoder"]),
        "state": values["state"],
        "overrides": str(values["overrides"] or "none"),
    }


def setup_rows(setup: Setup) -> dict[str, str]:
    """Return rows with the requested and reached speeds, the ramps and the bytes."""
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
    """Return the values for JSON."""
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
    """Return the table as the lines of a CSV file for --curve, slowest stage first."""
    lines = ["pps,up,down" if read.down else "pps,up"]
    for place in range(len(read.rates) - 1, -1, -1):
        sides = [read.up, *([read.down] if read.down else [])]
        cells = [str(side[place]) if place < len(side) else "" for side in sides]
        lines.append(",".join([f"{float(setup.clock.speed(read.rates[place])):.10g}", *cells]))
    return lines


def report_text(report: Report) -> str:
    """Return a report as one line."""
    if isinstance(report, Executed):
        by = "override" if report.by is Source.OVERRIDE else "event"
        if report.code is None:
            return f"{by}: an instruction executed"
        return f"{by}: {_DONE.get(Code(report.code), f'instruction {report.code:02X} executed')}"
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
    return (
        "interlock position reached" if isinstance(report, InterlockEnded) else "RUN: the motion has started"
    )


_DOES = "move PULSES, step cw|ccw, stop, halt, outputs VALUE or delete"


def read_at(words: list[str]) -> Values:
    """Parse `at POSITION stop|halt|PPS`. Raise ValueError for any other text."""
    if len(words) != 2:
        raise ValueError("at needs: at POSITION stop|halt|PPS")
    override = parse_override(":".join(words))
    return {"override": override, "speed": override.speed}


def read_event(words: list[str]) -> Values:
    """Parse `event 1|2 WHAT`. Raise ValueError for any other text."""
    if len(words) < 2:
        raise ValueError(f"event needs: event 1|2 {_DOES}")
    event, what, operands = _event(words[0]), words[1].lower(), words[2:]
    if what in ("stop", "halt", "delete"):
        _count(operands, 0)
    elif what == "step":
        _count(operands, 1)
        if operands[0].lower() not in ("cw", "ccw"):
            raise ValueError(f"{operands[0]!r} is neither cw nor ccw")
        return {"event": event, "what": what, "value": Direction(operands[0].lower()).code}
    elif what in ("move", "outputs"):
        _count(operands, 1)
        return {"event": event, "what": what, "value": _whole(operands[0])}
    else:
        raise ValueError(f"{words[1]!r}: no action of an event; use {_DOES}")
    return {"event": event, "what": what}


def read_pulse(words: list[str]) -> Values:
    """Parse `pulse 1|2`. Raise ValueError for any other text."""
    _count(words, 1)
    return {"event": _event(words[0])}


def read_watch(words: list[str]) -> Values:
    """Parse `watch DISTANCE|off`. Raise ValueError for any other text."""
    _count(words, 1)
    distance = None if words[0].lower() == "off" else _whole(words[0])
    if distance is not None and not 1 <= distance <= 0xFFFF:
        raise ValueError(f"distance {distance} is outside 1 to 65535")
    return {"distance": distance}


def _event(text: str) -> int:
    if text not in ("1", "2"):
        raise ValueError(f"event {text!r}: there are events 1 and 2")
    return int(text)


def _whole(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise ValueError(f"{text!r} is not a whole number") from None


def _count(words: list[str], expected: int) -> None:
    if len(words) != expected:
        raise ValueError(f"{expected} word{'s' if expected != 1 else ''} expected here, not {len(words)}")


def _unsupported_reason(kind: Capabilities, values: Values) -> str:
    """Return why a part does not support the command, as text; empty for a PPMC-312."""
    return "" if kind is CAPABILITIES else f"a {kind} has neither overrides nor events"


def _execute_at(part: Ppmc312, values: Values) -> None:
    register(part, [values["override"]])


def _execute_event(part: Ppmc312, values: Values) -> None:
    if values["what"] == "delete":
        while part.event_delete(values["event"]):
            pass
    else:
        part.event_add(values["event"], _block(part, values["what"], values.get("value", 0)))


def _execute_pulse(part: Ppmc312, values: Values) -> None:
    part.pulse_event(values["event"])


def _execute_watch(part: Ppmc312, values: Values) -> None:
    part.watch_encoder(values["distance"])


def _block(part: Ppmc312, what: str, value: int) -> bytes:
    if what == "move":
        return part.move_block(value)
    if what == "step":
        return blocks.single_step(value)
    if what == "outputs":
        return blocks.outputs(value)
    return blocks.immediate_stop() if what == "halt" else blocks.slow_stop()


SCRIPT_COMMANDS = {
    "at": PartCommand(read_at, _unsupported_reason, _execute_at),
    "event": PartCommand(read_event, _unsupported_reason, _execute_event),
    "pulse": PartCommand(read_pulse, _unsupported_reason, _execute_pulse),
    "watch": PartCommand(read_watch, _unsupported_reason, _execute_watch),
}


class PartPresenter(Presenter[Ppmc312, Setup]):
    """Presenter of a part with ramp tables, an encoder, overrides and unsolicited reports."""

    def status_values(self, part: Ppmc312, axis: AnyAxis) -> dict[str, Any]:
        return axis_values(part)

    def status_rows(self, values: dict[str, Any]) -> dict[str, str]:
        rows = super().status_rows(values)
        del rows["last byte"]
        return rows | state_rows(values)

    def reports(self, part: Ppmc312, tell: Callable[[str], None]) -> None:
        trouble = None
        while (report := part.next_report()) is not None:
            if isinstance(report, (Failed, Alarm)):
                trouble = trouble or report.error
            else:
                tell(report_text(report))
        if trouble is not None:
            raise trouble

    def setup_rows(self, setup: Setup) -> dict[str, str]:
        return setup_rows(setup)

    def setup_values(self, setup: Setup) -> dict[str, Any]:
        return setup_values(setup)

    def figures(self, setup: Setup, pulses: int, speed: speeds.Speed | None) -> dict[str, Any]:
        return figures(setup, pulses, speed)

    def trajectory(self, setup: Setup, pulses: int, speed: speeds.Speed | None) -> Trajectory:
        return trajectory(setup, pulses, speed)

    def prepare(self, part: Ppmc312, overrides: Sequence[Override], encoder: int | None) -> None:
        if encoder is not None:
            part.watch_encoder(encoder)
        register(part, overrides)

    def home(
        self,
        part: Ppmc312,
        axis: AnyAxis,
        direction: int,
        pps: float | None,
        fast: bool,
        to_limit: bool,
        index: bool,
        progress: OnProgress,
    ) -> None:
        part.home(direction, pps, fast, to_limit, progress=progress, index=index)

    def table_lines(self, part: Ppmc312) -> list[str]:
        return table_lines(part.read_table(), part.known_setup())


PRESENTER = PartPresenter()
