"""Serial line with PPMC-312 stations as text, and comparison of one station with the model."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ...model.ppmc312.codes import INPUTS, OUTPUTS
from ...model.ppmc312.front import serial
from ...model.ppmc312.front.serial import LENGTHS, SERIAL_INSTRUCTIONS, Local, ReportCode, block_of
from ..common.characters import Character, characters, rate_of
from ..common.errors import CaptureError
from ..common.part_decoder import Line, Needs, PartDecoder, Wires
from ..common.pinmap import Pins
from .decode import NAMES, trains
from .mnemonics import block_words

SPEEDS = {19_200.0: 5, 38_400.0: 6, 16e6 / 192: 7}
SHORTEST = 12_000_000
KINDS = {serial.BUSY: "busy", serial.READY: "ready", serial.DATA: "data", serial.SPECIFIC: "report"}


def _rate(wires: Wires) -> float:
    """Return the line rate in bit/s, from the captured straps or measured from the bits."""
    crystal = float(str(wires.params.get("XTAL_HZ", 16_000_000))) / 16e6
    if (mod := wires.ports.get("mod")) is not None:
        for rate, level in SPEEDS.items():
            if level == mod.initial:
                return rate * crystal
    return rate_of(wires.ports["rxd"], [rate * crystal for rate in SPEEDS], "rxd")


def _lines(wires: Wires) -> list[Line]:
    rate = _rate(wires)
    mode = str(wires.params.get("SUM_MODE", "BINARY"))
    lines = _frames(characters(wires.ports["rxd"], rate), False, mode)
    if "txd" in wires.ports:
        lines += _frames(characters(wires.ports["txd"], rate), True, mode)
    return sorted(lines, key=lambda line: line.t)


def _frames(found: list[Character], reply: bool, mode: str) -> list[Line]:
    """Return the frames of a line.

    A control code begins a frame; the next control code or the end of the line ends it.
    """
    lines: list[Line] = []
    run: list[Character] = []
    for one in [*found, None]:
        if one is None or (one.byte is not None and one.byte & 0x80):
            if run:
                lines.append(_frame(run, reply, mode))
            run = []
        if one is not None:
            run.append(one)
    return lines


def _frame(run: list[Character], reply: bool, mode: str) -> Line:
    begin, end = run[0].begin, run[-1].end
    data = bytes(one.byte or 0 for one in run)
    shown = ("→ " if reply else "") + data.hex(" ").upper()
    try:
        if any(one.byte is None for one in run) or not data[0] & 0x80 or len(data) < 2 or len(data) % 2:
            raise ValueError
        content = bytes.fromhex(data[1:-1].decode("ascii"))
    except ValueError:
        return Line(begin, shown, "no whole frame", True)
    if data[-1] != serial.checksum(data[0], content, mode):
        return Line(begin, shown, f"station {data[0] & 15}: wrong checksum", True)
    kind, text, strange, first = data[0] & 0xF0, "", False, False
    if reply:
        text = KINDS.get(kind, f"kind {kind:02X}")
        if kind == serial.SPECIFIC and content:
            known = content[0] in list(ReportCode)
            text = ReportCode(content[0]).name.lower().replace("_", " ") if known else text
        elif content:
            text += f" {content.hex(' ').upper()}"
    elif kind == serial.POLL:
        text = "poll"
    elif kind == serial.INSTRUCTION and content and content[0] in LENGTHS:
        code = content[0]
        first = code in (0x00, 0xFF)
        strange = len(content) - 1 != LENGTHS[code]
        if code in list(Local):
            text = Local(code).name.lower().replace("_", " ")
        elif code in SERIAL_INSTRUCTIONS and not strange:
            text = block_words(block_of(code, content[1:]))
    else:
        text, strange = "no instruction", True
    return Line(begin, shown, f"station {data[0] & 15}: {text}", strange, first, end)


def _station(wires: Wires) -> int:
    """Return the station at which the capture was made.

    Its address is read from the captured straps, from the parameter ADR in the map, or from the replies.
    """
    if (straps := wires.ports.get("adr")) is not None:
        return straps.initial
    if "ADR" in wires.params:
        return int(str(wires.params["ADR"]))
    if "txd" not in wires.ports:
        raise CaptureError(
            "which station is this? add ADR to the map's parameters, as `parameters: {ADR: 3}`"
        )
    seen = Counter(
        one.byte & 15 for one in characters(wires.ports["txd"], _rate(wires)) if one.byte and one.byte & 0x80
    )
    if not seen:
        raise CaptureError(
            "txd never sends anything: which station is this? add `parameters: {ADR: 3}` to the map"
        )
    return seen.most_common(1)[0][0]


def _straps(wires: Wires) -> dict[str, int]:
    crystal = float(str(wires.params.get("XTAL_HZ", 16_000_000))) / 16e6
    rate = _rate(wires) / crystal
    mod = min(SPEEDS, key=lambda known: abs(known - rate))
    return {"mode": 0, "mod": SPEEDS[mod], "adr": _station(wires)}


def _stimulus(wires: Wires) -> Iterator[tuple[int, dict[str, int]]]:
    return ((t, {"rxd": level}) for t, level in wires.ports["rxd"])


DECODER = PartDecoder(
    "a PPMC-312 in serial mode",
    Pins(NAMES),
    INPUTS,
    lambda wires: Needs(("rxd",), SHORTEST),
    _lines,
    _stimulus,
    trains,
    frozenset(("rxd", "mode", "mod", "adr", "hsp", "d_i", "rs", "cs_n", "we_n", "oe_n")),
    tuple(name for name in OUTPUTS if name not in ("d_o", "d_oe", "wrq_n", "irq_n", "out_oe")),
    straps=_straps,
    row_noun="frames",
    reset_levels=OUTPUTS,
)
