"""Scripts: moves and speed mode: intervals, planning, retargets, the ends of motion."""

from __future__ import annotations

from typing import NamedTuple

import pytest

from cocotb_tests.harness.verifies import verifies

from .scenes import DECAY, after_steps, brisk, cruise, move, quick, rest, run, start, still
from .script_host import EXECUTE, START, Host


class Move(NamedTuple):
    """A row of chapter 14.2: count, settings, time of the last step, first and last intervals in us."""

    count: int
    settings: tuple[int, int, int, int, int]
    end: int
    head: tuple[int, ...]
    tail: tuple[int, ...]


MOVES = (
    Move(1, (600, 600, 3200, 3, 3), 1667, (1667,), (1667,)),
    Move(2, (600, 600, 3200, 3, 3), 3334, (1667, 1667), (1667, 1667)),
    Move(3, (600, 600, 3200, 3, 3), 5000, (1667, 1667, 1666), (1667, 1667, 1666)),
    Move(10, (600, 600, 3200, 3, 3), 16667, (1667, 1667, 1666, 1667), (1667, 1666, 1667)),
    Move(1, (3000, 65, 3200, 3, 3), 460, (460,), (460,)),
    Move(4, (3000, 65, 3200, 3, 3), 44509, (460, 13279, 15385, 15385), (13279, 15385, 15385)),
    Move(50, (3000, 600, 5000, 3, 5), 30915, (335, 338, 342, 345), (1662, 1667, 1667)),
    Move(256, (600, 600, 16000, 3, 3), 121101, (1661, 1621, 1551, 1467), (1667, 1667, 1666)),
)
PLANNING = tuple(f"P006-MOT-{n}" for n in ("10", "11", "12", "13", "14", "15", "16", "17", "20", "22", "23"))


@pytest.mark.parametrize("row", MOVES)
@verifies(*PLANNING, "P006-MOT-01", "P006-MOT-02", "P006-MOT-03", "P006-MOT-04", "P006-MOT-05")
def test_moves_of_the_table(row: Move) -> None:
    host = Host()
    low, high, limit, acc, dec = row.settings
    host.ok(L=low, S=high, v=limit, u=acc, o=dec)
    start(host, row.count)
    e = host.e
    fall = rest(host)
    steps = host.steps()
    gaps = (row.head[0], *host.intervals())
    assert (
        len(steps) == row.count and gaps[: len(row.head)] == row.head and gaps[-len(row.tail) :] == row.tail
    )
    assert host.in_us(steps[-1] - steps[0]) == row.end - row.head[0] and 0 <= fall - steps[-1] <= 2
    assert 0 <= steps[0] - host.us(row.head[0]) - e <= EXECUTE + START + host.us(1)


@verifies("P006-MOT-04", "P006-STA-18", "P006-CMD-53")
def test_when_a_motion_begins() -> None:
    """BUSY is up before the reply; the first interval counts from t = 0, which comes within 1024 clk."""
    for count, speed in ((1, 3000), (255, 3000), (256, 3000), (100_000, 16_000), (0x7FFFFFFF, 16_000)):
        host = Host()
        host.ok(L=3000, S=3000, v=speed, u=5, o=5)
        start(host, count)
        e = host.e
        assert 0 < host.edges("mon_busy", host.mark)[0][0] - e <= EXECUTE
        after_steps(host, 1)
        assert 0 <= host.steps()[0] - host.us(333) - e <= EXECUTE + START + host.us(2)
        assert host.ask("I") == 0


@verifies("P006-MOT-03", "P006-MOT-40", "P006-MOT-01")
def test_constant_speeds_have_no_jitter() -> None:
    """Each step is at the next whole us after its exact time."""
    for speed in (2999, 1601, 700):
        host = quick(speed)
        run(host)
        after_steps(host, 21)
        whole = [-(-number * 1_000_000 // speed) for number in range(1, 22)]
        assert host.intervals() == [b - a for a, b in zip(whole, whole[1:], strict=False)]


@verifies("P006-MOT-01", "P006-MOT-03", "P006-MOT-13", "P006-MOT-14", "P006-MOT-40")
def test_the_highest_speed() -> None:
    host = Host()
    host.ok(L=3000, S=3000, v=16_000, u=5, o=5)
    run(host)
    mark = host.mark
    cruise(host, 62.5)
    host.ms(20)
    gaps = host.intervals(mark)
    assert gaps[-4:] in ([63, 62, 63, 62], [62, 63, 62, 63])
    assert all(b <= a + 1 for a, b in zip(gaps, gaps[1:], strict=False)), "the speed falls"
    assert host.ask("I") == 0 and host.position() == host.made(mark)


@verifies("P006-MOT-40", "P006-MOT-41", "P006-MOT-15", "P006-STA-13")
def test_stop_in_the_middle_of_the_ramp() -> None:
    """W10: N 0 is seen at t = 100,000."""
    host = Host()
    host.ok(e=1000, u=3, o=3, v=3200)
    run(host)
    mark = host.mark
    first = after_steps(host, 1)
    origin = first - host.us(1667)
    host.go(origin + host.us(99_950) - int(80 * host.bit))
    assert host.ask("N", 0) == 0
    assert origin + host.us(99_900) < host.e < origin + host.us(99_999)
    fall = rest(host)
    gaps = host.intervals(mark)
    assert len(gaps) == 243 and gaps[:4] == [1663, 1657, 1647, 1636] and gaps[-3:] == [1633, 1649, 1660]
    assert abs(fall - origin - host.us(202_300)) <= host.us(2) + 8


@verifies("P006-MOT-41", "P006-MOT-40", "P006-STA-02")
def test_stop_when_already_slow() -> None:
    """W8 and W14: without a ramp the end is the next update tick."""
    for speed, stop in ((50, 600), (2500, 2500)):
        host = Host()
        host.ok(v=speed, S=stop, L=max(65, speed))
        run(host)
        mark = host.mark
        after_steps(host, 2)
        assert host.ask("N", 0) == 0
        fall = rest(host)
        assert fall - host.e <= host.us(200) + EXECUTE
        assert set(host.intervals(mark)) == {1_000_000 // speed}


@verifies("P006-MOT-30", "P006-MOT-50", "P006-CMD-43", "P006-CMD-54")
def test_retargets() -> None:
    """A new VMAX is the new goal from the next update on, up and down, in the ramp as in cruise."""
    host = Host()
    host.ok(L=2000, S=2000, v=2200, u=5, o=5)
    run(host)
    mark = host.mark
    cruise(host, 1_000_000 / 2200)
    host.ok(v=2400)
    after_steps(host, host.made() + 2)
    host.ok(v=2100)
    cruise(host, 1_000_000 / 2100)
    host.ms(3)
    host.ok(v=2500)
    cruise(host, 400)
    assert host.ask("N", 0) == 0
    rest(host)
    assert host.position() == host.made(mark)


@verifies("P006-MOT-30", "P006-MOT-15", "P006-MOT-20")
def test_retargets_of_a_move() -> None:
    """Exactly N steps, whatever VMAX does; below VSTOP the motion keeps the target to its last step."""
    host = Host()
    host.ok(L=2000, S=2000, v=2600, u=5, o=5)
    start(host, 300)
    mark = host.mark
    after_steps(host, 30)
    host.ok(v=3000)
    after_steps(host, host.made() + 20)
    host.ok(v=2300)
    rest(host)
    gaps = host.intervals(mark)
    assert host.made(mark) == 300 and max(gaps) <= 500 and gaps[-1] >= 490
    host.ok(L=3000, S=3000, v=3000)
    start(host, 256)
    mark = host.mark
    after_steps(host, 150)
    host.ok(v=2500)
    rest(host)
    gaps = host.intervals(mark)
    assert host.made(mark) == 256 and set(gaps[-5:]) == {400}


@verifies("P006-MOT-30", "P006-MOT-23")
def test_motions_that_ignore_a_retarget() -> None:
    """A short move, and the last deceleration of a long one."""
    host = quick(2500)
    start(host, 60)
    mark = host.mark
    host.ok(v=16_000)
    rest(host)
    assert set(host.intervals(mark)) == {400}
    host.ok(L=2500, S=1500, v=2600, u=5, o=5)
    start(host, 256)
    mark = host.mark
    after_steps(host, 256 - 12)
    host.ok(v=10_000)
    rest(host)
    gaps = host.intervals(mark)[-11:]
    assert host.made(mark) == 256 and gaps[-1] in (666, 667)
    assert all(b >= a - 1 for a, b in zip(gaps, gaps[1:], strict=False))


@verifies("P006-MOT-42", "P006-STA-16", "P006-CMD-11")
def test_speed_mode_switched_on_again() -> None:
    """N 1 in STOPPING goes back to the target, once in the ramp and once behind its end."""
    host = Host()
    host.ok(L=2800, S=2800, v=3000, u=5, o=5)
    run(host)
    mark = host.mark
    cruise(host, 1_000_000 / 3000)
    assert host.ask("N", 0) == 0
    off = host.e
    assert host.ask("N", 1) == 1 and host.e - off < host.us(3_600) and host.busy
    cruise(host, 1_000_000 / 3000)
    for gap in (2_600, 2_900, 3_000, 3_600):
        assert host.ask("N", 0) == 0
        host.go(host.e + host.us(gap) - int(80 * host.bit))
        answer = host.ask("N", 1)
        assert answer == 1 and host.busy
        cruise(host, 1_000_000 / 3000)
    assert max(host.intervals(mark)) <= 358
    host.ask("I")


@verifies("P006-MOT-05", "P006-STA-19", "P006-CMD-40")
def test_position_wraps_and_long_moves() -> None:
    host = quick()
    host.ok(i=0x7FFFFFFE, d=1)
    assert len(move(host, 3)) == 2 and host.ask("c") == 0x80000001
    host.ok(d=0)
    assert len(move(host, 3)) == 2 and host.ask("c") == 0x7FFFFFFE
    start(host, 0x7FFFFFFF)
    assert set(host.intervals()) <= {333, 334}
    host.ms(10)
    assert host.busy and set(host.intervals()) == {333, 334} and host.ask("I") == 0
    assert not host.out("mon_dir")


@verifies("P006-MOT-23", "P006-MOT-20", "P006-STA-01", "P006-STA-04")
def test_the_border_of_short_moves() -> None:
    """255 steps do without VMAX, 256 do not."""
    host = Host()
    host.ok(L=3000, S=3000, v=3300, u=5, o=5)
    start(host, 255)
    mark = host.mark
    after_steps(host, 40)
    assert set(host.intervals(mark)) == {333, 334}
    host.ask("I")
    made = host.made(mark)
    start(host, 256)
    mark = host.mark
    rest(host)
    assert min(host.intervals(mark)) == 303 and host.made(mark) == 256
    assert host.position() == 256 + made and host.status() == DECAY


@verifies("P006-STA-14", "P006-STA-10", "P006-MOT-04")
def test_stop_before_the_first_step() -> None:
    """Cancelled between acceptance and t = 0, or in the first interval: no step."""
    host = brisk(Host(), 3000, f=1)
    for after in (1, 20, 300, 1000, 2000):
        host.say("s", 1000)
        host.go(host.e + EXECUTE + after)
        host.pins(ext1=0)
        assert host.hear() == host.accepted(1000)
        assert host.made() == 0 and not host.busy and still(host, 3000)
        host.pins(ext1=1)
        assert host.ask("b") == 0
    start(host, 2)
    rest(host)
    assert host.position() == 2
