"""Meanings of bytes as tables for the page, from the decoders of the models and the texts of `make demo`."""

from __future__ import annotations

import importlib
import re
from typing import Any

from cocotb_tests.bank.env import WORDS as BANK_REGISTERS
from cocotb_tests.harness.bus import MREF, MWEF
from cocotb_tests.harness.bus import NAMES as NAMES312
from cocotb_tests.harness.paths import ROOT
from openppmc.capture.common.mnemonics import END_STATUS, INPUTS, OUTPUTS, REMAINING, CommandDecoder
from openppmc.capture.pmc006 import mnemonics as line
from openppmc.capture.ppmc104.mnemonics import Ppmc104Decoder
from openppmc.capture.ppmc312 import mnemonics as block
from openppmc.model.motion.codes import Command, Kind
from openppmc.model.ppmc312.codes import MOTION_STARTS
from openppmc.model.ppmc312.codes import Code as Code312
from openppmc.model.ppmc312.front import serial
from scripts.site import rules

KINDS = {
    Kind.STOP: "immediate stop",
    Kind.SLOW_STOP: "decelerating stop",
    Kind.SWITCHING: "times of the chopper at standstill",
    Kind.HOLD_DELAY: "delay of HOLD",
    Kind.EXCITATION_OFF: "excitation off: all phases off, settings are invalid",
    Kind.AUX_INPUT: "read the auxiliary inputs",
    Kind.AUX_ON: "AUX on",
    Kind.AUX_OFF: "AUX off",
}
"""Meanings of commands that no demo sends, and of codes with don't-care bits."""
MOVE = "move flags:1 rate:2"
FORMS = {
    Code312.INITIAL: "table flags:1 start rate RS:2 high-speed rate RH:2 pulses NA:3"
    "/table flags:1 start rate RS:2 stop rate RP:2 high-speed rate RH:2 acceleration pulses NA:3"
    " deceleration pulses ND:3",
    Code312.FREE_CURVE: "table flags:1 stages up:1/table flags:1 stages up:1 stages down:1",
    Code312.IN_POSITION: "monitor flags:1 range:2",
    Code312.ENCODE: "monitor flags:1 range:2",
    Code312.INTERLOCK_POSITION: "position:4s",
    Code312.SPEED_LIMIT: "rate HSL:2",
    Code312.END_TERMINAL: "monitored:1",
    Code312.ORIGIN_SEARCH: MOVE,
    Code312.ZERO_RETURN: MOVE,
    Code312.OUTPUT: "outputs:1",
    Code312.MASK: "mode:1 mask:1",
    Code312.POSITION_READ: "encoder:1",
    Code312.POSITION_SET: "encoder:1 position:4s",
    Code312.EVENT_READ: "buffer:1",
    Code312.STOP: "move flags:1/move flags:1 at position:4s",
    Code312.SLOW_STOP: "move flags:1/move flags:1 at position:4s",
    Code312.RAMP: f"{MOVE} pulses:4/move flags:1 pulses:4",
    Code312.CONSTANT: f"{MOVE} pulses:4",
    Code312.STEP: "move flags:1",
    Code312.FOREVER_RAMP: MOVE,
    Code312.FOREVER_CONSTANT: MOVE,
    Code312.RAMP_CHANGE: f"{MOVE}/{MOVE} at position:4s",
    Code312.CHANGE: f"{MOVE}/{MOVE} at position:4s",
}
"""Parameters of the instructions of the PPMC-312, and below, of its answers and reports.

The alternative forms of an entry, separated by `/`, differ in length.
"""
ANSWERS = {
    Code312.FREE_CURVE: "list:1 missing values:1/list:1 pulses up:3 pulses down:3",
    Code312.INPUT: "inputs:1",
    Code312.TERMINALS: "alarm and limit pins:1 event pins:1",
    Code312.VERSION: "version:1",
    Code312.TABLE_READ: "rates:1 stages up:1 stages down:1 pulses up:3 pulses down:3",
    Code312.POSITION_READ: "encoder:1 position:4s",
    Code312.INTERLOCK: "on:1",
    Code312.RUN_MONITOR: "not monitored:1",
    Code312.EVENT_READ: "entries:1 next entry:1 codes:4",
    Code312.STATUS: "operation:1 condition:1 buffers:1",
    Code312.RAMP: "profile:1",
    Code312.FOREVER_RAMP: "profile:1",
    Code312.FOREVER_CONSTANT: "profile:1",
}
REPORT_FORMS = {
    0xE0: "cause:1 position:4s", 0xE3: "outside:1", 0xE4: "outside:1", 0xE9: "overwritten:1 changed bits:1",
    0xF1: "fault:1 condition:1", 0xF4: "alarm:1", 0xF5: "unknown code:1", 0xF6: "length received:1",
    0xF7: "buffer fault:1", 0xF8: "event fault:1", 0xF9: "override fault:1",
}  # fmt: skip
FLAGS = {
    "table flags": "8 MHz| | | |LE|FO|CLK bit 2|CLK bit 1|CLK bit 0",
    "monitor flags": "off| | | | | |FO|RES|EN",
    "move flags": "CW| |CCW| |IDX| |OV|trigger bit 1|trigger bit 0",
    "cause": "|alarm|normal end|origin|low speed|decelerating stop|stop|speed limit|limit",
    "condition": "| | |WRN|ABN|FIX|ACC|NOR|INI",
    "profile": "trapezoid| |acceleration only|deceleration only|triangle| | | |waits for RUN",
}
"""By parameter: the text for the value 0, and the names of its bits, bit 7 first."""
TITLES = re.compile(r"\[([0-9A-F]{2})(?:, [0-9A-F]{2})?\]\(#[^)]*\) \| ([^|]+) \|")
"""Row of the table of instructions in docs/ppmc312/instructions.md."""
HEADERS = {
    "> 03": "instruction", "> 02": "instruction, data blocks follow", "> 00": "data, more follow",
    "> 01": "data, the last", "< 03": "answer", "< 02": "answer, data blocks follow",
    "< 00": "data, more follow", "< 01": "data, the last", "< 0B": "answer of an event",
    "< 1B": "answer of an override", "< 23": "report",
}  # fmt: skip
SERIAL_REPORTS = {
    serial.ReportCode.INTERLOCK: "interlock released",
    serial.ReportCode.HOLD: "RUN: the held move has started",
    serial.ReportCode.ENCODE_INSIDE: "encoder deviation: in range",
    serial.ReportCode.ENCODE_OUTSIDE: "encoder deviation: out of range",
    serial.ReportCode.POSITION_INSIDE: "in position",
    serial.ReportCode.POSITION_OUTSIDE: "out of position",
    serial.ReportCode.OVERRIDE_DONE: "override executed",
    serial.ReportCode.EVENT_DONE: "event executed",
    serial.ReportCode.INPUT: "general inputs have changed",
    serial.ReportCode.CHECKSUM: "wrong checksum or character, nothing was executed",
    serial.ReportCode.PARAMETER: "rejected: parameter",
    serial.ReportCode.STATUS: "rejected: not in this state",
    serial.ReportCode.LIMIT: "rejected: the limit ahead is active",
    serial.ReportCode.ALARM: "alarm",
    serial.ReportCode.UNKNOWN: "rejected: no such code",
    serial.ReportCode.SIZE: "rejected: size",
    serial.ReportCode.REGISTRATION: "rejected: not registered",
    serial.ReportCode.EVENT_FAILED: "event failed",
    serial.ReportCode.OVERRIDE_FAILED: "override failed",
}
"""Reports and errors of a station in serial mode."""
NAMES = {
    "END code": {"00": "not stopped yet"}
    | {f"{code:02X}": f"stopped: {block.CAUSES[cause]}" for cause, code in serial.END_CODES.items()},
    "error code": {"00": "no error"} | {f"{code:02X}": text for code, text in SERIAL_REPORTS.items()},
}
"""Names of the values of a parameter."""
LOCAL = {
    serial.Local.END_STATUS: ("END code of the last stop", "P312-SER-46", "END code:1"),
    serial.Local.ERROR_CODE: ("last error code", "P312-SER-45", "error code:1"),
    serial.Local.ERROR_COUNT: (
        "error counts", "P312-SER-45", "framing errors:1 overruns:1 checksum errors:1"
    ),
}  # fmt: skip
"""Instructions that only the serial mode has: title, rule, answer."""
KINDS_OF_FRAMES = {
    "> 80": "poll", "> 90": "instruction", "< 80": "busy", "< 90": "ready", "< A0": "data",
    "< B0": "report or error",
}  # fmt: skip
TABLES = {END_STATUS: "end", INPUTS: "inputs", OUTPUTS: "outputs"}
REGISTERS = {
    f"{kind} {register}": names[place]
    for place, kind in enumerate(("read", "write"))
    for register, names in BANK_REGISTERS.items()
}
Field = tuple[str, int, int]
"""Data of a command: name, number of bytes, and a number that is added to the displayed value."""


def _fields(command: Command, words: CommandDecoder) -> list[Field]:
    pulses: Field = (f"{words.unit}s", 3, 1)
    fields: dict[Kind, list[Field]] = {
        Kind.INITIALISE: [(name, 1 + (name == "PA"), 0) for name in words.setting_names],
        Kind.SWITCHING: [("on time", 1, 0), ("off time", 1, 0)],
        Kind.HOLD_DELAY: [("delay", 1, 0)],
        Kind.AUX_OUTPUT: [("outputs", 1, 0)],
    }
    by_count: dict[int, list[Field]] = {1: [(words.rate, 1, 0)], 3: [pulses], 4: [(words.rate, 1, 0), pulses]}
    if not command.parameters:
        return []
    return by_count[command.parameters] if command.kind is Kind.OPERATION else fields[command.kind]


def _code(part: str, command: Command, words: CommandDecoder) -> dict[str, object]:
    code = command.code
    meaning = 0
    text = words.command(code, [])
    if command.kind in KINDS:
        axis = re.match(r"axis \d: ", text)
        text = (axis[0] if axis else "") + KINDS[command.kind]
    if command.kind is Kind.AUX_OUTPUT and command.parameters:
        text = "auxiliary outputs"
    answer, count = "", 0
    if command.kind in (Kind.READ, Kind.AUX_INPUT):
        plain = code & ~words.axis(code)
        meaning = words.read_codes.get(plain, plain)
        answer = TABLES.get(meaning, "number")
        name, count = words.reads.get(plain, (text, 1))
        if meaning == REMAINING:
            answer = f"remaining {words.unit}s"
        elif answer == "number":
            answer = name.removeprefix("read ")
    fields = [{"name": name, "bytes": size, "plus": plus} for name, size, plus in _fields(command, words)]
    rule = rules.rule_of(part, command, meaning)
    return {"text": text, "fields": fields, "answer": answer, "count": count, "rule": rule}


def tables(part: str, words: CommandDecoder) -> dict[str, Any]:
    """Return the tables of a part: codes, status, answers, meanings of the accesses of its host."""
    if part == "ppmc312":
        found = blocks()
    elif part == "ppmc312-serial":
        found = stations()
    elif part == "pmc006":
        found = frames()
    else:
        found = _bytes(part, words if part != "bank" else Ppmc104Decoder())
    more = {"P006-CMD-48"} if part == "pmc006" else set()
    if part == "ppmc312":
        more = {f"P312-PAR-0{n}" for n in (1, 3, 4, 5, 7, 9)} | {"P312-CMD-FC-2", "P312-RSP-10"}
    if part == "ppmc312-serial":
        more = {f"P312-SER-{n}" for n in (10, 14, 17, 20, 30)}
    if part == "bank":
        more, found["registers"] = {"BANK-WIN-02"}, REGISTERS
    names = more | {code["rule"] for code in found["codes"].values()} | {rules.STATUS[part]}
    return {**found, "statusRule": rules.STATUS[part], "rules": rules.used(names)}


def _bits(text: str) -> dict[str, object]:
    none, *names = (name.strip() for name in text.split("|"))
    return {"bits": names, "none": none}


def _forms(text: str) -> list[list[dict[str, object]]]:
    """Return alternative lists of parameters, separated by `/`: name, number of bytes, `s` for signed."""
    found = []
    for form in text.split("/"):
        words = re.findall(r"([\w ?-]+?):(\d)(s?)", form)
        found.append([
            {"name": name.strip(), "bytes": int(size), "plus": 0}
            | ({"signed": True} if signed else {})
            | (_bits(FLAGS[name.strip()]) if name.strip() in FLAGS else {})
            | ({"names": NAMES[name.strip()]} if name.strip() in NAMES else {})
            for name, size, signed in words
        ])  # fmt: skip
    return found


def _titles() -> dict[str, str]:
    """Return the title of each instruction of the PPMC-312 by its code on the parallel bus."""
    page = (ROOT / "docs/ppmc312/instructions.md").read_text(encoding="utf-8")
    return {**dict(TITLES.findall(page)), **{f"{code:02X}": text for code, text in block.SIMPLE.items()}}


def blocks() -> dict[str, Any]:
    """Return the tables of the PPMC-312: instructions by code, registers, reports, refusals."""
    flags = ((0x20, "interrupts armed"), (MWEF, "no space for a block"))
    titles = _titles()
    return {
        "codes": {
            f"{code:02X}": {
                "text": titles[f"{code:02X}"],
                "rule": f"P312-CMD-{code:02X}",
                "forms": _forms(FORMS.get(code, "")),
                "answerForms": _forms(ANSWERS.get(code, "")),
            }
            for code in Code312
        },
        "status": [
            ", ".join([
                *(text for bit, text in flags if byte & bit),
                "no answer" if byte & MREF else "an answer is pending",
            ])
            for byte in range(256)
        ],
        "answers": {},
        "registers": {f"{kind} {register}": name for (kind, register), name in NAMES312.items()},
        "reports": {f"{code:02X}": text for code, text in {**block.REPORTS, **block.REFUSALS}.items()},
        "causes": {str(bit): text for bit, text in block.CAUSES.items()},
        "headers": HEADERS,
        "reportForms": {f"{code:02X}": _forms(text) for code, text in REPORT_FORMS.items()},
        "reportRule": "P312-RSP-10",
    }  # fmt: skip


def _serial_title(instruction: serial.SerialInstruction) -> str:
    """Return the title of a serial instruction, whose code contains the flag byte of the bus."""
    parallel, flags = instruction.code, int.from_bytes(instruction.flags, "big")
    title = _titles()[f"{parallel:02X}"]
    if parallel == Code312.EVENT_SET:
        return f"{'delete from' if flags & 2 else 'register in'} event buffer {flags & 1}"
    if parallel in (Code312.POSITION_READ, Code312.POSITION_SET):
        return f"{'encoder' if flags else 'pulse'} {title}"
    if parallel in MOTION_STARTS:
        return f"{title}, {block.way(flags)}" + (", with index" if flags & block.IDX else "")
    # A position is a parameter.
    return f"{title}, {block.TRIGGERS[flags & 3]}" if flags & block.OV and flags & 1 else title


def _serial_forms(text: str, flags: bytes, size: int) -> list[list[dict[str, object]]]:
    """Return the lists of parameters of `size` bytes; with a flag byte on the bus, without this parameter."""
    forms = [form[1:] if flags else form for form in _forms(text)]
    return [form for form in forms if sum(int(str(one["bytes"])) for one in form) == size]


def stations() -> dict[str, Any]:
    """Return the tables of the PPMC-312 in serial mode: instructions by serial code, frames, reports."""
    codes: dict[str, dict[str, object]] = {
        f"{code:02X}": {
            "text": _serial_title(one),
            "rule": f"P312-CMD-{one.code:02X}",
            "forms": _serial_forms(FORMS.get(Code312(one.code), ""), one.flags, one.n),
            # A serial answer does not state which position it contains.
            "answerForms": _forms(ANSWERS.get(Code312(one.code), "").removeprefix("encoder:1 ")),
        }
        for code, one in serial.SERIAL_INSTRUCTIONS.items()
    }
    for code, (text, rule, answer) in LOCAL.items():
        codes[f"{code:02X}"] = {"text": text, "rule": rule, "answerForms": _forms(answer)}
    return {
        "codes": codes,
        "status": [],
        "answers": {},
        "headers": KINDS_OF_FRAMES,
        "reports": {f"{code:02X}": text for code, text in SERIAL_REPORTS.items()},
        "reportForms": {f"{serial.ReportCode.INPUT:02X}": _forms(REPORT_FORMS[0xE9])},
        "reportRule": "P312-SER-20",
        "pollForms": _forms("END code:1"),
    }


def frames() -> dict[str, Any]:
    """Return the tables of the PMC006B4: instructions by letter."""
    return {
        "codes": {
            letter: {"text": text, "rule": rules.letters().get(letter, "P006-CMD-48")}
            for letter, text in line.MEANINGS.items()
        },
        "status": [line.status(byte) for byte in range(256)],
        "answers": {},
    }


def _bytes(part: str, words: CommandDecoder) -> dict[str, Any]:
    """Return the tables of a part with commands of one byte."""
    folder = {"stmc": "stmc", "ppmc2104": "ppmc2104"}.get(part, "single")
    decode = importlib.import_module(f"openppmc.model.{folder}.codes").decode
    commands = [decode(code) for code in range(256)]
    return {
        "codes": {
            f"{one.code:02X}": _code(part, one, words) for one in commands if one.kind is not Kind.UNDEFINED
        },
        "status": [words.status(byte) for byte in range(256)],
        "answers": {
            "end": [words.end(byte) for byte in range(256)],
            "inputs": [words.inputs(byte) for byte in range(256)],
            "outputs": [words.outputs(byte) for byte in range(256)],
        },
    }
