"""Demo of the PMC006B4 without a simulator: frames as text, the path of the motor."""

from __future__ import annotations

from math import isnan

import pytest

from cocotb_tests.pmc006.demo_program import FINE, MOVES, PROGRAM
from openppmc.capture.pmc006.mnemonics import Pmc006Decoder
from openppmc.check.records import Access
from openppmc.model.pmc006.line import command, reply
from openppmc.model.pmc006.program import assemble
from scripts.demo.__main__ import chosen
from scripts.demo.pmc006 import way


def told(*rows: tuple[str, int, int]) -> list[Access]:
    """Return frames (letter, data), each with its reply data, in the format of the script host."""
    accesses = []
    for t, (letter, data, got) in enumerate(rows):
        accesses += [
            Access(100 * t, f"{letter!r} to FF, data", 0, data & 0xFFFFFFFF),
            Access(100 * t + 50, "reply of FF, data", 0, got & 0xFFFFFFFF),
        ]
    return accesses


@pytest.mark.parametrize(
    ("letter", "data", "got", "meaning", "answer"),
    [
        ("s", 2000, 3, "move 2000 steps", "accepted"),
        ("s", 0, 0, "move 0 steps", "refused"),
        ("j", 0, 9, "status 1?", "busy"),
        ("j", 0, 0x0A, "status 1?", "stopped by EXT1"),
        ("c", 0, -5, "position?", "-5"),
        ("Y", 7, 7, "stall configuration 7", "7"),
    ],
)
def test_frames_in_words(letter: str, data: int, got: int, meaning: str, answer: str) -> None:
    (row,) = Pmc006Decoder().exchanges(told((letter, data, got)))
    assert (row.meaning, row.reply) == (meaning, answer)
    assert bytes(row.sent) == command(0xFF, letter, data) and bytes(row.answer) == reply(0xFF, got)


def test_polls_and_words_are_one_row() -> None:
    rows = Pmc006Decoder().exchanges(
        told(("s", 5, 3), ("j", 0, 9), ("j", 0, 8), ("W", 1, 1), ("W", 2, 2), ("W", 3, 3))
    )
    assert [(row.meaning, row.polls) for row in rows] == [
        ("move 5 steps", []),
        ("status 1?", [9, 8]),
        ("program word 00000001, and 2 more", []),
    ]


def test_way_in_full_steps() -> None:
    """Steps are counted in the microsteps of their chapter; after a change of direction they count
    backwards.
    """
    chapters = {f"move{micro}": {"begin": 1000 * place} for place, (micro, _) in enumerate(MOVES)}
    chapters["program"] = {"begin": 3000}
    fine, finer = MOVES[0][0], MOVES[1][0]
    found = way([10, 20, 1010, 1030], [(1005, 0)], chapters, 10_000)
    assert [step.place for step in found] == [1 / fine, 2 / fine, 2 / fine - 1 / finer, 2 / fine - 2 / finer]
    assert [isnan(step.speed) for step in found] == [True, False, True, False]
    assert found[1].speed == pytest.approx(1000 / fine) and found[3].speed == pytest.approx(500 / finer)


def test_program_of_the_demo() -> None:
    words = assemble(PROGRAM).words
    assert words[:2] == (0x02, FINE) and not any(words[2 * PROGRAM.count("\n") :])
    assert chosen(["--part", "pmc006"]).test == "demo_program"
