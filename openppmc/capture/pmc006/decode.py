"""The line of PMC006B4 as text: frames of host and controllers.

The PMC006B4 drives the motor directly, so there are no pulses to capture.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ...model.pmc006.codes import LETTERS
from ...model.pmc006.line import ANSWER, HEAD, SIZE, command
from ...model.pmc006.part import Pmc006
from ...model.pmc006.pins import INPUTS, OUTPUTS, WIDTHS
from ..common.characters import Character, characters, rate_of
from ..common.part_decoder import Line, Needs, PartDecoder, PulseTrain, Wires
from ..common.pinmap import Pins
from .mnemonics import MEANINGS

RATES = (9600.0, 19_200.0, 38_400.0, 57_600.0, 115_200.0, 4800.0, 2400.0, 1200.0)
SHORTEST = 8_600_000
FACTORY = 255


def _rate(wires: Wires) -> float:
    if "BAUD" in wires.params:
        return float(str(wires.params["BAUD"]))
    return rate_of(wires.ports["rxd"], RATES, "rxd")


def _lines(wires: Wires) -> list[Line]:
    rate = _rate(wires)
    lines = _frames(characters(wires.ports["rxd"], rate))
    if "txd" in wires.ports:
        lines += _frames(characters(wires.ports["txd"], rate))
    return sorted(lines, key=lambda line: line.t)


def _frames(found: list[Character]) -> list[Line]:
    lines: list[Line] = []
    run: list[Character] = []
    for one in found:
        if run and (one.byte is None or one.begin - run[-1].end > 2 * (one.end - one.begin)):
            lines.append(_broken(run))
            run = []
        if not run and one.byte != HEAD:
            lines.append(Line(one.begin, "??" if one.byte is None else f"{one.byte:02X}", "no frame", True))
            continue
        run.append(one)
        if len(run) == SIZE:
            lines.append(_frame(run))
            run = []
    if run:
        lines.append(_broken(run))
    return lines


def _broken(run: list[Character]) -> Line:
    shown = " ".join("??" if one.byte is None else f"{one.byte:02X}" for one in run)
    return Line(run[0].begin, shown, f"no whole frame: {len(run)} of {SIZE} bytes", True)


def _frame(run: list[Character]) -> Line:
    data = bytes(one.byte or 0 for one in run)
    shown, value = data.hex(" ").upper(), int.from_bytes(data[3:7], "little", signed=True)
    if sum(data[:-1]) & 0xFF != data[-1]:
        return Line(run[0].begin, shown, "wrong check", True, end=run[-1].end)
    if data[1] == ANSWER:
        return Line(run[0].begin, "→ " + shown, f"controller {data[2]}: {value}", end=run[-1].end)
    letter = chr(data[2])
    known = letter in LETTERS
    number = value & 0xFFFF_FFFF if letter == "W" else value
    text = MEANINGS[letter].format(number) if known else f"no instruction ({data[2]:02X})"
    return Line(run[0].begin, shown, f"to controller {data[1]}: {text}", not known, end=run[-1].end)


def _stimulus(wires: Wires) -> Iterator[tuple[int, dict[str, int]]]:
    return ((t, {"rxd": level}) for t, level in wires.ports["rxd"])


def _trains(wires: Wires) -> list[PulseTrain]:
    step = wires.bits.get("mon_step", {}).get(0)
    if step is None:
        return []
    way = wires.bits.get("mon_dir", {}).get(0)
    times = step.times[step.levels == 1]
    return [PulseTrain(1, times, None if way is None else 1 - way.at_all(times))]


def _named(model: Pmc006, wires: Wires) -> None:
    """Set the address of a new model.

    The address is that of the controller that replies or, if none replies, the address to which frames are
    sent.
    """
    found = [line.data.split() for line in _lines(wires) if not line.invalid]
    replies = [words[3] for words in found if words[0] == "→"]
    asked = [words[1] for words in found if words[0] != "→"]
    if not replies and not asked:
        return
    address = int(Counter(replies or asked).most_common(1)[0][0], 16)
    if address != FACTORY:
        t = model.timebase.clk_hz // 50
        for byte in command(FACTORY, "w", address):
            model.on_char(t, byte)
            t += 16


NAMES = {name: WIDTHS.get(name, 1) for name in (*INPUTS, *OUTPUTS)} | {"clk": 1}
_INSIDE = (
    "phase_a_ref",
    "phase_b_ref",
    "phase_a_sign",
    "phase_b_sign",
    "scl_o",
    "sda_o",
    "pwm_a_ref",
    "pwm_b_ref",
)
_DRIVE = ("bridge_a_en", "bridge_b_en", "m10", "m11", "m20", "m21", "scl_oe", "sda_oe")
DECODER = PartDecoder(
    "a PMC006B4",
    Pins(NAMES, {"gpi": 1, "gpo": 1}),
    INPUTS,
    lambda wires: Needs(("rxd",), SHORTEST),
    _lines,
    _stimulus,
    _trains,
    frozenset(("rxd",)),
    tuple(name for name in OUTPUTS if name not in (*_INSIDE, *_DRIVE)),
    parameters=lambda wires: {"BAUD": round(_rate(wires))},
    prelude=_named,
    initialised=False,
    pause=30 * 10**9,
    row_noun="frames",
    reset_levels=OUTPUTS,
)
