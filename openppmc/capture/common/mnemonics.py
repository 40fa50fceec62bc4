"""Bytes of a host as text: code that all parts share.

The accesses of the host are grouped into commands.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

# Operations by the lowest three bits of their code: name and number of data bytes.
OPERATIONS = {
    2: ("single step", 0),
    3: ("accelerate/decelerate", 3),
    4: ("constant speed", 4),
    5: ("continuous constant speed", 1),
    6: ("continuous high speed", 0),
    7: ("origin search", 1),
}
CAUSES = ((0x40, "a stop command"), (0x20, "ALM"), (0x10, "the limit"), (0x08, "the slow-down limit"))
END_STATUS, INPUTS, OUTPUTS, REMAINING = 0x80, 0x81, 0x82, 0x83


class CommandDecoder:
    """Decoder for the bytes of a part.

    Subclasses decode the status register, the initialisation, further codes and the pins.
    """

    operations = OPERATIONS
    causes: Sequence[tuple[int, str]] = CAUSES
    reads: Mapping[int, tuple[str, int]] = {}
    read_codes: Mapping[int, int] = {}  # codes of read commands that differ from END_STATUS, INPUTS, …
    switches: Sequence[tuple[int, str]] = ()
    unit, speed, rate = "pulse", "kpps", "rate"
    setting_names: Sequence[str] = ("RL", "RH", "PA")  # data of an initialisation; PA has two bytes

    def count(self, pulses: int) -> str:
        """Return a number of pulses or steps as text."""
        return f"{pulses} {self.unit}{'s' if pulses != 1 else ''}"

    def exchanges(self, accesses: Iterable[Any]) -> Sequence[Any]:
        """Return the accesses of a host as rows. `Exchange` describes the members of a row."""
        return exchanges(self, accesses)

    def axis(self, code: int) -> int:
        """Return the bits of a code that select an axis."""
        return 0

    def status(self, byte: int) -> str:
        """Return the status register as text."""
        raise NotImplementedError

    def setting(self, code: int, data: Sequence[int]) -> str:
        """Return an initialisation with its data as text."""
        raise NotImplementedError

    def other(self, code: int, data: Sequence[int]) -> str:
        """Return any other code (no initialisation, read or operation) as text."""
        return {0x40: "immediate stop", 0x41: "decelerating stop"}.get(code, f"command {code:02X}")

    def phases(self, byte: int) -> str:
        """Return the phase bits of the output register as text."""
        high = [f"S{index + 1}" for index in range(5) if byte & 0x80 >> index]
        return f"{' '.join(high) or 'no phase'} high"

    def end(self, byte: int) -> str:
        """Return the finish status or end status as text: how the last operation ended."""
        name = self.operations.get(byte & 7, ("no operation yet", 0))[0]
        if not byte & 7:
            return name
        causes = [text for bit, text in self.causes if byte & bit]
        return f"{name}: {'ended by ' + ' and '.join(causes) if causes else f'all {self.unit}s made'}"

    def inputs(self, byte: int) -> str:
        """Return the active (low) input signals as text."""
        active = [name for bit, name in self.switches if not byte & bit]
        return f"active: {', '.join(active)}" if active else "no switch active"

    def outputs(self, byte: int) -> str:
        """Return phases, HOLD and DIR as text."""
        hold, direction = "high" if byte & 4 else "low", "CCW" if byte & 2 else "CW"
        return f"{self.phases(byte)}, HOLD {hold}, {direction}"

    def ramp(self, data: Sequence[int]) -> str:
        """Return the data of an initialisation as text, or an empty text if they are incomplete."""
        if len(data) < 4:
            return ""
        return f"; RL {data[0]}, RH {data[1]}, PA {data[2] | data[3] << 8}"

    def command(self, code: int, data: Sequence[int]) -> str:
        """Return a command with its data bytes as text."""
        axis = self.axis(code)
        code &= ~axis
        if code < 0x40:
            return self.setting(code | axis, data)
        if code in self.reads:
            return self.reads[code][0]
        if code & 7 in self.operations and (code & 0xC0 == 0x40 or code & 0xC7 in (0xC3, 0xC6)):
            name, count = self.operations[code & 7]
            words = [name, "CCW" if code & 8 else "CW"]
            values = list(data)
            if count in (1, 4) and values:
                words.append(f"{self.rate} {values.pop(0)}")
            if len(values) == 3:
                words.append(self.count((values[0] | values[1] << 8 | values[2] << 16) + 1))
            return ", ".join(words)
        return self.other(code | axis, data)

    def answer(self, code: int, data: Sequence[int], stopped: bool) -> str:
        """Return the bytes with which the part answered a read command, as text.

        Args:
            stopped: True if the last end status contained a cause of a stop.
        """
        code = self.read_codes.get(code, code)
        if code == END_STATUS:
            return self.end(data[0])
        if code == INPUTS:
            return self.inputs(data[0])
        if code == OUTPUTS:
            return self.outputs(data[0])
        if code == REMAINING and len(data) == 3:
            left = (data[0] | data[1] << 8 | data[2] << 16) + stopped
            return f"{self.count(left)} not made" if left else f"no {self.unit} left"
        return ""


class OneAxisDecoder(CommandDecoder):
    """Decoder for a part with one axis.

    Its status register holds an error number or the number of expected bytes.

    Attributes:
        errors: texts of the errors.
        clock: name of the external clock.
    """

    errors: Sequence[str] = ()
    clock = "CLOCK pin"

    def status(self, byte: int) -> str:
        """Return the status register as text.

        The text contains the flags that are set, and the error or the number of expected bytes.
        """
        flags = [name for bit, name in ((4, "BUSY"), (2, "IBF"), (1, "OBF")) if byte & bit]
        number = byte >> 4 & 7
        if byte & 0x80:
            flags.append(f"error {number}: {self.errors[number]}")
        elif number:
            flags.append(f"{number} more byte{'s' if number > 1 else ''} expected")
        return ", ".join(flags) or "ready, nothing pending"

    def setting(self, code: int, data: Sequence[int]) -> str:
        """Return motor, step, level, clock, chopping and ramp as text."""
        step, level = "half" if code & 4 else "full", "high" if code & 8 else "low"
        phases = f"{(code & 3) + 2} phases, {step} step, {level} = on"
        clock = self.clock if code & 0x10 else "internal clock"
        chop = "chopped at rest" if code & 0x20 else "full current at rest"
        return f"initialise: {phases}, {clock}, {chop}{self.ramp(data)}"


@dataclass
class Exchange:
    """A command with its data and its response, and the status bytes that were read during the command.

    Attributes:
        t: time of the command in cycles.
    """

    decoder: CommandDecoder
    t: int
    sent: list[int] = field(default_factory=list)
    answer: list[int] = field(default_factory=list)
    polls: list[int] = field(default_factory=list)
    stopped: bool = False

    @property
    def read(self) -> int:
        """Command code without the bits that select the axis; -1 if there is no code."""
        return self.sent[0] & ~self.decoder.axis(self.sent[0]) if self.sent else -1

    @property
    def meaning(self) -> str:
        """Bytes sent as text."""
        return self.decoder.command(self.sent[0], self.sent[1:]) if self.sent else "read the status register"

    @property
    def reply(self) -> str:
        """Response as text; if there is no response, the last status."""
        if self.sent and self.answer:
            return self.decoder.answer(self.read, self.answer, self.stopped)
        return self.decoder.status(self.polls[-1]) if self.polls else ""

    @property
    def statuses(self) -> list[int]:
        """Status bytes with IBF = 0, in order of time, without repetitions.

        They show how the chip reacted to each byte.
        """
        taken = [byte for byte in self.polls if not byte & 2]
        return [byte for index, byte in enumerate(taken) if index == 0 or byte != taken[index - 1]]


def exchanges(decoder: CommandDecoder, accesses: Iterable[Any]) -> list[Exchange]:
    """Group the accesses of a host (t, kind, reg, byte) into exchanges.

    Each exchange begins with a command byte.
    """
    rows: list[Exchange] = []
    stopped: dict[int, bool] = {}
    for access in accesses:
        if access.kind == "write" and access.reg == 1:
            was = stopped.get(decoder.axis(access.byte), False)
            rows.append(Exchange(decoder, access.t, [access.byte], stopped=was))
            continue
        if not rows:
            rows.append(Exchange(decoder, access.t))
        if access.kind == "write":
            rows[-1].sent.append(access.byte)
        elif access.reg == 1:
            rows[-1].polls.append(access.byte)
        else:
            rows[-1].answer.append(access.byte)
            if rows[-1].read == END_STATUS:
                stopped[decoder.axis(rows[-1].sent[0])] = bool(access.byte & 0x78)
    return rows
