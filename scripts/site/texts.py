"""Meanings of bytes as tables for the page, from the decoders of the models and the texts of `make demo`."""

from __future__ import annotations

import importlib
import re
from typing import Any

from cocotb_tests.bank.env import WORDS as BANK_REGISTERS
from cocotb_tests.harness.bus import MREF, MWEF
from cocotb_tests.harness.bus import NAMES as NAMES312
from openppmc.capture.common.mnemonics import END_STATUS, INPUTS, OUTPUTS, REMAINING, CommandDecoder
from openppmc.capture.pmc006 import mnemonics as line
from openppmc.capture.ppmc104.mnemonics import Ppmc104Decoder
from openppmc.capture.ppmc312 import mnemonics as block
from openppmc.model.motion.codes import Command, Kind
from openppmc.model.ppmc312.codes import Code as Code312

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
"""Meanings of the commands that no demo sends, and of command codes with don't-care bits."""
TABLES = {END_STATUS: "end", INPUTS: "inputs", OUTPUTS: "outputs"}
REGISTERS = {
    f"{kind} {register}": names[place]
    for place, kind in enumerate(("read", "write"))
    for register, names in BANK_REGISTERS.items()
}
Field = tuple[str, int, int]
"""Data of a command: name, number of bytes, and the number that is added before the value is displayed."""


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


def _code(command: Command, words: CommandDecoder) -> dict[str, object]:
    code = command.code
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
    return {"text": text, "fields": fields, "answer": answer, "count": count}


def tables(part: str, words: CommandDecoder) -> dict[str, Any]:
    """Return the tables of a part: codes, status, answers, and the meanings of its host's accesses."""
    if part == "ppmc312":
        return blocks()
    if part == "pmc006":
        return frames()
    found = _bytes(part, words if part != "bank" else Ppmc104Decoder())
    return {**found, "registers": REGISTERS} if part == "bank" else found


def blocks() -> dict[str, Any]:
    """Return the tables of the PPMC-312: instructions by code, registers, reports, refusals."""
    flags = ((0x20, "interrupts armed"), (MWEF, "no space for a block"))
    return {
        "codes": {
            f"{code:02X}": {"text": block.SIMPLE.get(code, code.name.lower().replace("_", " "))}
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
    }  # fmt: skip


def frames() -> dict[str, Any]:
    """Return the tables of the PMC006B4: instructions by letter."""
    return {
        "codes": {letter: {"text": text} for letter, text in line.MEANINGS.items()},
        "status": [line.status(byte) for byte in range(256)],
        "answers": {},
    }


def _bytes(part: str, words: CommandDecoder) -> dict[str, Any]:
    """Return the tables of a part with commands of one byte."""
    folder = {"stmc": "stmc", "ppmc2104": "ppmc2104"}.get(part, "single")
    decode = importlib.import_module(f"openppmc.model.{folder}.codes").decode
    commands = [decode(code) for code in range(256)]
    return {
        "codes": {f"{one.code:02X}": _code(one, words) for one in commands if one.kind is not Kind.UNDEFINED},
        "status": [words.status(byte) for byte in range(256)],
        "answers": {
            "end": [words.end(byte) for byte in range(256)],
            "inputs": [words.inputs(byte) for byte in range(256)],
            "outputs": [words.outputs(byte) for byte in range(256)],
        },
    }
