"""Functions of the PMC006B4's golden model without time: frames, code table, settings, programs, opcodes."""

from __future__ import annotations

import random

import pytest

from cocotb_tests.harness import verifies
from openppmc.model.pmc006.codes import LETTERS, TABLE, UNKNOWN
from openppmc.model.pmc006.instructions.operations import END, decode
from openppmc.model.pmc006.instructions.operations import TABLE as OPERATIONS
from openppmc.model.pmc006.line import Assembler, Command, changes_of, command, reply
from openppmc.model.pmc006.memory.boot import program_of
from openppmc.model.pmc006.memory.eeprom import sent
from openppmc.model.pmc006.settings import FACTORY_PAGE, Settings, page_of, values_of

FRAMES = {
    "A5 01 73 1F 01 00 00 39": command(1, "s", 287),
    "A5 7A 01 03 00 00 00 23": reply(1, 3),
    "A5 02 6D 04 00 00 00 18": command(2, "m", 4),
    "A5 7A 02 04 00 00 00 25": reply(2, 4),
    "A5 02 79 08 00 00 00 28": command(2, "y", 8),
    "A5 7A 02 08 00 00 00 29": reply(2, 8),
    "A5 FF 73 FF FF FF 7F 93": command(0xFF, "s", 0x7FFFFFFF),
    "A5 7A FF FB FF FF FF 16": reply(0xFF, -5),
    "A5 FF 57 80 0C 00 00 87": command(0xFF, "W", 3200),
    "A5 FF 55 00 00 00 00 F9": command(0xFF, 0x55),
}


@pytest.mark.parametrize("text", list(FRAMES))
@verifies("P006-FRM-09", "P006-FRM-02")
def test_worked_frames(text: str) -> None:
    assert FRAMES[text] == bytes.fromhex(text)


def take(assembler: Assembler, line: bytes) -> list[Command]:
    """Return the commands in a stream of bytes."""
    return [found for byte in line if (found := assembler.take(byte))]


@verifies("P006-FRM-01", "P006-FRM-02", "P006-FRM-06", "P006-FRM-08", "P006-BAD-01", "P006-BAD-02")
def test_assembler_on_random_streams() -> None:
    """From any stream, the assembler returns exactly the valid frames, with their data.

    The stream contains whole frames, random bytes except 0xA5, and damaged frames.
    """
    for seed in range(40):
        rng, line, wanted = random.Random(f"frames {seed}"), b"", []
        for _ in range(60):
            kind = rng.randrange(4)
            address, code = rng.randrange(256), rng.randrange(256)
            data = rng.choice((0, -1, 0x7FFFFFFF, -0x80000000, rng.getrandbits(31), 0x25A5A5A5))
            if kind == 0:
                line += bytes(byte for byte in rng.randbytes(5) if byte != 0xA5)
            elif kind == 1:
                frame = bytearray(command(address, code, data))
                frame[rng.randrange(1, 8)] ^= 1 << rng.randrange(8)
                line += bytes(frame)
            else:
                line += command(address, code, data)
                wanted.append(Command(address, code, data))
        assert take(Assembler(), line) == wanted, f"seed {seed}"


@verifies("P006-UART-05", "P006-FRM-03")
def test_pins_of_a_reply() -> None:
    """A reply has 80 contiguous bits that begin at 2 Tb; de is high from 1 Tb to 82 Tb."""
    changes = changes_of(reply(0xFF, 0x08))
    assert changes[0] == (1, "de", 1) and changes[-1] == (82, "de", 0)
    levels, level = [], 1
    edges = {at: value for at, pin, value in changes if pin == "txd"}
    for place in range(2, 82):
        level = edges.get(place, level)
        levels.append(level)
    characters = [levels[at : at + 10] for at in range(0, 80, 10)]
    assert all(bits[0] == 0 and bits[9] == 1 for bits in characters)
    frame = bytes(sum(bit << at for at, bit in enumerate(bits[1:9])) for bits in characters)
    assert frame == bytes.fromhex("A5 7A FF 08 00 00 00 26")


@verifies("P006-CMD-48", "P006-BAD-07")
def test_code_table() -> None:
    """Exactly 49 codes are known, among them V, which this project added."""
    known = "ABEFGIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
    assert sorted(LETTERS) == sorted(known) and len(TABLE) == 256
    assert {chr(code) for code in range(256) if TABLE[code] is not UNKNOWN} == set(known)


@verifies("P006-EEP-10", "P006-EEP-22")
def test_pages() -> None:
    assert FACTORY_PAGE.hex(" ").upper() == (
        "50 36 01 FF 10 00 00 00 01 01 00 00 58 02 58 02 2C 01 E2 04 20 03 00 00 00 00 00 00 00 00 00 82"
    )
    other = Settings(addr=1, mstep=4)
    assert page_of(other).hex(" ").upper() == (
        "50 36 01 01 04 00 00 00 01 01 00 00 58 02 58 02 2C 01 E2 04 20 03 00 00 00 00 00 00 00 00 00 78"
    )
    rng = random.Random(6)
    for _ in range(200):
        settings = Settings(
            addr=rng.choice((1, 120, 255)),
            mstep=rng.choice((0, 2, 4, 8, 16, 32, 64, 128)),
            cur=rng.randint(400, 4000),
            acc=rng.randint(0, 5),
            dec=rng.randint(0, 5),
            autodec=rng.randint(0, 1),
            att=rng.randint(1, 4),
            trigm=rng.randint(0, 3),
            offline=rng.randint(0, 1),
            vstart=rng.randint(65, 3000),
            vstop=rng.randint(65, 3000),
            ccomp=rng.randint(100, 1200),
            scomp=rng.randint(300, 2000),
            vmax=5,
        )
        page = bytes(sent(settings))
        assert page == page_of(settings)
        loaded = Settings(vmax=5)
        values = values_of(page)
        assert values is not None
        loaded.load(values)
        assert loaded == settings


def patched(*changes: tuple[int, int], repair: bool = True) -> bytes:
    """Return the factory page with some bytes changed; if `repair` is true, the checksum is correct."""
    page = bytearray(FACTORY_PAGE)
    for place, value in changes:
        page[place] = value
    if repair:
        page[31] = sum(page[:31]) & 0xFF
    return bytes(page)


LIMITS = {3: (1, 120), 6: (0, 5), 7: (0, 5), 8: (0, 1), 9: (1, 4), 10: (0, 3), 11: (0, 1)}
PAIRS = {12: (65, 3000), 14: (65, 3000), 16: (100, 1200), 18: (300, 2000), 20: (400, 4000)}


@verifies("P006-BAD-14", "P006-EEP-01")
def test_validity_of_every_byte_and_field() -> None:
    """A page is valid if and only if each byte and each pair in use has a legal value; unused fields may have
    any value.
    """
    for place in range(31):
        for value in range(256):
            if place < 3:
                good = value == FACTORY_PAGE[place]
            elif place in LIMITS:
                low, high = LIMITS[place]
                good = low <= value <= high or (place == 3 and value == 255)
            elif place == 4:
                good = value in (0, 2, 4, 8, 16, 32, 64, 128)
            elif place in (5, *range(22, 31)):
                good = True
            else:
                continue
            assert (values_of(patched((place, value))) is not None) == good, (place, value)
    for place, (low, high) in PAIRS.items():
        for value in (0, low - 1, low, high, high + 1, 0xFFFF, low | 0x8000):
            page = patched((place, value & 0xFF), (place + 1, value >> 8))
            assert (values_of(page) is not None) == (low <= value <= high), (place, value)
    for place in range(32):
        for bit in range(8):
            flipped = patched((place, FACTORY_PAGE[place] ^ 1 << bit), repair=False)
            assert values_of(flipped) is None, "one bit of a sum of bytes is always seen"


@verifies("P006-BAD-15", "P006-EEP-11")
def test_validity_of_programs() -> None:
    rng = random.Random(15)
    body = rng.randbytes(800)
    block = body + (sum(body) & 0xFFFF).to_bytes(2, "little") + b"\x5a"
    words = program_of(block)
    assert words is not None and len(words) == 200 and words[0] == int.from_bytes(body[:4], "little")
    assert words[199] == int.from_bytes(body[-4:], "little")
    for place in (*rng.sample(range(800), 40), 800, 801, 802):
        damaged = bytearray(block)
        damaged[place] ^= 1 << rng.randrange(8)
        assert program_of(bytes(damaged)) is None, place
    assert program_of(b"\xff" * 803) is None and program_of(bytes(803)) is None
    assert program_of(bytes(802) + b"\x5a") == [0] * 200


@verifies("P006-BAD-16", "P006-PRG-20")
def test_opcodes() -> None:
    """Each word decodes to its fields; opcode 0 and all opcodes from 0x15 on are END."""
    assert sorted(OPERATIONS) == list(range(0x15))
    for opcode in range(256):
        operation, option, operand = decode(0xABCD_5A00 | opcode, 0xFFFF_FFFE)
        assert (operation is END) == (opcode == 0 or opcode > 0x14) and (option, operand) == (0x5A, -2)
    alone = {opcode for opcode, operation in OPERATIONS.items() if operation.single}
    assert alone == {*range(0x01, 0x0D), 0x11, 0x12}
