"""The examples of docs/ppmc312/examples.md and of chapter 1 of docs/ppmc312/README.md, on the golden
model.
"""

from __future__ import annotations

import re

import pytest

from cocotb_tests.harness import OnModel, on_model
from cocotb_tests.harness.bus import clean
from cocotb_tests.ppmc312.host import Host
from openppmc.model.ppmc312.codes import LENGTHS, OVERRIDABLE, Code, State, accepts
from tests.common.pages import DOCS, chapters

PAGE = DOCS / "ppmc312/examples.md"
MS = 16_000
LONG = 60_000_000  # cycles; no step of the page takes longer


class Player:
    """One session on the bus. `lines` are those of the page."""

    KINDS = {
        "w": "write",
        "r": "read",
        ">": "send",
        "<": "answer",
        "pin": "pin",
        "at": "at",
        "ms": "ms",
        "=": "count",
    }

    def __init__(self) -> None:
        self.host = on_model(Host.start(OnModel()))

    def play(self, lines: list[str], where: str) -> None:
        """Play all lines; raise AssertionError for the first line whose result differs from the page."""
        for number, line in enumerate(lines, 1):
            kind, _, rest = line.partition(" ")
            # Two spaces begin a comment.
            words = re.split(r"\s{2,}", rest.strip())[0]
            found = on_model(getattr(self, self.KINDS[kind])(words))
            assert found is None or found == words, f"{where}, line {number}: {line!r} gave {found}"

    async def write(self, words: str) -> None:
        rs, byte = (int(word, 16) for word in words.split())
        await self.host.write(rs, byte)

    async def read(self, words: str) -> str:
        rs = words.split()[0]
        return f"{rs} {await self.host.read(int(rs)):02X}"

    async def send(self, words: str) -> None:
        mark = self.host.mark
        await self.host.issue(words)
        self.host.mark = mark

    async def answer(self, words: str) -> str:
        got = await self.host.response(LONG)
        return words if got == clean(words) else got

    async def pin(self, words: str) -> None:
        name, *levels = words.split()
        for level in levels:
            await self.host.pins(**{name: int(level)})
            await self.host.pause(20)

    async def at(self, words: str) -> None:
        await self.host.pulse(int(words))

    async def ms(self, words: str) -> None:
        await self.host.pause(int(words) * MS)

    async def count(self, words: str) -> str:
        found = len(self.host.pulses())
        self.host.mark = self.host.t
        return str(found)


CHAPTERS = chapters(PAGE)


@pytest.mark.parametrize("title", CHAPTERS, ids=lambda title: title.split()[0])
def test_session(title):
    """If the lines of a chapter are played in order, each has the result that the page shows."""
    player = Player()
    for block in CHAPTERS[title]:
        player.play(block, title)


def test_a_wrong_byte_is_found():
    """If a byte on the page is wrong, its line is reported."""
    with pytest.raises(AssertionError, match="line 2: '< 03 02 40 13' gave 03 02 40 12"):
        Player().play(["> 03 01 40", "< 03 02 40 13"], "x")
    with pytest.raises(AssertionError, match="gave 0 04"):
        Player().play(["r 0 00"], "x")
    with pytest.raises(AssertionError, match="gave 0"):
        Player().play(["= 5"], "x")


def test_first_move_of_the_manual_is_that_of_the_examples():
    """The writes and blocks in chapter 1.1 of the manual are those of example 1."""
    text = (DOCS / "ppmc312/README.md").read_text(encoding="utf-8")
    chapter = text.split("### 1.1 ")[1].split("\n## ")[0]
    writes = [line[2:].split("  ")[0].strip() for line in CHAPTERS["1 The first move, every access"][0]
              if line.startswith("w")]  # fmt: skip
    printed = re.findall(r"`w (\d \w\w)`", chapter)
    assert printed == writes[: len(printed) - 1] + [writes[13]]
    dwr = re.findall(r"then write ([0-9A-F ]+) into DWR", chapter)[0].split()
    assert [f"5 {byte}" for byte in dwr] == writes[14:]
    blocks = [clean(block) for block in re.findall(r"`([0-9A-F ]{8,})`", chapter)]
    assert blocks[0] == clean("".join(word[2:] for word in writes[12:1:-1]))
    assert blocks[2] == clean("".join(word[2:] for word in writes[:13:-1]))


def test_free_curve_of_the_instructions_page():
    """On the instructions page, each block of the transfer has the answer that is printed below it."""
    text = (DOCS / "ppmc312/instructions.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```\n(.*?)^```", text, re.S | re.M)
    lines = [line.strip() for line in block.splitlines()]
    Player().play([f"{'<' if n % 2 else '>'} {line}" for n, line in enumerate(lines)], "free curve")


STATES = (State.INI, State.NOR, State.ACC, State.FIX, State.ABN, State.WRN)


def accepted() -> dict[int, list[str]]:
    """Return code -> cells of the manual's table of accepted instructions in each state."""
    text = (DOCS / "ppmc312/README.md").read_text(encoding="utf-8")
    head = "| Instruction | INI | NOR | ACC | FIX | ABN | WRN |\n"
    rows = text.split(head)[1].split("\n\n")[0].splitlines()[1:]
    found = {}
    for row in rows:
        name, *cells = [cell.strip() for cell in row.strip("|").split("|")]
        for code in re.findall(r"\b[0-9A-F]{2}\b", name):
            found[int(code, 16)] = cells
    return found


def test_table_of_states_is_that_of_the_model():
    """The manual's table of states agrees with the model, for each instruction in each state."""
    table = accepted()
    assert set(table) == set(LENGTHS)
    for code, cells in table.items():
        for state, cell in zip(STATES, cells, strict=True):
            for override in {False, code in OVERRIDABLE}:
                word = cell.split("/")[override] if "/" in cell else cell
                has_table = state != State.INI
                at = f"{code:02X} in {state.name}, OV = {override:d}: {cell!r}"
                assert (word == "O") == accepts(code, state, override, False, has_table), at
                if word == "END wait":
                    assert accepts(code, state, override, True, has_table), at
                if word == "with a table":
                    assert accepts(code, state, override, False, True), at


def test_lengths_of_the_instructions_page():
    """The list of instructions has the lengths that the model accepts; each instruction has a chapter."""
    text = (DOCS / "ppmc312/instructions.md").read_text(encoding="utf-8")
    head = text.split("\n## ")[0]
    rows = re.findall(r"\| \[([0-9A-F, ]+)\]\(#[^)]+\) \| [^|]+ \| ([^|]+) \|", head)
    found = {}
    for codes, lengths in rows:
        for code in codes.split(", "):
            found[int(code, 16)] = [int(word, 16) for word in re.findall(r"[0-9A-F]{2}", lengths)]
    assert set(found) == set(LENGTHS)
    for code, lengths in found.items():
        if code != Code.EVENT_SET:
            assert sorted(lengths) == sorted(LENGTHS[code]), f"{code:02X}"
        assert re.search(rf"^### (?:[0-9A-F]{{2}}, )*{code:02X}\b", text, re.M), f"{code:02X}"
