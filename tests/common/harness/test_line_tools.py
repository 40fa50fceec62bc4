"""Demo, soak and bench of the PPMC-312 line without a simulator: frames as text, figures, a line of
models.
"""

from __future__ import annotations

import pytest

from cocotb_tests.harness.project import ProjectError
from cocotb_tests.ppmc312.bench import PPMC312
from cocotb_tests.ppmc312.line import soak as line_soak
from cocotb_tests.ppmc312.line.demo import PULSES, SETTING
from cocotb_tests.ppmc312.line.master import Master, NoFrameError, Reply, at_once, understood
from cocotb_tests.ppmc312.line.models import ModelLine, heard
from cocotb_tests.ppmc312.line.setting import ALL, LINE, STATIONS
from cocotb_tests.ppmc312.line.wave import merged, wave
from openppmc.model.ppmc312.front.serial import frame
from scripts.demo.__main__ import chosen, part_of
from scripts.demo.ppmc312.line.talk import exchanges
from scripts.demo.ppmc312.line.waves import view
from scripts.measure.bench import ppmc312 as line_bench
from scripts.measure.soak import blocks
from scripts.measure.soak import main as soak


def talk(question: bytes, answer: bytes) -> list[tuple[int, int, str, str]]:
    """Return one frame of the master and its reply, as the demo of the line records them."""
    return [(0, 100, "master", question.hex()), (200, 300, "station", answer.hex())]


@pytest.mark.parametrize(
    ("sent", "got", "meaning", "reply"),
    [
        (frame(0x83), frame(0x83), "station 3: poll", "busy"),
        (frame(0x8F), frame(0xAF, b"\x38"), "station 15: poll", "stopped: normal"),
        (frame(0x81), frame(0xB1, b"\x46"), "station 1: poll", "report 46"),
        (frame(0x92, bytes.fromhex("a3 0000 00000064")), frame(0x92),
         "station 2: accelerate/decelerate, CCW, 100 pulses", "ready"),
        (frame(0x90, bytes.fromhex(SETTING)), frame(0x90),
         "station 0: initial setting, rates 320 to 160, 864 pulses", "ready"),
        (frame(0x94, b"\x42"), frame(0xA4, b"\xff\xff\xff\xfe"), "station 4: read pulse position", "-2"),
    ],
)  # fmt: skip
def test_frames_in_words(sent, got, meaning, reply):
    """The frames of an exchange on the line are described as text."""
    (one,) = exchanges(talk(sent, got))
    assert (one.meaning, one.reply) == (meaning, reply)
    assert (one.sent[:2], one.got[-2:]) == (f"{sent[0]:02X}", f"{got[-1]:02X}")


def test_a_question_without_an_answer():
    """If only the second of two frames is answered, the row of the first frame has no kind of answer."""
    rows = exchanges([(0, 10, "master", "817e"), *talk(frame(0x82), frame(0x92))])
    assert [row.kind for row in rows] == ["", "ready"]


def test_levels_of_a_line():
    """A character is low for its start bit and its 0 bits; if two drivers overlap, the line is low while one
    of them is.
    """
    assert wave(b"\x55", 0, 10) == [(10 * number, number & 1) for number in range(10)]
    assert wave(b"\xff", 5, 9.6) == [(5, 0), (15, 1)]
    assert merged([(0, 0), (10, 1)], [(5, 0), (20, 1)]) == [(0, 0), (20, 1)]
    assert merged([(0, 0), (10, 1)], [(10, 0), (20, 1)]) == [(0, 0), (20, 1)]


def test_what_a_station_hears():
    """Pins of the line select which stations receive a low level that station 2 sends."""
    driven = ALL & ~(1 << 2)
    levels = {**LINE.inputs, "hear_others": 1, "hear_self": 0}
    assert [heard(levels, driven, number) for number in (1, 2)] == [0, 1]
    assert [heard({**levels, "hear_others": 0, "hear_self": 1}, driven, n) for n in (1, 2)] == [1, 0]
    assert heard({**levels, "noise": 1 << 1}, driven, 1) == 1
    assert heard({**levels, "master": 0}, ALL, 7) == 0


@pytest.mark.parametrize(
    "data", ["", "81", "c17e", "816e", "a13338 27", "a1333826ff", "b1344C0d", "a1338a26"]
)
def test_what_is_no_frame(data):
    """Characters that are not a frame are rejected."""
    with pytest.raises(NoFrameError):
        understood(bytes.fromhex(data))


def test_a_line_of_models_answers():
    """On a line of sixteen models, a polled station responds within the window, and the master receives the
    response.
    """
    line = ModelLine()
    at_once(line.until(8))
    master = Master(line)
    assert at_once(master.poll(11)) == Reply("ready", 11, b"")
    assert at_once(master.exchange(frame(0x8B)[:1])) is None
    assert [said.data for said in master.heard] == [frame(0x9B)]


def test_demo_and_its_waves():
    """PART=ppmc312-serial selects the demo of the line; each pin in its waveforms is a pin of a station."""
    assert part_of(["--part", "ppmc312-serial"]) == "ppmc312-serial"
    with pytest.raises(ProjectError, match="ppmc312, ppmc312-serial"):
        chosen(["--part", "isa_4axis"])
    names = {name.split(".")[1] for _, group in view(STATIONS).groups[1:] for name in group}
    assert names - {"speed_pps", "position"} <= set(PPMC312.outputs)
    assert len(PULSES) == STATIONS == 16 and min(PULSES) > 0


def test_soak_counts_its_bytes():
    """A thousand seeds transmit more than 100 000 bytes bit by bit."""
    assert 1000 * line_soak.SIZE >= 100_000
    played = line_soak.SOAK.some([1, 2])
    assert not played.failures and played.compared == {"seeds": 2, line_soak.MODEL_BYTES: 1040}
    with pytest.raises(ProjectError, match="--count must be 1 or more"):
        soak(["ppmc312-serial", "--count", "0"])
    with pytest.raises(ProjectError, match="PART=ppmc312-parallel: no random hosts for this part"):
        soak(["ppmc312-parallel"])


def test_blocks_of_seeds_begin_where_they_always_do():
    """The boundaries between blocks of seeds do not depend on the first seed or the count; each seed is in
    exactly one block.
    """
    assert list(blocks(1, 60)) == [(1, 24), (25, 25), (50, 11)]
    assert list(blocks(30, 30)) == [(30, 20), (50, 10)]
    for first, count in ((1, 1), (25, 25), (7, 12_345)):
        seeds = [seed for begin, size in blocks(first, count) for seed in range(begin, begin + size)]
        assert seeds == list(range(first, first + count))


def test_figures_against_the_goal():
    """A run of 8 million cycles reaches the goal of 1/50 of real time if it takes 40 s, but not if it takes
    60 s.
    """
    rows = line_bench.rows_of([("a", 8_000_000, 70, 40), ("b", 8_000_000, 70, 60)], 8_000_000)
    assert [row[-2:] for row in rows] == [["1/40", "reached"], ["1/60", "missed"]]
