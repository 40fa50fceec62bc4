"""The examples and tables of docs/pmc006/README.md, run on the golden model."""

from __future__ import annotations

import re

import pytest

from cocotb_tests.harness import OnModel, on_model
from cocotb_tests.pmc006.builds import F8B
from cocotb_tests.pmc006.host import Host
from openppmc.model.pmc006.codes import LETTERS
from openppmc.model.pmc006.line import command, reply
from openppmc.model.pmc006.program import assemble
from tests.common.pages import DOCS, chapters

TEXT = (DOCS / "pmc006/README.md").read_text(encoding="utf-8")
LONG = 60_000_000
"""Time limit in us; no motion of the page lasts longer."""


class Session:
    """A controller in factory state that plays a session of the page."""

    KINDS = {"m": "raw", "s": "reply", ">": "order", "<": "data", "idle": "idle", "at": "at", "=": "count",
             "pin": "pin", "ms": "ms"}  # fmt: skip

    def __init__(self) -> None:
        self.host = on_model(Host.start(OnModel(F8B)))
        self.since = 0

    def play(self, lines: list[str], where: str) -> None:
        """Play all lines; raise AssertionError for the first line whose result differs from the page."""
        for number, line in enumerate(lines, 1):
            # Two spaces begin a comment.
            kind, _, words = re.split(r"\s{2,}", line.strip())[0].partition(" ")
            found = on_model(getattr(self, self.KINDS[kind])(words))
            assert found is None or found == words, f"{where}, line {number}: {line!r} gave {found}"

    async def raw(self, words: str) -> None:
        await self.host.raw(words)

    async def reply(self, words: str) -> str:
        if not words:
            assert await self.host.is_silent(self.host.us(2000)), "a reply"
            return words
        await self.host.receive_reply()
        return self.host.wire.hex(" ").upper()

    async def order(self, words: str) -> None:
        code, data = (*words.split(), "0")[:2]
        await self.host.send_frame(int(code, 16) if code.startswith("0x") else code, int(data, 0))

    async def data(self, words: str) -> str:
        got = await self.host.receive_reply()
        return words if got == int(words, 0) & 0xFFFF_FFFF else str(got)

    async def idle(self, words: str) -> None:
        await self.host.until("mon_busy", 0, LONG)

    def step_count(self) -> int:
        """Return the steps since the last `=`."""
        return self.host.step_count(self.since)

    async def at(self, words: str) -> None:
        await self.host.sync()
        while self.step_count() < int(words):
            await self.host.next_steps(self.host.t + self.host.us(LONG))

    async def count(self, words: str) -> str:
        await self.host.sync()
        found = self.step_count()
        self.since = self.host.t
        return str(found)

    async def pin(self, words: str) -> None:
        name, level = words.split()
        await self.host.pins(**{name: int(level)})

    async def ms(self, words: str) -> None:
        await self.host.ms(int(words))


SESSIONS = {
    title: blocks for title, blocks in chapters(DOCS / "pmc006/README.md").items() if title.startswith("17.")
}


@pytest.mark.parametrize("title", SESSIONS, ids=lambda title: title.split()[0])
def test_session(title: str) -> None:
    """If the lines of a session are played in order, each has the result that the page shows."""
    assert SESSIONS[title]
    for block in SESSIONS[title]:
        Session().play(block, title)


def test_a_wrong_byte_is_found() -> None:
    """If a reply on the page is wrong, its line is reported."""
    with pytest.raises(AssertionError, match="line 2: '< 17' gave 16"):
        Session().play(["> k", "< 17"], "x")
    with pytest.raises(AssertionError, match="gave 0"):
        Session().play(["= 5"], "x")
    with pytest.raises(AssertionError, match="a reply"):
        Session().play(["> k", "s"], "x")


def test_frames_of_the_text_have_their_sums() -> None:
    """Each frame in the text of the page equals the frame that the model makes of its fields."""
    frames = [bytes.fromhex(text) for text in re.findall(r"`(A5(?: [0-9A-F]{2}){7})`", TEXT)]
    assert len(frames) >= 8
    for frame in frames:
        data = int.from_bytes(frame[3:7], "little")
        made = reply(frame[2], data) if frame[1] == 0x7A else command(frame[1], frame[2], data)
        assert bytes(made) == frame


def test_first_frames_get_their_replies() -> None:
    """A controller answers the frames of the first chapter as printed."""
    chapter = TEXT.split("## 1 In five minutes")[1].split("\n## ")[0]
    frames = re.findall(r"`(A5(?: [0-9A-F]{2}){7})`", chapter)
    session = Session()
    for question, answer in zip(frames[::2], frames[1::2], strict=True):
        session.play([f"m {question}", f"s {answer}"], "chapter 1")


def test_codes_of_the_page() -> None:
    """The table of instructions has all codes that have an effect, each with its letter."""
    table = TEXT.split("| Code | Letter |")[1].split("\n\n")[0]
    rows = re.findall(r"^\| 0x([0-9A-F]{2}) \| (.) \|", table, re.M)
    assert all(chr(int(code, 16)) == letter for code, letter in rows)
    assert {letter for _, letter in rows} == set(LETTERS)


def test_program_of_the_page() -> None:
    """The program of chapter 13 assembles to the words that the page shows."""
    (text,) = re.findall(r"^```asm\n(.*?)^```", TEXT, re.S | re.M)
    words = assemble(text).words
    assert words[:20] == (
        *(0x03, 1, 0x08, 3200, 0x0C, 0, 0x01, 200, 0x0810, 0),
        *(0x0B, 0, 0x0812, 3, 0x0E, 3, 0x0111, 1, 0, 0),
    )
    assert not any(words[20:])
