"""PMC006 acceptance checks of moves and speed mode. Those that last long stay on the model."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.scripts import model_only
from cocotb_tests.harness.verifies import verifies
from cocotb_tests.pmc006.frames import reply, signed
from cocotb_tests.pmc006.reference import sines
from cocotb_tests.pmc006.scenes import (
    DECAY,
    EXT1,
    FORWARD,
    SPEED_MODE,
    after_steps,
    brisk,
    cruise,
    move,
    ready,
    rest,
    run,
    start,
    still,
)
from cocotb_tests.pmc006.script_host import EXECUTE, START, Host

LONG = "seconds of motion; script_motion has the same rules in short"


def hexed(frame: bytes) -> str:
    """Text of a frame, as `Host.swap` has it."""
    return frame.hex(" ").upper()


@verifies("P006-AC-03", "P006-FRM-09", "P006-CMD-40", "P006-CMD-55", "P006-MOT-20")
def test_ac_03() -> None:
    host = ready()
    assert host.ask("w", 1) == 1
    assert host.swap("A5 01 73 1F 01 00 00 39") == hexed(reply(1, host.accepted(287)))
    rest(host)
    steps = host.steps()
    gaps = host.intervals()
    assert len(steps) == 287 and gaps[:3] == [1613, 1534, 1439] and gaps[-3:] == [1666, 1667, 1667]
    assert host.in_us(steps[-1] - steps[0]) == 132_476 - 1659
    assert host.swap("A5 01 63 00 00 00 00 09") == "A5 7A 01 1F 01 00 00 40"


@verifies("P006-AC-13", "P006-MOT-03", "P006-MOT-04", "P006-MOT-05", "P006-STA-18")
def test_ac_13() -> None:
    host = ready()
    assert host.swap("A5 FF 73 01 00 00 00 18") == hexed(reply(0xFF, host.accepted(1)))
    e = host.e
    assert e <= host.edges("mon_busy")[0][0] <= e + EXECUTE
    assert host.baud < 100_000 or host.status() == DECAY | 1
    rest(host)
    (step,) = host.steps(e)
    assert 0 <= step - e - host.us(1667) <= EXECUTE + START + host.us(1)
    assert 0 <= host.edges("mon_busy")[-1][0] - step <= 2
    assert host.position() == 1 and host.status() == DECAY


@model_only(LONG)
@verifies("P006-AC-14", "P006-MOT-23")
def test_ac_14() -> None:
    host = ready()
    assert set(move(host, 255)) == {1666, 1667}
    assert host.swap("A5 FF 73 00 01 00 00 18") == hexed(reply(0xFF, host.accepted(256)))
    rest(host)
    gaps = host.intervals()
    assert len(gaps) == 255 and gaps[:3] == [1613, 1534, 1439] and gaps[-3:] == [1667, 1667, 1666]
    assert host.position() == 511


@verifies("P006-AC-15", "P006-BAD-10", "P006-STA-01")
def test_ac_15() -> None:
    host = ready()
    assert host.ask("s", 0) == 0 and host.ask("s", -1) == 0
    assert still(host) and not host.steps(0) and host.status() == DECAY


@verifies("P006-AC-16", "P006-STA-02", "P006-MOT-40")
def test_ac_16() -> None:
    host = ready()
    assert host.swap("A5 FF 76 64 00 00 00 7E") == "A5 7A FF 64 00 00 00 82"
    assert host.ask("s", 10) == 0 and still(host)
    run(host)
    after_steps(host, host.pick(6, 3))
    assert set(host.intervals()) == {10_000}


@model_only(LONG)
@verifies("P006-AC-17", "P006-MOT-17")
def test_ac_17() -> None:
    host = ready()
    assert host.swap("A5 FF 76 80 3E 00 00 D8") == "A5 7A FF 80 3E 00 00 DC"
    gaps = move(host, 4000)
    assert sum(gaps) == 523_965 - 1666 and gaps[-1] == 1666 and min(gaps) in (67, 68)


@model_only(LONG)
@verifies("P006-AC-18", "P006-CMD-30", "P006-CMD-54", "P006-STA-15", "P006-EXC-01")
def test_ac_18() -> None:
    host = ready()
    start(host, 10_000)
    mark = host.mark
    after_steps(host, 500)
    assert host.ask("s", 5) == 0
    host.ok(m=4, d=0)
    before = host.t
    host.ok(i=0x100)
    loaded = (before, host.e + EXECUTE)
    rest(host)
    steps = host.steps(mark)
    assert len(steps) == 10_000 and host.out("mon_dir") == 1
    least, most = (sum(t > at for t in steps) for at in reversed(loaded))
    assert least <= host.position() - 0x100 <= most
    assert host.ask("O") & FORWARD == 0
    host.ok(a=0)
    angle = 64 + 8 * 10_000
    assert host.refs() == sines(angle, 64)
    assert move(host, 1) == []
    host.pause(64)
    assert host.refs() == sines(angle - 32, 64)


@model_only(LONG)
@verifies("P006-AC-19", "P006-STA-13", "P006-MOT-41", "P006-CMD-11", "P006-CMD-12")
def test_ac_19() -> None:
    host = ready()
    run(host)
    mark = host.mark
    host.ms(300)
    assert host.ask("O") & SPEED_MODE
    assert set(host.intervals(mark)[-100:]) == {312, 313}
    assert host.ask("N", 0) == 0
    off = host.e
    assert host.ask("O") & SPEED_MODE == 0 and host.status() & 1
    fall = rest(host)
    assert host.us(191_200) <= fall - off <= host.us(191_400) + EXECUTE
    late = [b for a, b in zip(host.steps(mark), host.intervals(mark), strict=False) if a > off]
    assert all(b >= a - 1 for a, b in zip(late, late[1:], strict=False)) and 1600 <= late[-1] <= 1667
    assert host.position() == len(host.steps(mark))


@verifies("P006-AC-20", "P006-STA-10", "P006-STA-16")
def test_ac_20() -> None:
    host = ready()
    run(host)
    host.ms(20)
    assert host.swap("A5 FF 49 00 00 00 00 ED") == "A5 7A FF 00 00 00 00 1E"
    assert not host.steps(host.e + EXECUTE + 6) and not host.busy
    start(host, 1)
    rest(host)
    assert len(host.steps()) == 1


@verifies("P006-AC-21", "P006-STA-12", "P006-CMD-28", "P006-CHP-01")
def test_ac_21() -> None:
    host = ready()
    host.ok(a=0)
    start(host, 10_000)
    after_steps(host, 37)
    host.ok(g=1)
    names = ("bridge_a_en", "bridge_b_en", "m10", "m11", "m20", "m21", "mon_busy")
    assert [host.out(name) for name in names] == [0] * 7 and host.refs() == (0, 0, 0, 0)
    count = len(host.steps(0))
    assert host.ask("s", 1) == 0
    host.ok(g=0)
    assert host.out("bridge_a_en") and host.out("bridge_b_en")
    held = host.refs()
    assert host.ask("s", 1) == host.accepted(1)
    rest(host)
    assert len(host.steps()) == 1 and len(host.steps(0)) == count + 1
    assert held == sines(64 + 8 * count, 64)


@verifies("P006-AC-25", "P006-EXC-15", "P006-EXC-02", "P006-CMD-34", "P006-CMD-25")
def test_ac_25() -> None:
    host = ready()
    host.ok(m=0)
    seen = []
    for _ in range(4):
        move(host, 1)
        host.pause(64)
        seen.append(host.refs())
    host.ok(d=0)
    move(host, 1)
    host.pause(64)
    seen.append(host.refs())
    assert seen == [(45, 1, 45, 0), (45, 1, 45, 1), (45, 0, 45, 1), (45, 0, 45, 0), (45, 0, 45, 1)]
    assert host.position() == 3


@verifies("P006-AC-27", "P006-CMD-26", "P006-CMD-35", "P006-EXC-20", "P006-CMD-22")
def test_ac_27() -> None:
    host = ready()
    host.ok(a=0)
    assert host.ask("e", 1074) == 1074 and host.refs() == (45, 0, 45, 0)
    assert host.swap("A5 FF 65 33 04 00 00 40") == "A5 7A FF 33 04 00 00 55"
    assert host.refs() == (52, 0, 52, 0) and host.ask("n") == 1075
    assert host.ask("e", 399) == 1075 and host.ask("e", 4001) == 1075
    assert host.ask("e", 400) == 400 and host.refs() == (18, 0, 18, 0)
    assert host.ask("e", 4000) == 4000 and host.refs() == (180, 0, 180, 0)
    host.ms(101)
    host.ok(a=1)
    assert host.refs() == (90, 0, 90, 0)


@verifies("P006-AC-28", "P006-EXC-32", "P006-CMD-14")
def test_ac_28() -> None:
    host = ready()
    host.ok(Q=4)
    host.ms(101)
    assert host.refs() == (3, 0, 3, 0)
    host.ok(a=0)
    assert host.refs() == (45, 0, 45, 0)


@model_only("other clocks; script_clock has a third one")
@pytest.mark.parametrize("clk_hz", [25_000_000, 12_000_000])
@verifies("P006-AC-45", "P006-PAR-01")
def test_ac_45(clk_hz: int) -> None:
    host = ready(clk_hz=clk_hz)
    gaps = move(host, 300)
    assert gaps[:11] == [1613, 1534, 1439, 1341, 1247, 1162, 1086, 1019, 959, 907, 860]
    assert gaps[-12:] == [998, 1062, 1133, 1215, 1304, 1400, 1496, 1583, 1644, 1666, 1667, 1667]
    assert sum(gaps) == 136_376 - 1659


@model_only("a long ramp; script_angle has compensation at constant speeds")
@verifies("P006-AC-46", "P006-EXC-24", "P006-EXC-21", "P006-EXC-22", "P006-EXC-23")
def test_ac_46() -> None:
    host = ready()
    host.ok(m=0, v=3000)
    run(host)
    cruise(host, 1_000_000 / 3000)
    host.ms(10)
    mark = host.mark
    while len(host.steps(mark)) % 4:
        host.step()
    host.pause(64)
    assert host.refs() == (7, 0, 77, 0)


@model_only(LONG)
@verifies("P006-AC-50", "P006-MOT-20")
def test_ac_50() -> None:
    host = Host()
    assert host.swap("A5 FF 73 1F 01 00 00 37") == hexed(reply(0xFF, host.accepted(287)))
    rest(host)
    gaps = host.intervals()
    assert gaps[:7] == [1665, 1663, 1659, 1654, 1648, 1641, 1633] and sum(gaps) == 336_484 - 1667
    assert gaps[-7:] == [1659, 1663, 1664, 1667, 1667, 1666, 1667] and host.position() == 287


@verifies("P006-AC-59", "P006-STA-16", "P006-BAD-25")
def test_ac_59() -> None:
    host = ready()
    run(host)
    mark = host.mark
    host.ms(10)
    assert host.steps(mark) and host.ask("O") & SPEED_MODE
    assert host.ask("s", 100) == 0
    host.ms(5)
    count = len(host.steps(mark))
    assert count > 5 and host.busy
    assert host.ask("I") == 0
    assert not host.steps(host.e + EXECUTE + 6) and not host.ask("O") & SPEED_MODE
    assert host.ask("N", 0) == 0
    start(host, 1)
    rest(host)
    assert len(host.steps()) == 1


@verifies("P006-AC-60", "P006-MOT-41")
def test_ac_60() -> None:
    host = ready()
    brisk(host, 2500, d=0)
    run(host)
    mark = host.mark
    host.ms(host.pick(510, 40))
    assert host.ask("N", 0) == 0
    off = host.e
    fall = rest(host)
    assert 0 <= fall - off <= host.us(200) + EXECUTE
    assert set(host.intervals(mark)) == {400} and host.position() == -len(host.steps(mark))


@model_only(LONG)
@verifies("P006-AC-63", "P006-STL-01", "P006-PORT-04")
def test_ac_63() -> None:
    host = ready()
    host.ok(Y=3, Z=0xFF)
    gaps = move(host, 1000)
    assert gaps[:3] == [1663, 1657, 1647] and sum(gaps) == 471_687 - 1667
    assert host.status() & 0x10 == 0 and host.ask("X") == 0


@verifies("P006-AC-67", "P006-MOT-42")
def test_ac_67() -> None:
    for late in (False, True):
        host = ready()
        if not host.literal:
            host.ok(L=2800, S=2800, u=5, o=5)
        run(host)
        mark = host.mark
        host.ms(host.pick(400, 40))
        assert host.ask("N", 0) == 0
        low = 600 if host.literal else 2800
        slope = 13_600 if host.literal else 54_400
        length = (3200 - low) * 1_000_000 // slope
        off = host.e
        if late:
            # The frame ends some 60 us before the STOP ramp does.
            frame = int(80 * host.bit)
            host.go(off + host.us(length + 40) - frame)
        else:
            host.go(off + host.us(host.pick(50_000, 2_000)))
        assert host.ask("N", 1) == 1 and host.ask("O") & SPEED_MODE and host.busy
        cruise(host, 312.5)
        gaps = host.intervals(mark)
        assert max(gaps) <= 1_000_000 / low + 2
        if late:
            assert max(gaps[len(gaps) // 4 :]) >= 1_000_000 / low - 12
        host.ask("I")


@model_only(LONG)
@verifies("P006-AC-18", "P006-BAD-10")
def test_signed_position_after_a_long_run() -> None:
    host = brisk(ready(), 2500, d=0, f=1)
    start(host, 300)
    rest(host)
    assert signed(host.ask("c")) == -300 and not host.status() & EXT1
