"""Assembler and disassembler of user programs of the PMC006B4."""

from __future__ import annotations

import doctest

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from openppmc.model.pmc006.program import (
    INSTRUCTIONS,
    WORDS,
    AssemblyError,
    BadImage,
    Instruction,
    Program,
    assemble,
    assembler,
    disassemble,
    harmless,
    instructions,
    program,
)
from openppmc.model.pmc006.program.instructions import BY_OPCODE, KINDS, MASK, Place

P1 = """\
; moves 200 steps three times, then raises GPO1
top_speed = 3200

        DIR     1
        VSET    0, top_speed
        CNTC
again:  ROT     200
        WAIT    8, 0            # until it rests
        CNTI
        CMP     8, 3
        JNE     again
        OUT     1, 1
        END
"""
P1_WORDS = (
    (0x00000003, 0x00000001),
    (0x00000008, 0x00000C80),
    (0x0000000C, 0),
    (0x00000001, 0x000000C8),
    (0x00000810, 0),
    (0x0000000B, 0),
    (0x00000812, 0x00000003),
    (0x0000000E, 0x00000003),
    (0x00000111, 0x00000001),
    (0, 0),
)
"""Program P1 and its words."""

P1_AGAIN = """\
        DIR      forward
        VSET     fixed, 3200
        CNTC
L3:     ROT      200
        WAIT     busy, 0
        CNTI
        CMP      counter, 3
        JNE      L3
        OUT      gpo1, 1
        END
"""

words = st.integers(0, MASK)
small = st.one_of(st.integers(0, 130), st.sampled_from([MASK, 1 << 31, 0x7FFFFFFF, 16_000, 16_001]), words)
single = st.builds(
    Instruction,
    st.one_of(st.sampled_from(sorted(BY_OPCODE)), st.integers(0, 255)),
    st.one_of(st.integers(0, 10), st.integers(0, 255)),
    small,
    st.sampled_from([0, 0, 0, 1, 0xFFFF]),
)
programs = st.lists(single, max_size=INSTRUCTIONS).map(Program.of)


def test_the_example_of_the_rules() -> None:
    made = assemble(P1)
    assert made.words == tuple(word for pair in P1_WORDS for word in pair) + (0,) * (WORDS - 20)
    assert disassemble(made) == P1_AGAIN
    assert disassemble(made, numbers=True).splitlines()[3] == "L3:     ROT      200                    ; 3"


@given(programs)
@example(Program())
@example(Program.of([Instruction(0)] * 99 + [Instruction(0x0D, 0, 99)]))
@example(Program((MASK,) * WORDS))
@example(Program.of([Instruction(0x0D, 0, 57)]))
@example(Program.of([Instruction(0x0D, 3, 0), Instruction(0x12, 8, MASK), Instruction(0x13, 1, 5)]))
def test_there_and_back(made: Program) -> None:
    """Conversions between text, words and image lose nothing, for any 200 words."""
    assert assemble(disassemble(made)) == made
    assert assemble(disassemble(made, numbers=True)) == made
    assert Program.from_image(made.image()) == made
    assert Program.of(made.instructions) == made == Program.of(made.used)
    assert [one.words for one in made.instructions] == list(
        zip(made.words[::2], made.words[1::2], strict=True)
    )


@given(st.data())
def test_every_legal_instruction_is_written_with_its_name(data: st.DataObject) -> None:
    kind = data.draw(st.sampled_from(list(KINDS.values())))
    values = {Place.OPTION: 0, Place.OPERAND: 0}
    texts = []
    for operand in kind.operands:
        accepts = operand.accepts
        assert isinstance(accepts, range | tuple)
        value = data.draw(st.sampled_from(accepts))
        values[operand.place] = value & MASK
        texts.append(data.draw(st.sampled_from([str(value), hex(value), operand.text(value)])))
    one = Instruction(kind.opcode, values[Place.OPTION], values[Place.OPERAND])
    (first, second, *_) = assemble(f"{kind.name.lower()} {', '.join(texts)}").words
    assert (first, second) == one.words and one.plain and one.kind is kind
    assert ".word" not in disassemble(Program.of([one]))


def test_labels_names_and_left_out_operands() -> None:
    made = assemble(
        "wait_ms=5\nlast = wait_ms\nA: b: C:\n  rot last\nRESET_EN on, b\nreset_en off\nPAUSE_EN 1\n"
        "jmp\tfin ; forward\nMIC 0x20\nfin:"
    )
    assert made.words[:14] == (1, 5, 0x113, 0, 0x13, 0, 0x114, 0, 0x0D, 6, 2, 32, 0, 0)
    assert assemble("") == assemble("\n ; nothing\n") == Program()
    assert assemble("CMP counter, -1").words[1] == MASK
    assert assemble(".WORD 0xFFFFFFFF, 7").words[:2] == (MASK, 7)


@pytest.mark.parametrize(
    ("text", "line", "says"),
    [
        ("ROT", 1, "ROT: write ROT steps"),
        ("END 3", 1, "END: write END"),
        ("WAIT busy", 1, "WAIT: write WAIT source, level"),
        ("WAIT busy,", 1, "WAIT: write WAIT source, level"),
        ("RESET_EN", 1, r"RESET_EN: write RESET_EN key, \[target\]"),
        ("\nROT 0", 2, "ROT 0: steps: 1 to 2147483647"),
        ("ROT x", 1, "ROT x: steps: 1 to 2147483647"),
        ("MIC 3", 1, r"MIC 3: microsteps: 0 \(full steps\), 2, 4"),
        ("DIR up", 1, "DIR up: direction: backward, forward, 0 or 1"),
        ("VSET analog, 16001", 1, "VSET 16001: speed: 0 to 16000 steps/s"),
        ("WAIT counter, 1", 1, "WAIT counter: source: gpi1, .*, busy, stall, 1 to 9"),
        ("CMP 10, 1", 1, "CMP 10: source: gpi1"),
        ("OUT gpo6, 1", 1, "OUT gpo6: output: gpo1"),
        ("CMP 8, 4294967296", 1, "CMP 4294967296: value: 32 bits"),
        ("JMP there", 1, "JMP there: no such label; target: a label or 0 to 99"),
        ("JMP 100", 1, "JMP 100: target: a label or 0 to 99"),
        ("END\n" * 100 + "x:\n", 101, None),
        ("JMP x\n" + "END\n" * 99 + "x:\n", 1, "JMP x: target"),
        ("END\n" * 101, 101, "too long: a program has 100 instructions at most"),
        ("HOP 3", 1, "HOP: there are END, ROT, MIC"),
        ("a: a: END", 1, "a: this name is taken already"),
        ("a = 1\na: END", 2, "a: this name is taken already"),
        ("rot: END", 1, "rot: an instruction, so no name"),
        ("a = b", 1, "a = b: not a number"),
        ("a = 09", 1, "a = 09: not a number"),
        (".word 1", 1, ".word: write .word W0, W1"),
        (".word 1, -1", 1, ".word: words are 0 to 0xFFFFFFFF"),
    ],
)
def test_mistakes(text: str, line: int, says: str | None) -> None:
    if says is None:
        assert assemble(text) == Program()
        return
    with pytest.raises(AssemblyError, match=f"^prog.asm:{line}: {says}") as caught:
        assemble(text, "prog.asm")
    assert caught.value.line == line


def test_images() -> None:
    image = assemble(P1).image()
    assert len(image) == 803 and image[-1] == 0x5A and sum(image[:-3]) & 0xFFFF == image[-3] | image[-2] << 8
    eeprom = bytes(32) + image + bytes(4096 - 32 - 803)
    assert Program.from_image(eeprom) == assemble(P1)
    for bad, says in (
        (image[:-1], "802 bytes: a program has 803, an EEPROM 4096"),
        (image[:-1] + b"\0", "its end mark is 00, not 5A"),
        (b"\1" + image[1:], "its sum is wrong"),
    ):
        with pytest.raises(BadImage, match=says):
            Program.from_image(bad)
    for wrong in ((0,) * 199, (1 << 32,) * 200):
        with pytest.raises(ValueError, match="200 words of 32 bits"):
            Program(wrong)


def test_what_a_try_does_not_change() -> None:
    """An instruction counts as harmless for E only if it changes no state (P006-PRG-20)."""
    does = {name for name, kind in KINDS.items() if not harmless(kind.opcode)}
    assert does == {
        "ROT",
        "MIC",
        "DIR",
        "EXTEN",
        "FREE",
        "CLR2",
        "CLR1",
        "VSET",
        "ACC",
        "TRIG",
        "CNTI",
        "CNTC",
        "OUT",
        "CMP",
    }
    assert harmless(0x15) and harmless(0xFFFFFF00)


@pytest.mark.parametrize("module", [assembler, instructions, program])
def test_examples_in_the_code(module: object) -> None:
    failed, attempted = doctest.testmod(module)  # type: ignore[arg-type]
    assert attempted and not failed
