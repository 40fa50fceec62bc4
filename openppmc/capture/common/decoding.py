"""Decoding of a capture of a part: assignment of the pins, clean-up, and checks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ... import parts
from .errors import CaptureError
from .part_decoder import Line, PartDecoder, PulseTrain, Wires
from .pinmap import PinMap, wired
from .pulses import Move, moves
from .signals import US, Bits, Capture, Channel, joined, without_glitches

GLITCH = 30_000
"""Shortest pulse in ps that is not ignored as a glitch.

Every strobe, bit and pulse of these chips is longer.
"""


@dataclass
class Decoded:
    """Decoded capture.

    Attributes:
        glitches: number of pulses that were ignored, by pin.
        missing: pins that were not captured.
        crystal, timing: crystal in Hz and TIMING of the model.
        notes: remarks on the file, without repetitions.
    """

    part: str
    decoder: PartDecoder
    wires: Wires
    lines: list[Line]
    trains: list[PulseTrain]
    moves: list[Move]
    glitches: Mapping[str, int]
    missing: tuple[str, ...]
    crystal: int
    timing: str
    capture: str
    notes: list[str] = field(default_factory=list)

    @property
    def pause(self) -> int:
        """Shortest time between two moves in ps."""
        return self.decoder.pause * 16_000_000 // self.crystal

    @property
    def invalid_lines(self) -> int:
        """Number of decoded lines that are invalid for this part."""
        return sum(line.invalid for line in self.lines)

    @property
    def complaint(self) -> str:
        """Message if more than half of the decoded lines are invalid for this part; otherwise empty."""
        rows = [line for line in self.lines if line.data[:2] not in ("st", "CS")]
        if len(rows) < 3 or 2 * self.invalid_lines <= len(rows):
            return ""
        wires = (
            "are rxd and txd mixed up"
            if "rxd" in self.wires.ports
            else "are lines of d mixed up, is a0 (rs) right"
        )
        return (
            f"{self.invalid_lines} of {len(rows)} {self.decoder.row_noun} are invalid for "
            f"{self.decoder.title}: is the "
            f"capture of another part, {wires}?"
        )


def part_decoder(part: str) -> PartDecoder:
    """Return the capture functions of a part (`decode.py`). Raises UnknownPartError."""
    decoder: PartDecoder = parts.part(part).load("decode")
    return decoder


def fitting(capture: Capture, chosen: PinMap, without: str) -> str:
    """Return a hint for the end of an error message, "; it has the pins of …".

    The text names the parts whose required pins the capture contains.

    The result is empty in three cases: a pin map names the channels, the capture has all required pins of
    `without`, or it matches no other part.

    Args:
        without: the requested part, which the message does not name.
    """
    if chosen.pins is not None or _has_pins(capture, chosen, without):
        return ""
    found = [
        f"--part {row.name}"
        for row in parts.having("decode")
        if row.name != without and _has_pins(capture, chosen, row.name)
    ]
    return f"; it has the pins of another part: {' or '.join(found)}" if found else ""


def _has_pins(capture: Capture, chosen: PinMap, part: str) -> bool:
    """Return True if there is a channel for each pin that this part needs."""
    decoder = part_decoder(part)
    try:
        bits = wired(capture, chosen, decoder.pins)
    except CaptureError:
        return False
    needs = decoder.needs(Wires({}, bits, capture.end, capture.sample)).pins
    return all(len(bits.get(pin, ())) == decoder.pins.widths[pin] for pin in needs)


def decode(capture: Capture, chosen: PinMap, part: str | None = None, glitch: int = GLITCH) -> Decoded:
    """Decode a capture: pins, text, moves.

    Args:
        part: name of the part; it overrides the part of the map.
        glitch: shortest pulse in ps.

    Raises:
        CaptureError: the capture cannot be decoded.
        UnknownPartError: there is no such part.
    """
    name = part or chosen.part or capture.part
    if not name:
        names = ", ".join(row.name for row in parts.having("decode"))
        raise CaptureError(
            f"which part is this? name it with --part, or in the map as `part:` (there are {names})"
        )
    decoder = part_decoder(name)
    try:
        bits, glitches, doubtful, blank = _clean(wired(capture, chosen, decoder.pins), decoder, glitch)
    except CaptureError as error:
        raise CaptureError(f"{error}{fitting(capture, chosen, name)}") from None
    ports = {
        port: places.whole
        if isinstance(places, Bits)
        else joined([places[bit] for bit in range(decoder.pins.widths[port])])
        for port, places in bits.items()
        if len(places) == decoder.pins.widths[port]
    }
    for port, whole in ports.items():
        if whole.width > 1:
            bits[port] = Bits(whole)
    told = dict(capture.parameters) if name == capture.part else {}
    timing = chosen.timing or str(told.pop("TIMING", "DATASHEET"))
    crystal = chosen.crystal or int(str(told.get("XTAL_HZ", 16_000_000)))
    params = {**told, "XTAL_HZ": crystal, **chosen.parameters}
    # In files of this project, each edge has the exact time of an edge of `clk`, not the time of a sample.
    sample = 0 if told else capture.finest
    wires = Wires(ports, bits, capture.end, sample, params)
    try:
        _check(decoder, wires, capture, blank)
    except CaptureError as error:
        raise CaptureError(f"{error}{fitting(capture, chosen, name)}") from None
    lines = decoder.lines(wires)
    if not lines:
        raise CaptureError(
            f"{capture.name}: the host never sends anything to {decoder.title}: is the pin map right "
            f"({', '.join(decoder.needs(wires).pins)}), was the program running?"
        )
    if not any(line.data[:2] not in ("st", "CS", "→ ", " →") for line in lines):
        raise CaptureError(
            f"{capture.name}: the host only reads and never writes to {decoder.title}: is the write strobe "
            f"the right channel ({', '.join(decoder.needs(wires).pins)})?"
        )
    trains = decoder.trains(wires)
    known = {"clk", *ports, *decoder.host_pins}
    used = [*decoder.inputs, *decoder.outputs]
    missing = tuple(pin for pin in used if pin not in known and pin not in bits)
    return Decoded(
        name,
        decoder,
        wires,
        lines,
        trains,
        moves(trains, decoder.pause * 16_000_000 // crystal),
        glitches,
        missing,
        crystal,
        timing,
        capture.name,
        [*capture.notes, *_remarks(doubtful, blank)],
    )


def _remarks(doubtful: Sequence[str], blank: Sequence[str]) -> list[str]:
    """Return a remark about the pins with unknown levels, or no remark."""
    if not doubtful and not blank:
        return []
    return [f"unknown levels (x, z, none), assumed inactive: {', '.join([*blank, *doubtful])}"]


def _clean(
    bits: Mapping[str, Mapping[int, Channel]], decoder: PartDecoder, glitch: int
) -> tuple[dict[str, Mapping[int, Channel]], dict[str, int], list[str], list[str]]:
    """Return cleaned wires.

    Returns:
        Wires with known levels and without glitches; the number of glitches by port; pins with some unknown
        levels; pins without a known level.
    """
    clean: dict[str, Mapping[int, Channel]] = {}
    glitches: dict[str, int] = {}
    doubtful: list[str] = []
    blank: list[str] = []
    for port, places in bits.items():
        # The half period of a clock may be shorter than the limit.
        shortest = 0 if port == "clk" else glitch
        idle = {"rst_n": 1, **decoder.reset_levels, **decoder.inputs}.get(port, 0)
        own: dict[int, Channel] = {}
        touched = not isinstance(places, Bits)
        for bit in places:
            channel = places[bit]
            name = decoder.pins.text_of(port, bit)
            if channel.blank:
                blank.append(name)
                touched = True
                continue
            if channel.doubtful:
                doubtful.append(name)
                touched = True
                channel = channel.settled(idle >> bit & 1, port not in decoder.inputs)
            channel, dropped = without_glitches(channel, shortest)
            if dropped:
                glitches[port] = glitches.get(port, 0) + dropped
                touched = True
            own[bit] = channel
        if touched and own:
            clean[port] = own
        elif own:
            clean[port] = places
    return clean, glitches, doubtful, blank


def _check(decoder: PartDecoder, wires: Wires, capture: Capture, blank: Sequence[str]) -> None:
    """Raise CaptureError if a required pin is missing or was sampled too slowly."""
    needs = decoder.needs(wires)
    for pin in needs.pins:
        if pin in wires.ports:
            continue
        lost_levels = next((name for name in blank if name.partition("[")[0] == pin), None)
        if lost_levels:
            raise CaptureError(
                f"{capture.name}: {lost_levels} has no known level (x or z all the time): nothing can be "
                "read without it; capture it"
            )
        low = decoder.pins.low(pin)
        have = wires.bits.get(pin, {})
        if have:
            lost = next(bit for bit in range(decoder.pins.widths[pin]) if bit not in have)
            raise CaptureError(
                f"{capture.name}: {pin}[{lost + low}] is not in the map: nothing can be read without it"
            )
        raise CaptureError(f"{capture.name}: {pin} is not in the map: nothing can be read without it")
    finest = capture.finest
    if finest > needs.shortest // 2:
        short = needs.shortest / US
        raise CaptureError(
            f"{capture.name}: sampled every {finest / US:g} µs, but strobes or bits may be {short:g} µs "
            f"short: capture again with {max(1, round(2 / short))} MS/s or more"
        )
