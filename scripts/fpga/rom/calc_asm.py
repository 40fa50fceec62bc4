"""Assembler of the planner's program (rtl/pmc006/motion/pmc006_calc.asm): text in, words of 17 bits out.

Names and codes of operations, operands, conditions, outputs and phases are read from pmc006_calc_pkg.sv, the
one place where they stand. A word is {operation, aux, operand}: 4, 4 and 9 bits.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches

WORDS = 512
"""Size of the ROM."""
ENTRY = "Entry"
"""What labels begin with that the RTL knows."""
FEW = 8
"""So many names are told where one is wrong."""
SUMS = ("load", "add", "sub", "div")
WHERE = {(): "Plain", ("dec",): "Dec", ("lo",): "Low", ("lo", "dec"): "LowDec"}
WHAT = {
    "op_e": "operation",
    "where_e": "variant",
    "steps_e": "number of steps",
    "out_e": "output",
    "operand_e": "operand",
    "cond_e": "condition",
    "phase_e": "phase",
}
PARTS = ("phase", "up", "smooth")
ENUM = re.compile(r"typedef enum logic \[\d+:0\] \{(.*?)\} (\w+);", re.S)

Names = Mapping[str, Mapping[str, int]]


class AsmError(Exception):
    """A line that is wrong; its text is "line: what is wrong"."""

    def __init__(self, line: int, text: str) -> None:
        super().__init__(f"{line}: {text}")


@dataclass(frozen=True)
class Word:
    """One instruction: the line where it stands, its text without the comment, its code."""

    line: int
    text: str
    code: int


@dataclass
class Program:
    """Words from address 0 on; labels with their addresses."""

    words: list[Word] = field(default_factory=list)
    labels: dict[str, int] = field(default_factory=dict)

    def entries(self) -> dict[str, int]:
        """Labels that the RTL knows."""
        return {name: at for name, at in self.labels.items() if name.startswith(ENTRY)}


def names_of(package: str) -> Names:
    """{enumeration: {name: code}} of a SystemVerilog package; codes count on as the language says."""
    found: dict[str, dict[str, int]] = {}
    for body, enum in ENUM.findall(re.sub(r"//[^\n]*", "", package)):
        code = -1
        codes = found.setdefault(enum, {})
        for item in filter(None, (part.strip() for part in body.split(","))):
            name, _, value = (part.strip() for part in item.partition("="))
            code = number(value) if value else code + 1
            codes[name] = code
    for enum in WHAT:
        if enum not in found:
            raise AsmError(0, f"the package has no {enum}")
    return found


def number(literal: str) -> int:
    """Value of a sized SystemVerilog number like 6'h1c or 3'b100."""
    _, _, digits = literal.partition("'")
    return int(digits[1:].replace("_", ""), {"h": 16, "d": 10, "b": 2}[digits[0]])


def assemble(text: str, names: Names) -> Program:
    """Words and labels of a program; AsmError for the first line that is wrong."""
    program, lines = Program(), []
    for line, whole in enumerate(text.splitlines(), 1):
        told = whole.partition(";")[0].strip()
        if told.endswith(":"):
            name = told[:-1]
            if not re.fullmatch(r"[A-Za-z]\w*", name):
                raise AsmError(line, f"{name!r} is no name of a label")
            if name in program.labels:
                raise AsmError(line, f"label {name} stands twice")
            program.labels[name] = len(lines)
        elif told:
            lines.append((line, " ".join(told.split())))
            if len(lines) > WORDS:
                raise AsmError(line, f"the program is too long: more than {WORDS} words")
    coder = Coder(names, program.labels)
    program.words = [Word(line, told, coder.word(line, told)) for line, told in lines]
    check_end(program)
    for name, at in program.labels.items():
        if at not in coder.used and not name.startswith(ENTRY):
            before = program.words[at - 1] if at else None
            if before is None or leaves(before):
                raise AsmError(program.words[at].line, f"nothing leads to label {name}")
    return program


def leaves(word: Word) -> bool:
    """True if what follows a word is not carried out after it."""
    return word.text == "halt" or (word.text.startswith("jump ") and " if " not in word.text)


def check_end(program: Program) -> None:
    """The program must not run out of its last word, nor a label stand behind it."""
    if not program.words:
        raise AsmError(1, "the program is empty")
    last = program.words[-1]
    if not leaves(last):
        raise AsmError(last.line, "the program runs on behind its last word")
    for name, at in program.labels.items():
        if at == len(program.words):
            raise AsmError(last.line, f"nothing follows label {name}")


@dataclass
class Coder:
    """Codes of instructions; `used` collects the addresses that jumps go to."""

    names: Names
    labels: Mapping[str, int]
    used: set[int] = field(default_factory=set)

    def word(self, line: int, told: str) -> int:
        """Code of one instruction."""
        head, *rest = told.split()
        name, *variants = head.split(".")
        try:
            op, aux, low = self.parts(name, variants, rest)
        except ValueError as error:
            raise AsmError(line, str(error)) from None
        return self.code("op_e", "Op", op) << 13 | aux << 9 | low

    def code(self, enum: str, prefix: str, name: str) -> int:
        """Code of a name in one of the package's enumerations; prefix: what it begins with there."""
        codes = [known.removeprefix(prefix) for known in self.names[enum]]
        if name not in codes:
            near = get_close_matches(name, codes, 1) or codes[:FEW]
            but = f", but {', '.join(near)}" if len(near) == 1 or len(codes) <= FEW else ""
            raise ValueError(f"there is no {WHAT[enum]} {name}{but}")
        return self.names[enum][prefix + name]

    def parts(self, name: str, variants: list[str], rest: list[str]) -> tuple[str, int, int]:
        """Operation, aux and operand of an instruction."""
        operand = self.names["operand_e"]
        if name in SUMS:
            where = WHERE.get(tuple(variants))
            if where is None:
                raise ValueError(f"{name} has no variant .{'.'.join(variants)}")
            return (
                name.capitalize(),
                self.code("where_e", "", where),
                self.code("operand_e", "", one(name, rest)),
            )
        if name in ("mul", "shift"):
            steps = self.code("steps_e", "N", one(f"{name}, behind a point,", variants))
            value = one(name, rest) if name == "mul" else none(name, rest) or "K0"
            return "Mul", steps, self.code("operand_e", "", value)
        if variants:
            raise ValueError(f"{name} has no variant .{'.'.join(variants)}")
        if name == "root":
            none(name, rest)
            return "Root", 0, operand["RRoot"]
        if name == "halt":
            none(name, rest)
            return "Halt", 0, operand["K0"]
        if name == "store":
            word = one(name, rest)
            if not word.startswith("M"):
                raise ValueError(f"store wants a word M…, not {word}")
            return "Store", 0, self.code("operand_e", "", word)
        if name == "out":
            return "Out", self.code("out_e", "Out", one(name, rest)), operand["K0"]
        if name == "set":
            return "Set", *self.shape(rest)
        if name == "jump":
            return "Jump", *self.jump(rest)
        raise ValueError(f"{name} is no instruction")

    def shape(self, rest: list[str]) -> tuple[int, int]:
        """aux and operand of a set: which of phase, up and smooth are set, and to what."""
        if rest == ["over"]:
            return 0b1000, 0
        puts = low = 0
        for item in rest:
            part, _, value = item.partition("=")
            if part not in PARTS or puts & 4 >> PARTS.index(part):
                raise ValueError(f"set takes over, or once each {', '.join(PARTS)} with =, not {item}")
            if part != "phase" and value not in ("0", "1"):
                raise ValueError(f"{part} is 0 or 1, not {value}")
            puts |= 4 >> PARTS.index(part)
            low |= self.code("phase_e", "Ph", value) << 2 if part == "phase" else int(value) << (part == "up")
        if not puts:
            raise ValueError("set wants over, or phase=…, up=…, smooth=…")
        return puts, low

    def jump(self, rest: list[str]) -> tuple[int, int]:
        """aux and operand of a jump: condition and target."""
        if len(rest) not in (1, 3) or rest[1:2] not in ([], ["if"]):
            raise ValueError("a jump is `jump Label` or `jump Label if Condition`")
        if rest[0] not in self.labels:
            raise ValueError(f"there is no label {rest[0]}")
        target = self.labels[rest[0]]
        self.used.add(target)
        cond = self.code("cond_e", "If", rest[2]) if len(rest) == 3 else self.code("cond_e", "", "Always")
        return cond, target


def one(what: str, words: list[str]) -> str:
    """The one word that must follow."""
    if len(words) != 1:
        raise ValueError(f"{what} takes one word, not {len(words)}")
    return words[0]


def none(what: str, words: list[str]) -> str:
    """Nothing must follow; the empty text."""
    if words:
        raise ValueError(f"{what} stands alone, without {' '.join(words)}")
    return ""
