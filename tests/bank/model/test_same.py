"""An axis of the bank compared with a PPMC-104: the edges of a move are the same, shifted by a constant."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from openppmc.model import Ppmc104
from tests.bank.model.host import CONFIG, Host
from tests.common.model.host import ModelHost

AXES = 32
Seen = tuple[list[tuple[int, int]], list[tuple[int, int]], tuple[int, int]]
"""Changes of pout_n and of s in cycles after the start, finish status and remaining pulses."""


@dataclass(frozen=True)
class Move:
    """Configuration and commands of a move.

    Attributes:
        config: levels of csel and vsel.
        cut: the stop code or the switch that cuts the move short, and its time in rounds after the start.
    """

    config: int
    init: tuple[int, ...]
    operation: tuple[int, ...]
    cut: tuple[int | str, int] | None


def script(code: tuple[int, ...]) -> str:
    """Return a command and its data bytes as a script."""
    return " ".join(f"{'d' if place else 'c'} {byte:02X}" for place, byte in enumerate(code))


@st.composite
def moves(draw: st.DrawFn) -> Move:
    """Draw a move: ramp or constant speed, phase or POUT mode, direction, clock, complete or cut short."""
    rl = draw(st.integers(0, 40))
    rh, pa = draw(st.integers(0, rl)), draw(st.integers(4, 30))
    motor = draw(st.sampled_from((0x01, 0x02, 0x03, 0x05, 0x0E, 0x0F)))
    way, count, rate = draw(st.sampled_from((0, 8))), draw(st.integers(0, 80)), draw(st.integers(0, 40))
    codes = [
        (0x42 | way,),
        (0x43 | way, count, 0, 0),
        (0xC3 | way, count, 0, 0),
        (0x44 | way, rate, count, 0, 0),
        (0x46 | way,),
        (0xC6 | way,),
        (0x45 | way, rate),
        (0x47 | way, rate),
    ]
    operation = draw(st.sampled_from(codes))
    cause = draw(st.sampled_from((0x40, 0x41, "l1_n", "l2_n", "alm_n", "cnp_n")))
    endless = operation[0] & 7 in (5, 6, 7)
    if endless:
        cause = draw(st.sampled_from((0x40, 0x41, "alm_n")))
    cut = (cause, draw(st.integers(5, 1500))) if endless or draw(st.booleans()) else None
    return Move(draw(st.integers(0, 3)), (motor, rl, rh, pa, 0), operation, cut)


def seen(changes: list[list[tuple[int, int]]], start: int, end: tuple[int, int]) -> Seen:
    """Return the results of one device; changes of the outputs at the start or before it are omitted."""
    pout_n, s = ([(t - start, level) for t, level in found if t > start] for found in changes)
    return pout_n, s, end


def alone(move: Move, clk_hz: int) -> Seen:
    """Run the move on the PPMC-104; its motor pins change one cycle after the event that causes the
    change.
    """

    class Single(ModelHost):
        MODEL = Ppmc104

    host = Single(clk_hz=clk_hz)
    host.pins(csel=move.config & 1, vsel=move.config >> 1)
    host.run(script(move.init))
    host.pause(40_000)
    host.run(script(move.operation))
    host.sync()
    log = host.model.log
    start = log.falls("hold")[0]
    if move.cut:
        cause, rounds = move.cut
        host.go(start - 1 + rounds * AXES - (2 if isinstance(cause, str) else 6))
        if isinstance(cause, str):
            host.pins(**{cause: 0})
        else:
            host.write(1, cause)
    end = host.finish()
    return seen([log.of("pout_n"), log.of("s")], start, end)


def in_bank(move: Move, clk_hz: int, axis: int) -> Seen:
    """Run the move on an axis of the bank."""
    host = Host(AXES, clk_hz=clk_hz)
    host.write(axis, CONFIG, move.config)
    host.send(axis, script(move.init))
    host.t += 40_000
    start = host.send(axis, script(move.operation))
    if move.cut:
        cause, rounds = move.cut
        act = start + rounds * AXES
        if isinstance(cause, str):
            host.pin(act - 2, axis, **{cause: 0})
        else:
            host.write_at(act - 7, axis, 1, cause)
    end = host.finish(axis)
    bits = [host.model.bits(name, axis) for name in ("pout_n", "s")]
    return seen(bits, start, end)


@pytest.mark.parametrize("clk_hz", [32_000_000, 100_000_000])
@settings(max_examples=100)
@given(move=moves(), axis=st.integers(0, AXES - 1))
def test_same_edges(clk_hz, move, axis):
    """Every edge of pout_n and s and the end of a motion are those of a PPMC-104 (BANK-MOT-01, BANK-MOT-02,
    BANK-GEN-02).
    """
    assert in_bank(move, clk_hz, axis) == alone(move, clk_hz)


@pytest.mark.parametrize("config", range(4))
def test_same_ramp(config):
    """For each csel and vsel, the worked ramp on a bank equals that on a PPMC-104 (BANK-GEN-04,
    BANK-MOT-01).
    """
    move = Move(config, (0x0A, 0x13, 0x09, 0x0A, 0), (0x43, 0x40, 0, 0), None)
    pout_n, _, end = in_bank(move, 100_000_000, 7)
    assert (pout_n, end) == alone(move, 100_000_000)[::2] and len(pout_n) == 2 * 65


@pytest.mark.parametrize("code", [0x01, 0x05, 0x0A, 0x0E, 0x23, 0x0F])
def test_same_patterns(code):
    """For each motor, the phase patterns of one turn and back are those of a PPMC-104 (BANK-MOT-01)."""
    for way in (0, 8):
        move = Move(3, (code, 5, 5, 4, 0), (0x44 | way, 3, 11, 0, 0), None)
        assert in_bank(move, 32_000_000, 31)[0:3:2] == alone(move, 32_000_000)[0:3:2]
