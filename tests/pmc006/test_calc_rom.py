"""The assembler of the planner's program (`make rom`): words, labels, one line for each error."""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import NamedTuple

import pytest

from cocotb_tests.harness.project import ProjectError
from scripts.fpga.rom import calc_rom
from scripts.fpga.rom.calc_asm import WORDS, AsmError, Program, assemble, names_of

NAMES = names_of(calc_rom.PACKAGE.read_text())
FORMS = [
    ("load RLeft", "Load OperandPlain RLeft"),
    ("add.dec RWay", "Add OperandDec RWay"),
    ("sub.lo K1", "Sub OperandLow K1"),
    ("div.lo.dec RWay", "Div OperandLowDec RWay"),
    ("store MWay1", "Store OperandPlain MWay1"),
    ("mul.16 RVe", "Mul Steps16 RVe"),
    ("shift.2", "Mul Steps2 K0"),
    ("root", "Root OperandPlain RRoot"),
    ("halt", "Halt OperandPlain K0"),
    ("out LeadAngle", "Out OutLeadAngle K0"),
]
MISTAKES = [
    ("lod RLeft", "lod is not an instruction"),
    ("load RLeeft", "there is no operand RLeeft, but RLeft"),
    ("load", "load expects one word, not 0"),
    ("load.hi RV", "load has no variant .hi"),
    ("halt.lo", "halt has no variant .lo"),
    ("store RV", "store expects a word M…, not RV"),
    ("store MZ", "there is no operand MZ"),
    ("mul RV", "the suffix of mul expects one word, not 0"),
    ("mul.8 RV", "there is no number of steps 8, but 1, 2, 16, 32"),
    ("shift.2 RV", "shift expects no word, not RV"),
    ("root RV", "root expects no word, not RV"),
    ("out Nxt", "there is no output Nxt, but Next"),
    ("set", "set expects over, or phase=…, up=…, smooth=…"),
    ("set up=2", "up must be 0 or 1, not 2"),
    ("set up=1 up=0", "set expects over, or once each phase, up, smooth with =, not up=0"),
    ("set phase=Rmp", "there is no phase Rmp, but Ramp"),
    ("jump", "a jump is `jump Label` or `jump Label if Condition`"),
    ("jump Here on Zero", "a jump is `jump Label` or `jump Label if Condition`"),
    ("jump There", "there is no label There"),
    ("jump Here if Zer", "there is no condition Zer, but Zero"),
    ("Here:", "label Here is defined twice"),
    ("2nd:", "'2nd' is not a valid label"),
    ("halt\nLoose:", "no instruction leads to label Loose"),
    ("halt\n" * WORDS, f"the program is too long: more than {WORDS} words"),
]


def program(*lines: str) -> Program:
    """Return a program of these lines, with the names of the package."""
    return assemble("\n".join(lines), NAMES)


def code(text: str) -> int:
    """Return the code of the text "operation aux operand", by the names of the package."""
    op, aux, operand = text.split()
    enums = ("operand_mode_e", "mul_steps_e", "output_sel_e")
    return (
        NAMES["calc_op_e"][f"Op{op}"] << 13
        | next(NAMES[enum][aux] for enum in enums if aux in NAMES[enum]) << 9
        | NAMES["operand_e"][operand]
    )


def test_enumerations() -> None:
    """The codes of enumerations with and without explicit numbers are those of SystemVerilog."""
    text = "\n".join(f"typedef enum logic [3:0] {{ A, B = 4'h7,  // b\n C }} {name};" for name in NAMES)
    assert all(codes == {"A": 0, "B": 7, "C": 8} for codes in names_of(text).values())


def test_package_without_enumeration() -> None:
    """A missing enumeration in the package is reported."""
    with pytest.raises(AsmError, match="the package has no calc_op_e"):
        names_of("package p; endpackage")


@pytest.mark.parametrize(("line", "word"), FORMS)
def test_instructions(line: str, word: str) -> None:
    """The word of an instruction consists of the codes of the package; comments and spaces have no effect."""
    words = program(f"   {line}   ; a comment: here", "halt").words
    assert (words[0].code, words[0].text, words[0].line) == (code(word), line, 1)


@pytest.mark.parametrize(
    ("line", "selected", "low"),
    [
        ("set over", 0b1000, 0),
        ("set phase=Stop up=0 smooth=1", 0b0111, 6 << 2 | 1),
        ("set smooth=0 phase=Ramp", 0b0101, 4 << 2),
        ("set up=1", 0b0010, 0b10),
    ],
)
def test_shapes(line: str, selected: int, low: int) -> None:
    """In a set instruction, aux selects the fields that are set, and the operand has their values."""
    assert program(line, "halt").words[0].code == NAMES["calc_op_e"]["OpSet"] << 13 | selected << 9 | low


def test_labels_and_jumps() -> None:
    """Jumps to labels before and after them get the right addresses; labels Entry… are entries of the ROM."""
    made = program(
        "EntryA: ; first", " jump End if NotCarry", "Back:", " load RV", " jump Back", "End:", " halt"
    )
    assert made.labels == {"EntryA": 0, "Back": 1, "End": 3}
    assert made.entries() == {"EntryA": 0}
    jump = NAMES["calc_op_e"]["OpJump"] << 13
    assert made.words[0].code == jump | NAMES["cond_e"]["CondNotCarry"] << 9 | 3
    assert made.words[2].code == jump | NAMES["cond_e"]["CondAlways"] << 9 | 1


@pytest.mark.parametrize(("line", "message"), MISTAKES)
def test_mistakes(line: str, message: str) -> None:
    """For a wrong line, the error is one line with the line number and the reason."""
    with pytest.raises(AsmError) as caught:
        program("EntryA:", "jump Here", "Here:", line, "halt")
    where, _, text = str(caught.value).partition(": ")
    assert text == message
    assert int(where) >= 4
    assert "\n" not in text


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ((), "1: the program is empty"),
        (("load RV",), "1: the program continues after its last word"),
        (("EntryA:", "jump EntryA if Zero"), "2: the program continues after its last word"),
        (("jump Out", "Out:"), "1: no instruction follows label Out"),
    ],
)
def test_ends(lines: tuple[str, ...], message: str) -> None:
    """A program whose execution could pass its last word is rejected."""
    with pytest.raises(AsmError) as caught:
        program(*lines)
    assert str(caught.value) == message


def test_full_rom() -> None:
    """A program that fills all words of the ROM is accepted."""
    assert len(program(*["load RV"] * (WORDS - 1), "halt").words) == WORDS


def test_files_are_fresh() -> None:
    """The generated files in the tree are those that `make rom` writes."""
    for path, text in calc_rom.expected_files().items():
        assert path.read_text() == text, path


def test_message_names_file_and_line(monkeypatch: pytest.MonkeyPatch) -> None:
    """For an error in the program file, the message is one line with file, line and reason."""
    monkeypatch.setattr(calc_rom, "ASM", calc_rom.PACKAGE)
    with pytest.raises(ProjectError, match=r"^rtl/pmc006/motion/\w+\.sv:1: // is not an instruction$"):
        calc_rom.expected_files()


def test_package_without_marks() -> None:
    """If the package lacks the marks around the generated text, the package is rejected and not changed."""
    with pytest.raises(ProjectError, match="the marks of `make rom` are missing"):
        calc_rom.package_text("package p; endpackage", program("halt"))


class State(NamedTuple):
    """Registers of the planner that conditions read."""

    phase: int
    up: int
    smooth: int
    acc: int
    dec: int


class Paths:
    """Longest paths through a program: every outcome of Carry and Zero is possible; the inputs are stable."""

    def __init__(self, words: list[int], **inputs: int) -> None:
        self.words, self.inputs = words, inputs
        self.op, self.cond = (
            {code: name for name, code in NAMES[enum].items()} for enum in ("calc_op_e", "cond_e")
        )
        self.longest = cache(self._longest)

    def _taken(self, aux: int, state: State) -> list[int]:
        """Return the possible outcomes of a condition."""
        name, phase = self.cond[aux].removeprefix("Cond"), state.phase
        known = self.inputs | {
            "Always": 1, "Stop": self.inputs["Stop"] & self.inputs["Speed"], "Ending": phase & 3 == 2,
            "Ramp": phase >> 2, "Live": phase & 3 == 0 and not self.inputs["Short"], "Up": state.up,
            "Smooth": state.smooth, "Acc5": state.acc == 5, "Dec5": state.dec == 5,
        }  # fmt: skip
        return [int(known[name])] if name in known else [0, 1]

    def _longest(self, at: int, state: State) -> int:
        """Return the largest number of cycles from the fetch of a word to the end of the run."""
        op, aux, low = self.op[self.words[at] >> 13], self.words[at] >> 9 & 15, self.words[at] & 511
        if op == "OpHalt":
            return 2
        steps = {0: 1, 1: 2, 3: 16}.get(aux, 32) if op == "OpMul" else 32
        cycles = {"OpLoad": 3, "OpAdd": 3, "OpSub": 3, "OpMul": steps + 2, "OpDiv": 34, "OpRoot": 34}.get(
            op, 2
        )
        if op == "OpOut":
            state = state._replace(acc=state.acc + (aux == 4), dec=state.dec + (aux == 5))
        if op == "OpSet":
            phase = state.phase & 3 if aux & 8 else low >> 2 if aux & 4 else state.phase
            up, smooth = low >> 1 & 1 if aux & 2 else state.up, low & 1 if aux & 1 else state.smooth
            state = state._replace(phase=phase, up=up, smooth=smooth)
        assert max(state.acc, state.dec) <= 5
        following = (
            [low if taken else at + 1 for taken in self._taken(aux, state)] if op == "OpJump" else [at + 1]
        )
        return cycles + max(self.longest(place, state) for place in following)


@pytest.mark.parametrize(("entry", "limit"), [("EntryPlan", 785), ("EntryTick", 590)])
def test_runs_end(entry: str, limit: int) -> None:
    """Every run ends within the bound of pmc006_calc, on every path; pmc006_calc_fv proves the durations."""
    made = assemble(calc_rom.ASM.read_text(), NAMES)
    words, worst = [word.code for word in made.words], 0
    for short, speed, stop, analog in product((0, 1), repeat=4):
        plan = int(entry == "EntryPlan")
        paths = Paths(words, Short=short, Speed=speed, Stop=stop, Analog=analog, Plan=plan)
        for state in product((0, 1, 2, 4, 5, 6), (1,) if plan else (0, 1), (0, 1), range(6), range(6)):
            worst = max(worst, paths.longest(made.labels[entry], State(*state)))
    assert limit - 50 < worst <= limit
