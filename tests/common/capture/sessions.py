"""Sessions of each device as an analyser would record them: a host initialises, moves and reads."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from openppmc.host.ppmc312 import blocks
from openppmc.model.pmc006.line import command
from openppmc.model.pmc006.part import Pmc006
from openppmc.model.ppmc104 import Ppmc104
from openppmc.model.ppmc312.front.serial import INSTRUCTION, POLL, frame
from openppmc.model.ppmc312.part import Ppmc312
from openppmc.model.ppmc2104.part import Ppmc2104
from openppmc.model.stmc.part import Stmc

CLK_HZ = 20_000_000
"""Clock frequency of the recorded device; the golden model of the comparison has another one."""
US = CLK_HZ // 1_000_000
MS = 1000 * US


@dataclass
class PinLog:
    """A model of a device that records the changes of its pins.

    Attributes:
        inputs, outputs: levels before the first change.
    """

    part: str
    model: Any
    inputs: dict[str, int] = field(default_factory=dict)
    outputs: dict[str, int] = field(default_factory=dict)
    changes: list[tuple[int, str, int]] = field(default_factory=list)
    end: int = 0

    def __post_init__(self) -> None:
        real = self.model.pins
        self.inputs = dict(self.model.inputs)
        self.outputs = dict(self.model.log.initial)

        def pins(t: int, **levels: int) -> None:
            self.changes += [(t, pin, level) for pin, level in levels.items()]
            real(t, **levels)

        self.model.pins = pins

    def reset(self) -> int:
        """Reset at power-up; return the time of its end."""
        self.model.pins(20 * US, rst_n=0)
        self.model.pins(40 * US, rst_n=1)
        return 45 * US

    def finish(self, t: int) -> PinLog:
        """Run to time t, at which the recording ends."""
        self.model.run_until(t)
        self.end = t
        return self


def _bytes(log: PinLog, t: int, *written: tuple[int, int]) -> int:
    """Write (register, byte) pairs, each followed by a status read; return the time after the last read."""
    for register, byte in written:
        t = log.model.write(t, register, byte, strobe=11) + 2 * US
        log.model.read(t, 1, strobe=11)
        t += 2 * US
    return t


def _answers(log: PinLog, t: int, code: int, count: int) -> int:
    t = _bytes(log, t, (1, code)) + 20 * US
    for _ in range(count):
        log.model.read(t, 0, strobe=11)
        t += 20 * US
    return t


def ppmc104() -> PinLog:
    """Record a ramped move, and a move that ends at a limit."""
    log = PinLog("ppmc104", Ppmc104(CLK_HZ))
    t = _bytes(log, log.reset(), (1, 0x2A), (0, 99), (0, 9), (0, 60), (0, 0)) + 3 * MS
    t = _bytes(log, t, (1, 0x43), (0, 199), (0, 0), (0, 0)) + 25 * MS
    t = _answers(log, t, 0x80, 1)
    t = _bytes(log, t + 10 * MS, (1, 0x4D), (0, 49)) + 3 * MS
    log.model.pins(t, l2_n=0)
    t = _answers(log, t + MS, 0x83, 3)
    return log.finish(t + 45 * MS)


def ppmc2104() -> PinLog:
    """Record a move of both axes at the same time, then a single step."""
    log = PinLog("ppmc2104", Ppmc2104(CLK_HZ))
    t = _bytes(log, log.reset(), (1, 0x12), (0, 127), (0, 39), (0, 50), (0, 0)) + 3 * MS
    t = _bytes(log, t, (1, 0x36), (0, 255), (0, 79), (0, 30), (0, 0)) + 3 * MS
    t = _bytes(log, t, (1, 0x43), (0, 150), (0, 0), (0, 0), (1, 0x6B), (0, 90), (0, 0), (0, 0)) + 60 * MS
    t = _answers(log, t, 0x80, 1)
    t = _answers(log, t, 0xA0, 1)
    t = _bytes(log, t, (1, 0x42)) + 5 * MS
    return log.finish(t + 20 * MS)


def stmc() -> PinLog:
    """Record a ramped move forwards, then one backwards."""
    log = PinLog("stmc", Stmc(CLK_HZ))
    t = _bytes(log, log.reset(), (1, 0x0A), (0, 20), (0, 4), (0, 20), (0, 0)) + 3 * MS
    t = _bytes(log, t, (1, 0x43), (0, 99), (0, 0), (0, 0)) + 90 * MS
    t = _answers(log, t, 0x80, 1)
    t = _bytes(log, t, (1, 0x4B), (0, 10), (0, 0), (0, 0)) + 30 * MS
    return log.finish(t)


def ppmc312() -> PinLog:
    """Record blocks through the read and write windows: a table, a move, the report of its end."""
    log = PinLog("ppmc312", Ppmc312(CLK_HZ))
    model, t = log.model, log.reset()

    def access(t: int, write: bool, rs: int, byte: int = 0) -> int:
        levels = {"cs_n": 0, "we_n" if write else "oe_n": 0, "rs": rs}
        model.pins(t, **levels, **({"d_i": byte} if write else {}))
        model.pins(t + 12, cs_n=1, we_n=1, oe_n=1)
        return t + 24

    def send(t: int, block: bytes) -> int:
        t = access(t, True, 2, 0x20)
        t = access(t, True, 3, blocks.start_address(block))
        for byte in blocks.bus_order(block):
            t = access(t, True, 5, byte)
        return t

    def fetch(t: int, size: int) -> int:
        t = access(access(t, False, 0), False, 3)
        for _ in range(size):
            t = access(t, False, 7)
        return t + 2 * US

    t = send(t + 2 * MS, bytes.fromhex("03 09 00 00 01 40 00 40 00 04 7E")) + 4 * MS
    t = fetch(t, 3)
    t = send(t, blocks.acceleration(blocks.CCW, 500)) + 20 * MS
    t = fetch(fetch(t, 4), 8)
    t = send(t, blocks.block(0x42, b"\x00")) + 100 * US
    return log.finish(fetch(t, 8) + 110 * MS)


def _say(log: PinLog, t: int, data: bytes, baud: int) -> int:
    """Send characters on rxd."""
    bit = CLK_HZ / baud
    for number, byte in enumerate(data):
        levels = [0, *(byte >> place & 1 for place in range(8)), 1]
        for place, level in enumerate(levels):
            log.model.pins(t + round((number * 10 + place) * bit), rxd=level)
    return t + round(len(data) * 10 * bit)


def ppmc312_serial() -> PinLog:
    """Record frames to two stations of which only one is present."""
    log = PinLog("ppmc312-serial", Ppmc312(CLK_HZ, straps={"mode": 0, "mod": 6, "adr": 3}))
    t = log.reset() + 3 * MS
    for station, data in ((3, "00000140004000047e"), (5, "42"), (3, "8300000000012c"), (3, "42")):
        t = _say(log, t, frame(INSTRUCTION | station, bytes.fromhex(data)), 38_400) + 8 * MS
    t = _say(log, t + 30 * MS, frame(POLL | 3), 38_400) + 6 * MS
    return log.finish(t)


def pmc006() -> PinLog:
    """Record settings, a move and its end, in frames."""
    log = PinLog("pmc006", Pmc006(CLK_HZ, baud=19_200))
    t = log.reset() + 90 * MS
    for code, value in (
        ("j", 0),
        ("m", 8),
        ("v", 2000),
        ("L", 800),
        ("S", 800),
        ("s", 60),
        ("j", 0),
        ("c", 0),
    ):
        t = _say(log, t, command(255, code, value), 19_200) + 12 * MS
    return log.finish(t + 40 * MS)


SESSIONS: dict[str, Callable[[], PinLog]] = {
    "ppmc104": ppmc104,
    "ppmc2104": ppmc2104,
    "stmc": stmc,
    "ppmc312": ppmc312,
    "ppmc312-serial": ppmc312_serial,
    "pmc006": pmc006,
}
