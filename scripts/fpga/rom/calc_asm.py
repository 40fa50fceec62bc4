"""Assembler of the planner's program (rtl/pmc006/motion/pmc006_calc.asm): from text to words of 17 bits.

Names and codes of operations, operands, conditions, outputs and phases are read from pmc006_calc_pkg.sv, the
only place that defines them. A word is {operation, aux, operand}: 4, 4 and 9 bits.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches

WORDS = 512
"""Number of words in the ROM."""
ENTRY = "Entry"
"""Prefix of the labels that the RTL uses."""
MAX_LISTED = 8
"""Largest number of names that an error message lists."""
ARITHMETIC = ("load", "add", "sub", "div")
OPERAND_MODES = {(): "Plain", ("dec",): "Dec", ("lo",): "Low", ("lo", "dec"): "LowDec"}
ENUM_TITLES = {
    "calc_op_e": "operation",
    "operand_mode_e": "variant",
    "mul_steps_e": "number of steps",
    "output_sel_e": "output",
    "operand_e": "operand",
    "cond_e": "condition",
    "phase_e": "phase",
}
SHAPE_FIELDS = ("phase", "up", "smooth")
ENUM = re.compile(r"typedef enum logic \[\d+:0\] \{(.*?)\} (\w+);", re.S)

Names = Mapping[str, Mapping[str, int]]


class AsmError(Exception):
    """A wrong line; the text is "line: fault"."""

    def __init__(self, line: int, text: str) -> None:
        super().__init__(f"{line}: {text}")


@dataclass(frozen=True)
class Word:
    """One instruction: its line, its text without the comment, its code."""

    line: int
    text: str
    code: int


@dataclass
class Program:
    """Program: words from address 0 on, and labels with their addresses."""

    words: list[Word] = field(default_factory=list)
    labels: dict[str, int] = field(default_factory=dict)

    def entries(self) -> dict[str, int]:
        """Return the labels that the RTL uses."""
        return {name: at for name, at in self.labels.items() if name.startswith(ENTRY)}


def names_of(package: str) -> Names:
    """Return {enumeration: {name: code}} of a package; an omitted code is the previous code + 1."""
    found: dict[str, dict[str, int]] = {}
    for body, enum in ENUM.findall(re.sub(r"//[^\n]*", "", package)):
        code = -1
        codes = found.setdefault(enum, {})
        for item in filter(None, (part.strip() for part in body.split(","))):
            name, _, value = (part.strip() for part in item.partition("="))
            code = number(value) if value else code + 1
            codes[name] = code
    for enum in ENUM_TITLES:
        if enum not in found:
            raise AsmError(0, f"the package has no {enum}")
    return found


def number(literal: str) -> int:
    """Return the value of a sized SystemVerilog number such as 6'h1c or 3'b100."""
    _, _, digits = literal.partition("'")
    return int(digits[1:].replace("_", ""), {"h": 16, "d": 10, "b": 2}[digits[0]])


def assemble(text: str, names: Names) -> Program:
    """Return words and labels of a program; raise AsmError for the first wrong line."""
    program, lines = Program(), []
    for line, source in enumerate(text.splitlines(), 1):
        instr = source.partition(";")[0].strip()
        if instr.endswith(":"):
            name = instr[:-1]
            if not re.fullmatch(r"[A-Za-z]\w*", name):
                raise AsmError(line, f"{name!r} is not a valid label")
            if name in program.labels:
                raise AsmError(line, f"label {name} is defined twice")
            program.labels[name] = len(lines)
        elif instr:
            lines.append((line, " ".join(instr.split())))
            if len(lines) > WORDS:
                raise AsmError(line, f"the program is too long: more than {WORDS} words")
    coder = Coder(names, program.labels)
    program.words = [Word(line, instr, coder.word(line, instr)) for line, instr in lines]
    check_last_word(program)
    for name, at in program.labels.items():
        if at not in coder.used and not name.startswith(ENTRY):
            before = program.words[at - 1] if at else None
            if before is None or always_leaves(before):
                raise AsmError(program.words[at].line, f"no instruction leads to label {name}")
    return program


def always_leaves(word: Word) -> bool:
    """Return True if execution never continues with the word after this instruction."""
    return word.text == "halt" or (word.text.startswith("jump ") and " if " not in word.text)


def check_last_word(program: Program) -> None:
    """Raise AsmError if execution can continue after the last word, or if a label follows it."""
    if not program.words:
        raise AsmError(1, "the program is empty")
    last = program.words[-1]
    if not always_leaves(last):
        raise AsmError(last.line, "the program continues after its last word")
    for name, at in program.labels.items():
        if at == len(program.words):
            raise AsmError(last.line, f"no instruction follows label {name}")


@dataclass
class Coder:
    """Encoder of instructions; `used` collects the targets of jumps."""

    names: Names
    labels: Mapping[str, int]
    used: set[int] = field(default_factory=set)

    def word(self, line: int, instr: str) -> int:
        """Return the code of one instruction."""
        head, *rest = instr.split()
        name, *variants = head.split(".")
        try:
            op, aux, low = self.parts(name, variants, rest)
        except ValueError as error:
            raise AsmError(line, str(error)) from None
        return self.code("calc_op_e", "Op", op) << 13 | aux << 9 | low

    def code(self, enum: str, prefix: str, name: str) -> int:
        """Return the code of a name in an enumeration of the package.

        Args:
            prefix: prefix of the name in the package.
        """
        codes = [known.removeprefix(prefix) for known in self.names[enum]]
        if name not in codes:
            near = get_close_matches(name, codes, 1) or codes[:MAX_LISTED]
            but = f", but {', '.join(near)}" if len(near) == 1 or len(codes) <= MAX_LISTED else ""
            raise ValueError(f"there is no {ENUM_TITLES[enum]} {name}{but}")
        return self.names[enum][prefix + name]

    def parts(self, name: str, variants: list[str], rest: list[str]) -> tuple[str, int, int]:
        """Return operation, aux and operand of an instruction."""
        operand = self.names["operand_e"]
        if name in ARITHMETIC:
            mode = OPERAND_MODES.get(tuple(variants))
            if mode is None:
                raise ValueError(f"{name} has no variant .{'.'.join(variants)}")
            return (
                name.capitalize(),
                self.code("operand_mode_e", "Operand", mode),
                self.code("operand_e", "", one(name, rest)),
            )
        if name in ("mul", "shift"):
            steps = self.code("mul_steps_e", "Steps", one(f"the suffix of {name}", variants))
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
                raise ValueError(f"store expects a word M…, not {word}")
            return "Store", 0, self.code("operand_e", "", word)
        if name == "out":
            return "Out", self.code("output_sel_e", "Out", one(name, rest)), operand["K0"]
        if name == "set":
            return "Set", *self.shape(rest)
        if name == "jump":
            return "Jump", *self.jump(rest)
        raise ValueError(f"{name} is not an instruction")

    def shape(self, rest: list[str]) -> tuple[int, int]:
        """Return aux and operand of a `set`: which of phase, up and smooth it sets, and their values."""
        if rest == ["over"]:
            return 0b1000, 0
        selected = low = 0
        for item in rest:
            part, _, value = item.partition("=")
            if part not in SHAPE_FIELDS or selected & 4 >> SHAPE_FIELDS.index(part):
                raise ValueError(
                    f"set expects over, or once each {', '.join(SHAPE_FIELDS)} with =, not {item}"
                )
            if part != "phase" and value not in ("0", "1"):
                raise ValueError(f"{part} must be 0 or 1, not {value}")
            selected |= 4 >> SHAPE_FIELDS.index(part)
            low |= self.code("phase_e", "Ph", value) << 2 if part == "phase" else int(value) << (part == "up")
        if not selected:
            raise ValueError("set expects over, or phase=…, up=…, smooth=…")
        return selected, low

    def jump(self, rest: list[str]) -> tuple[int, int]:
        """Return aux and operand of a jump, which are the condition and the target."""
        if len(rest) not in (1, 3) or rest[1:2] not in ([], ["if"]):
            raise ValueError("a jump is `jump Label` or `jump Label if Condition`")
        if rest[0] not in self.labels:
            raise ValueError(f"there is no label {rest[0]}")
        target = self.labels[rest[0]]
        self.used.add(target)
        cond = self.code("cond_e", "Cond", rest[2] if len(rest) == 3 else "Always")
        return cond, target


def one(what: str, words: list[str]) -> str:
    """Return the word of a list with one word; raise ValueError for another number of words."""
    if len(words) != 1:
        raise ValueError(f"{what} expects one word, not {len(words)}")
    return words[0]


def none(what: str, words: list[str]) -> str:
    """Raise ValueError if there is an operand, else return ""."""
    if words:
        raise ValueError(f"{what} expects no word, not {' '.join(words)}")
    return ""
