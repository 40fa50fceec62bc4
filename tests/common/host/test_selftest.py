"""The self-test without a board: records, page, versions. Tests with a board are in tests/common/board."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from openppmc import __version__, parts, sources
from openppmc.check.pins import pins_of
from openppmc.check.records import Change
from openppmc.check.replay import compare_recording, expected_edges, new_model
from openppmc.cli.common.session import mismatch
from openppmc.host.script import BadAnswer, Build, Identity
from openppmc.host.selftest.page import board_name, built
from openppmc.host.selftest.plan import Plan
from openppmc.host.selftest.recording import Layout, NoReset, Recorded, recording_of, reset_levels

PLANS = [row.name for row in parts.having("selftest")]
WIDTHS = {"ppmc104": 49, "ppmc2104": 63, "stmc": 36, "ppmc312": 63, "bank": 144}
"""Number of levels in a record of each carrier (of the bank with 8 axes)."""
BEGIN, RESET = 5, 16
CLK = 8_000_000


def plan_of(part: str) -> Plan:
    plan: Plan = parts.part(part).load("selftest")
    return plan


def identity(part: str) -> Identity:
    return Identity(1, parts.part(part).number, False, True, 4, 16_000_000, CLK)


def word(layout: Layout, levels: dict[str, int]) -> int:
    """Return the levels of the pins in the format of a record."""
    value, place = 0, 0
    for pin, width in layout:
        value |= levels[pin] << place
        place += width
    return value


def recorded(part: str, changes: Iterable[Change], end: int) -> list[tuple[int, int]]:
    """Return the records of a board that behaves as the golden model.

    The first record has arbitrary output levels; then come a reset and these changes.
    """
    layout = plan_of(part).layout(WIDTHS[part])
    (params, *_) = plan_of(part).params(identity(part), WIDTHS[part], {"s": 1})
    pins = pins_of(new_model(part, params))
    first = [Change(BEGIN, "rst_n", 0), Change(BEGIN + RESET, "rst_n", 1), *changes]
    edges = expected_edges(part, params, first, end)
    levels = {**pins.inputs, **pins.outputs, "rst_n": 1}
    rows = [(c.t, c.pin, c.value) for c in first] + [(e.t + 1, e.signal, e.value) for e in edges]
    junk = {**levels, **{name: 0 for name in pins.outputs}}
    samples = [(0, word(layout, junk))]
    for t in sorted({t for t, _, _ in rows}):
        levels.update({name: value for when, name, value in rows if when == t})
        samples.append((t, word(layout, levels)))
    return [*samples, (end, samples[-1][1])]


def compared(part: str, samples: list[tuple[int, int]]) -> tuple[int, str]:
    """Return the number of compared edges, and the first output that differs ("" if there is no
    difference).
    """
    plan, width = plan_of(part), WIDTHS[part]
    layout = plan.layout(width)
    (params, *_) = plan.params(identity(part), width, reset_levels(samples, layout))
    pins = pins_of(new_model(part, params))
    watched = {name for name, _ in layout}
    recording = recording_of(samples, layout, part, params, {**pins.inputs, "rst_n": 1}, pins.outputs)
    initial = {name: level for name, level in pins.outputs.items() if name in watched}
    found = compare_recording(recording, initial)
    return found.edges_compared, found.mismatch.signal if found.mismatch else ""


def initialisation() -> list[Change]:
    rows, t = [], 200
    for register, byte in [(1, 0x0A), (0, 9), (0, 4), (0, 4), (0, 0), (1, 0x42)]:
        rows += [Change(t, "a0", register), Change(t, "d_i", byte), Change(t, "cs_n", 0)]
        rows += [Change(t + 1, "wr_n", 0), Change(t + 5, "wr_n", 1), Change(t + 6, "cs_n", 1)]
        t += 60 if register or byte else 60_000
    return rows


@pytest.mark.parametrize("part", PLANS)
def test_layouts(part: str) -> None:
    """All pins of a device's records are pins of its golden model with the same widths."""
    width = WIDTHS[part]
    layout = plan_of(part).layout(width)
    assert sum(bits for _, bits in layout) == width
    (params, *_) = plan_of(part).params(identity(part), width, {"s": 0})
    pins = pins_of(new_model(part, params))
    assert all(pins.width(name) == bits for name, bits in layout)
    names = {name for name, _ in layout}
    assert names <= {*pins.inputs, *pins.outputs, "rst_n"}
    # A PPMC-312 on a bus does not use its serial line and the related straps.
    serial = {"mode", "rxd", "hsp", "mod", "adr", "txd", "snd"}
    assert {*pins.inputs, *pins.outputs} - names == (serial if part == "ppmc312" else set())


@pytest.mark.parametrize("part", PLANS)
def test_sections(part: str) -> None:
    """Each device has sections of every kind with unique titles, and not fewer sections for a smaller
    memory.
    """
    plan, width = plan_of(part), WIDTHS[part]
    large, small = (plan.sections(identity(part), width, n) for n in (8192, 512))
    wired = plan.switches(identity(part), width)
    assert {one.what for one in [*large, *wired]} == {"registers", "commands", "moves", "switches"}
    titles = [one.title for one in [*large, *wired]]
    assert len(set(titles)) == len(titles) and len(plan.jumpers) == 2
    assert len(small) >= len(large)


@pytest.mark.parametrize("part", PLANS)
def test_a_reset_is_no_difference(part: str) -> None:
    """Any levels before the reset cause no difference; a wrong level during the reset is reported."""
    samples = recorded(part, [], 5_000)
    assert compared(part, samples)[1] == ""
    flip = 1 << WIDTHS[part] - 1
    wrong = [(t, levels ^ flip) if t > BEGIN + 1 else (t, levels) for t, levels in samples]
    assert compared(part, wrong)[1] == plan_of(part).layout(WIDTHS[part])[-1][0]


def test_a_step_and_one_clk_too_late() -> None:
    """A recorded step that equals the golden model has no difference; a pulse one cycle late is reported."""
    samples = recorded("ppmc104", initialisation(), 120_000)
    count, wrong = compared("ppmc104", samples)
    assert count == 6 and not wrong  # the edges are those of s, hold, pout_n, s, pout_n and int_n
    pulse = 1 << sum(bits for name, bits in plan_of("ppmc104").layout(49)[:-2])
    place = next(n for n, (t, levels) in enumerate(samples) if t > BEGIN + RESET and not levels & pulse)
    late = samples[place]
    assert compared("ppmc104", [*samples[:place], (late[0] + 1, late[1]), *samples[place + 1 :]])[1]


def test_no_reset() -> None:
    """Records without a reset cause NoReset."""
    with pytest.raises(NoReset):
        compared("ppmc104", [(0, 1), (9, 1)])


def test_recorded() -> None:
    """UB-REC-02, -03: state and records (cycle, levels) are decoded; an incomplete record at the end is
    ignored.
    """
    info = Recorded.parse(bytes([3, 15, 5, 2, 7, 0, 0, 0]) + bytes(8))
    assert (info.width, info.most, info.running, info.full, info.count) == (9, 32, False, True, 7)
    words = [0x155 << 15, 0x0AA << 15 | 4, 0x0AB << 15 | 1]
    data = b"".join(one.to_bytes(3, "little") for one in words) + b"\x01"
    assert list(info.samples(data)) == [(0, 0x155), (4, 0xAA), (5, 0xAB)]
    for bad in (bytes(16), bytes(15), bytes([3, 24, 5]) + bytes(13)):
        with pytest.raises(BadAnswer):
            Recorded.parse(bad)


def test_versions() -> None:
    """UB-VER-01: the host decodes the version data of a bitstream. If bitstream and package do not match, one
    line states what to do.
    """
    data = sources.build_id("1.2.3", bytes.fromhex("1a2b3c4d"), bytes.fromhex("deadbeef99"), True, "ICEB")
    build = Build.parse(data)
    assert build == Build("1.2.3", True, "1a2b3c4d", "deadbeef", "ICEB")
    assert board_name(build) == "iCEBreaker"
    assert built(build) == "version 1.2.3, sources 1a2b3c4d, commit deadbeef with changes"
    assert sources.build_define(data).endswith(data[::-1].hex())
    assert Build.parse(bytes(16)) is None and board_name(None) == "board"
    assert "renew the package" in mismatch(build, 104)
    assert "renew the bitstream" in mismatch(Build("0.0.1", False, "", "", ""), 104)
    assert "other sources (1a2b3c4d)" in mismatch(Build(__version__, False, "1a2b3c4d", "", ""), 104)
    assert mismatch(None, 104) == mismatch(Build(__version__, False, "", "", "MODL"), 104) == ""
