"""If the power fails during a save, at any edge of the EEPROM's lines, the old or the new settings remain."""

from __future__ import annotations

import random
from collections.abc import Iterator
from copy import copy
from functools import cache

import pytest

from cocotb_tests.harness import verifies
from cocotb_tests.pmc006.i2c_bus import I2cBus
from openppmc.model.carrier.eeprom import Eeprom24C32
from openppmc.model.pmc006.line import command
from openppmc.model.pmc006.part import Pmc006
from openppmc.model.pmc006.settings import LEGAL, PLACES, Settings, page_of, values_of

CLK_HZ, BAUD, COPY = 8_000_000, 115_200, 0x360
RELEASES = {"together": ((1, 1),), "scl first": ((1, 0), (1, 1)), "sda first": ((0, 1), (1, 1))}
"""Levels of SCL and SDA while a reset releases them; one pull-up may be faster than the other."""


@cache
def lines(page: bytes, content: bytes = b"") -> tuple[tuple[int, int], ...]:
    """Return the successive levels that the part drives on both lines while it saves the settings of
    `page`, after a boot with this content of the EEPROM.
    """
    part = Pmc006(CLK_HZ, baud=BAUD)
    I2cBus(part, Eeprom24C32(CLK_HZ, content, write_us=0))
    part.run_until(CLK_HZ // 20)
    values = values_of(page)
    assert values is not None
    part.context.settings.load(values)
    since, bit = part.now, CLK_HZ / BAUD
    for number, byte in enumerate(command(values["addr"], "t")):
        part.on_char(since + 1 + round((10 * number + 9.5) * bit), byte)
    part.run_until(since + CLK_HZ // 200)
    levels, found = {"scl_oe": 0, "sda_oe": 0}, []
    edges = sorted((t, pin, level) for pin in levels for t, level in part.log.of(pin, since))
    for place, (t, pin, level) in enumerate(edges):
        levels[pin] = level
        if place + 1 == len(edges) or edges[place + 1][0] != t:
            found.append((1 - levels["scl_oe"], 1 - levels["sda_oe"]))
    return tuple(found)


def cuts(content: bytes, changes: tuple[tuple[int, int], ...], release: str) -> Iterator[bytes]:
    """Yield the content of the EEPROM if only 0, 1, 2 .. of these changes occur before both lines are
    released.
    """
    chip = Eeprom24C32(CLK_HZ, content, write_us=0)
    for t, levels in enumerate(((1, 1), *changes)):
        _look(chip, t, *levels)
        cut = copy(chip)
        cut.memory, cut.writes = bytearray(chip.memory), []
        for later, end in enumerate(RELEASES[release], 1):
            _look(cut, t + later, *end)
        yield bytes(cut.memory)


def _look(chip: Eeprom24C32, t: int, scl: int, sda: int) -> None:
    chip.on_lines(t, scl, sda and not chip.sda)


def judged(memory: bytes) -> dict[str, int] | None:
    """Return the settings that a boot loads (P006-BAD-14): those of the block, or else those of its copy."""
    return values_of(memory[:32]) or values_of(memory[COPY : COPY + 32])


def some(rng: random.Random) -> bytes:
    """Return a page with random legal settings."""
    return page_of(Settings(**{name: rng.choice(list(LEGAL[name])) for name in PLACES}))  # type: ignore[call-overload]


def mixes(old: bytes, new: bytes) -> bool:
    """Return whether some mixture of both pages has a correct checksum by chance.

    The part cannot detect this case, which occurs in one of 256 changes.
    """
    torn = [new[:place] + old[place:] for place in range(1, 32)]
    return any(values_of(page) is not None for page in torn if page not in (old, new))


@pytest.mark.parametrize("release", list(RELEASES))
@pytest.mark.parametrize("seed", range(2))
@verifies("P006-EEP-10", "P006-BAD-24", "P006-BAD-14")
def test_a_cut_at_any_edge_of_the_lines(seed: int, release: str) -> None:
    """If a save is cut off at any edge of the lines, the old or the new settings remain.

    Before the save, the EEPROM has a page without a copy, or one of the two is already damaged.
    """
    rng = random.Random(seed)
    old = new = some(rng)
    while old == new or mixes(old, new):
        new = some(rng)
    torn = new[:9] + old[9:]
    starts = {
        "copy": old.ljust(COPY, b"\xff") + old,
        "no copy": old,
        "torn copy": old.ljust(COPY, b"\xff") + torn,
        "torn page": torn.ljust(COPY, b"\xff") + old,
    }
    for name, content in starts.items():
        changes, seen = lines(new, content), []
        assert len(changes) > 1200
        for cut, memory in enumerate(cuts(content, changes, release)):
            values = judged(memory)
            assert values in (values_of(old), values_of(new)), f"{name}, {cut} changes: {values}"
            seen.append(values == values_of(new))
        assert not seen[0] and seen[-1]


@verifies("P006-EEP-10")
def test_the_copy_goes_first() -> None:
    """The copy is written before the block, so one of the two is always complete."""
    new = page_of(Settings(addr=9, mstep=64))
    changes = lines(new)
    halves = list(cuts(b"", changes, "together"))
    copied = next(place for place, memory in enumerate(halves) if memory[COPY : COPY + 32] == new)
    written = next(place for place, memory in enumerate(halves) if memory[:32] == new)
    assert copied < written
