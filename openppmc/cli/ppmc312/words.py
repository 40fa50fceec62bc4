"""Words of script files that only a PPMC-312 knows: at, event, pulse, watch."""

from __future__ import annotations

from ...host import Ppmc312
from ...host.kind import Kind
from ...host.ppmc312 import blocks
from ...host.ppmc312.profile import KIND
from ..common.options import Side
from ..common.override import parse_override
from ..common.reading import Values
from ..common.words import OwnWord
from .overrides import register

_DOES = "move PULSES, step cw|ccw, stop, halt, outputs VALUE or delete"


def read_at(words: list[str]) -> Values:
    """`at POSITION stop|halt|PPS`."""
    if len(words) != 2:
        raise ValueError("at needs: at POSITION stop|halt|PPS")
    override = parse_override(":".join(words))
    return {"override": override, "speed": override.speed}


def read_event(words: list[str]) -> Values:
    """`event 1|2 WHAT`."""
    if len(words) < 2:
        raise ValueError(f"event needs: event 1|2 {_DOES}")
    event, what, operands = _event(words[0]), words[1].lower(), words[2:]
    if what in ("stop", "halt", "delete"):
        _count(operands, 0)
    elif what == "step":
        _count(operands, 1)
        if operands[0].lower() not in ("cw", "ccw"):
            raise ValueError(f"{operands[0]!r} is neither cw nor ccw")
        return {"event": event, "what": what, "value": Side(operands[0].lower()).code}
    elif what in ("move", "outputs"):
        _count(operands, 1)
        return {"event": event, "what": what, "value": _whole(operands[0])}
    else:
        raise ValueError(f"{words[1]!r}: an event does {_DOES}")
    return {"event": event, "what": what}


def read_pulse(words: list[str]) -> Values:
    """`pulse 1|2`."""
    _count(words, 1)
    return {"event": _event(words[0])}


def read_watch(words: list[str]) -> Values:
    """`watch DISTANCE|off`."""
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


def _count(words: list[str], wanted: int) -> None:
    if len(words) != wanted:
        raise ValueError(f"{wanted} word{'s' if wanted != 1 else ''} expected here, not {len(words)}")


def _lacks(kind: Kind, values: Values) -> str:
    """Why another part cannot do it; empty for a PPMC-312."""
    return "" if kind is KIND else f"a {kind} has neither overrides nor events"


def _do_at(part: Ppmc312, values: Values) -> None:
    register(part, [values["override"]])


def _do_event(part: Ppmc312, values: Values) -> None:
    if values["what"] == "delete":
        while part.event_delete(values["event"]):
            pass
    else:
        part.event_add(values["event"], _block(part, values["what"], values.get("value", 0)))


def _do_pulse(part: Ppmc312, values: Values) -> None:
    part.pulse_event(values["event"])


def _do_watch(part: Ppmc312, values: Values) -> None:
    part.watch_encoder(values["distance"])


def _block(part: Ppmc312, what: str, value: int) -> bytes:
    if what == "move":
        return part.move_block(value)
    if what == "step":
        return blocks.single_step(value)
    if what == "outputs":
        return blocks.outputs(value)
    return blocks.immediate_stop() if what == "halt" else blocks.slow_stop()


WORDS = {
    "at": OwnWord(read_at, _lacks, _do_at),
    "event": OwnWord(read_event, _lacks, _do_event),
    "pulse": OwnWord(read_pulse, _lacks, _do_pulse),
    "watch": OwnWord(read_watch, _lacks, _do_watch),
}
