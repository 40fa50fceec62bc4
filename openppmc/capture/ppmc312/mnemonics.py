"""Blocks of a PPMC-312 host as text."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

from ...model.ppmc312.codes import SHAPES
from ..common.mnemonics import CommandDecoder

OV, DIR, IDX, LE, FO = 0x04, 0x40, 0x10, 0x10, 0x08
CLOCKS = ("8 MHz", "1 MHz", "500 kHz", "250 kHz", "62.5 kHz", "15.6 kHz", "EXTCK", "EXTCK falling")
TRIGGERS = ("at position", "on event 0", "at position", "on event 1")
CAUSES = {
    0x80: "alarm",
    0x40: "all pulses made",
    0x20: "origin",
    0x10: "already slow",
    0x08: "decelerating stop",
    0x04: "immediate stop",
    0x02: "high-speed limit",
    0x01: "limit",
}
SIMPLE = {
    0x20: "excitation on",
    0x21: "excitation off",
    0x22: "counter clear",
    0x23: "zero clamp",
    0x24: "alarm clear",
    0x25: "read general inputs",
    0x27: "read control inputs",
    0x40: "read version",
    0x41: "read table",
    0x44: "interlock on/off",
    0x45: "RUN monitor on/off",
    0x4D: "read status",
    0xFF: "reset",
}
REPORTS = {0xE1: "interlock position reached", 0xE2: "RUN: the held operation starts", 0xE8: "registered"}
REFUSALS = {
    0xF0: "parameter",
    0xF1: "not in this state",
    0xF2: "limit",
    0xF4: "ALARM",
    0xF5: "no such code",
    0xF6: "size",
    0xF7: "not registered",
    0xF8: "event interrupted",
    0xF9: "override interrupted",
}
STATES = {1: "INI", 2: "NOR", 4: "ACC", 8: "FIX", 16: "ABN", 32: "WRN"}
REPORT_BITS = 0x38  # bits of a header; all are 0 if the block is an answer to an instruction of the host
CUT = "cut short"
FROM = {0x0B: "by the event: ", 0x1B: "by override: "}


def number(data: bytes) -> int:
    """Decode an unsigned number; the most significant byte is the first."""
    return int.from_bytes(data, "big")


def position(data: bytes) -> int:
    """Decode a signed number; the most significant byte is the first."""
    return int.from_bytes(data, "big", signed=True)


def way(flags: int) -> str:
    """Return the direction bit as text."""
    return "CCW" if flags & DIR else "CW"


def when(flags: int, rest: bytes) -> str:
    """Return the condition for which a registered instruction waits, as text."""
    if not flags & OV:
        return ""
    trigger = TRIGGERS[flags & 3]
    return f", {trigger}" + (f" {position(rest)}" if "position" in trigger else "")


def initial(par: bytes) -> str:
    """Return the parameters of instruction 00 as text."""
    method = "sigmoid" if par[0] & FO else "linear"
    rates = f"{number(par[1:3])} to {number(par[3:5])}" if len(par) == 8 else "own stop rate"
    pulses = f", {number(par[5:8])} pulses" if len(par) == 8 else ""
    return f"initial setting: {method}, {CLOCKS[par[0] & 7]}, rates {rates}{pulses}"


def rate(data: bytes) -> str:
    """Return a rate as text, 0 = high speed."""
    return f"rate {number(data)}" if number(data) else "high speed"


def _counted(name: str) -> Callable[[bytes], str]:
    return lambda p: f"{name}, {way(p[0])}, {rate(p[1:3])}, {number(p[3:7])} pulses{when(p[0], p[3:])}"


def _endless(name: str) -> Callable[[bytes], str]:
    return lambda p: f"{name}, {way(p[0])}, {rate(p[1:3])}{when(p[0], p[3:])}"


INSTRUCTIONS: dict[int, Callable[[bytes], str]] = {
    0x00: initial,
    0x01: lambda p: f"free curve: {CLOCKS[p[0] & 7]}, {p[1]} stages",
    0x10: _endless("origin search"),
    0x11: _endless("zero return"),
    0x42: lambda p: f"read {'encoder' if p[0] else 'pulse'} position",
    0x43: lambda p: f"set {'encoder' if p[0] else 'pulse'} position {position(p[1:])}",
    0x80: lambda p: "immediate stop" + when(p[0], p[1:]),
    0x81: lambda p: "decelerating stop" + when(p[0], p[1:]),
    0x82: _counted("accelerate/decelerate"),
    0x83: _counted("constant speed"),
    0x84: lambda p: f"single pulse, {way(p[0])}",
    0x85: _endless("continuous, with ramp"),
    0x86: _endless("continuous, constant"),
    0x87: lambda p: f"ramp to {rate(p[1:3])}{when(p[0], p[3:])}",
    0x88: lambda p: f"{rate(p[1:3])} at once{when(p[0], p[3:])}",
}


def block_words(block: bytes) -> str:
    """Return an instruction or data block as text."""
    if block[0] < 2:
        return "free curve: data" + (", the last" if block[0] else "")
    try:
        code, par = block[2], block[3:]
        return (
            INSTRUCTIONS[code](par) if code in INSTRUCTIONS else SIMPLE.get(code, f"instruction {code:02X}")
        )
    except IndexError:
        return CUT


def answer_words(block: bytes) -> str:
    """Return an answer or a report as text."""
    code, par = block[2], block[3:]
    who = FROM.get(block[0], "")
    if code == 0xE0:
        return f"stopped at {position(par[1:])}: {CAUSES[par[0]]}"
    if code in REPORTS:
        return REPORTS[code]
    if code in REFUSALS:
        return f"{REFUSALS[code]} {par[:1].hex().upper()}".strip()
    if code == 0x4D:
        return f"state {STATES[par[1]]}, {par[2] & 15} waiting"
    if code == 0x42:
        return f"{position(par[1:])}"
    if code == 0x40:
        return f"version {par.hex().upper()}"
    if code == 0x01 and par[0] != 0x0F:
        return f"{par[1]} {('rates', 'up', 'down')[par[0]]} to come"
    if code == 0x01:
        return f"done: {number(par[1:4])} up, {number(par[4:7])} down"
    if code == 0x82:
        return f"{who}{SHAPES[par[0] & 0x70]}" + (", held" if par[0] & 1 else "")
    return f"{who}{'held' if par and par[0] & 1 else 'done'}"


@dataclass
class Row:
    """Instruction with its answer, or a report.

    The bytes of a block are in logical order, which begins with the header.

    Attributes:
        t: time in cycles.
    """

    t: int
    sent: list[int] = field(default_factory=list)
    answer: list[int] = field(default_factory=list)
    polls: list[int] = field(default_factory=list)
    meaning: str = ""

    @property
    def reply(self) -> str:
        """Answer as text."""
        return answer_words(bytes(self.answer)) if self.answer else ""

    @property
    def statuses(self) -> list[int]:
        """CSR values in order of time, without repetitions."""
        return [byte for index, byte in enumerate(self.polls) if index == 0 or byte != self.polls[index - 1]]


class Ppmc312Decoder(CommandDecoder):
    """Decoder for the bytes of a PPMC-312: blocks instead of single bytes."""

    def exchanges(self, accesses: Iterable[Any]) -> list[Row]:
        """Group register accesses into instructions and reports."""
        rows: list[Row] = []
        # Instructions that have had no answer so far.
        waiting: list[Row] = []
        data: list[int] = []
        wanted, polls, begin = 0, [], 0
        for access in accesses:
            name = access.kind.split()[0]
            if access.kind == "CSR :=":
                rows.append(Row(access.t, [access.byte], meaning="CSR: interrupts"))
            elif name == "CSR":
                polls.append(access.byte)
            elif access.kind == "WAR :=":
                wanted, data, begin = 0x20 - access.byte, [], access.t
            elif name in ("DWR", "DRR") and len(data) < wanted:
                data.insert(0, access.byte)
                if len(data) == wanted and name == "DWR":
                    rows.append(row := Row(begin, data, [], polls, block_words(bytes(data))))
                    waiting += [row] if len(data) > 1 else []
                    polls = []
                elif len(data) == wanted:
                    if data[0] & REPORT_BITS == 0 and waiting:
                        row = waiting.pop()
                    else:
                        rows.append(row := Row(begin, meaning="interrupt"))
                    row.answer, row.polls, polls = data, [*row.polls, *polls], []
            elif name == "RAR":
                wanted, data, begin = 0x40 - access.byte, [], access.t
        return rows
