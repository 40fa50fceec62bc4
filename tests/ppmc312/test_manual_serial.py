"""The examples and tables of docs/ppmc312/serial.md, run on the golden model."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest

from cocotb_tests.harness import OnModel, on_model
from cocotb_tests.harness.bus import clean
from cocotb_tests.ppmc312.serial_frames import SPEEDS, summed
from cocotb_tests.ppmc312.serial_host import SerialHost
from openppmc.model.ppmc312.front.serial import END_CODES, LENGTHS
from tests.common.pages import DOCS, chapters
from tests.ppmc312.test_manual import Player

PAGE = DOCS / "ppmc312/serial.md"
TEXT = PAGE.read_text(encoding="utf-8")
REPLY = 400_000
"""Maximum wait for a reply in cycles: 20 ms and the length of the frame."""


class Line(Player):
    """One session with station 1."""

    KINDS = Player.KINDS | {"m": "raw", "s": "reply", "?": "poll"}

    def __init__(self) -> None:
        self.host = on_model(SerialHost.start(OnModel()))

    async def raw(self, words: str) -> None:
        await self.host.raw(words)

    async def reply(self, words: str) -> str:
        await self.host.hear(REPLY, timed=False)
        return words if clean(words) == self.host.wire else self.host.wire

    async def send(self, words: str) -> None:
        mark = self.host.mark
        await self.host.say(words)
        self.host.mark = mark

    async def answer(self, words: str) -> str:
        got = await self.host.hear(REPLY, timed=False)
        return words if clean(words) == got else got

    async def poll(self, words: str) -> str:
        await self.host.ask_poll()
        return await self.answer(words)


SESSIONS = {title: blocks for title, blocks in chapters(PAGE).items() if title.startswith("7.")}


@pytest.mark.parametrize("title", SESSIONS, ids=lambda title: title.split()[0])
def test_session(title):
    """If the lines of a session are played in order, each has the result that the page shows."""
    assert SESSIONS[title]
    for block in SESSIONS[title]:
        Line().play(block, title)


def test_reply_times():
    """For each speed, the page states the times of a reply.

    These are half a bit to the rise of snd, 1.5 bits to the start bit, both rounded down to 0.1 µs, and one
    bit between the two.
    """
    rows = re.findall(r"^\| ([\d ]+) \| ([\d.]+) µs \| ([\d.]+) µs \| ([\d.]+) µs \|$", TEXT, re.M)
    assert [row[0].replace(" ", "") for row in rows] == [str(int(speed)) for speed in SPEEDS.values()]
    for row, speed in zip(rows, SPEEDS.values(), strict=True):
        bit = 10_000_000 / speed
        tenths = [int(bit / 2), int(bit * Fraction(3, 2)), round(bit)]
        assert [float(text) for text in row[1:]] == [number / 10 for number in tenths]


def test_a_wrong_byte_is_found():
    """If a reply on the page is wrong, its line is reported."""
    with pytest.raises(AssertionError, match="line 1: '[?] 80' gave 90"):
        Line().play(["? 80"], "x")
    with pytest.raises(AssertionError, match="gave 91 6E"):
        Line().play(["m 81 7E", "s 91 6F"], "x")


def test_frames_of_the_text_have_their_checksums():
    """Each worked frame of chapter 2 ends with the right checksum."""
    frames = re.findall(r"`([89AB][0-9A-F](?: [0-9A-F]{2}){3,})`", TEXT)
    assert len(frames) == 2
    for text in frames:
        line = bytes.fromhex(text)
        assert line == summed(line[0], bytes.fromhex(line[1:-1].decode()))


def test_speeds_of_the_page():
    """The table of speeds contains all speeds of the part."""
    rows = re.findall(r"\| (\d{3}) \| ([\d ]+\.?\d*) \| (\d+) / (\d+) \|", TEXT)
    assert {int(mod, 2) for mod, *_ in rows} == set(SPEEDS)
    for mod, baud, over, under in rows:
        assert SPEEDS[int(mod, 2)] == pytest.approx(float(baud.replace(" ", "")), abs=0.1)
        assert SPEEDS[int(mod, 2)] * int(under) == 16_000_000 * int(over)


def codes(cell: str) -> set[int]:
    """Return the codes in a cell of the first column: lists, or ranges with dots."""
    found = {int(code, 16) for code in re.findall(r"[0-9A-F]{2}", cell)}
    if "…" in cell:
        found |= set(range(min(found), max(found) + 1))
    return found


def test_codes_and_lengths_of_the_page():
    """The table of instructions contains all codes, each with its number of data bytes."""
    table = TEXT.split("| Code | Parallel |")[1].split("\n\n")[0]
    found = {}
    for row in table.splitlines()[2:]:
        cell, _, _, data, _ = (part.strip() for part in row.strip("|").split("|"))
        size = sum(map(int, re.findall(r"\b(?:2|3|4|10)\b", data))) + len(
            re.findall(r"flags|mask|00 or 01|^1$", data)
        )
        found |= dict.fromkeys(codes(cell), size)
    assert found == dict(LENGTHS)


def test_end_codes_of_the_page():
    """The table of END codes contains exactly the codes of the model."""
    row = re.findall(r"\| END code \| (.*) \|", TEXT)[0]
    assert {int(code, 16) for code in row.split(" | ")} == set(END_CODES.values())
