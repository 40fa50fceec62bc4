"""Acceptance checks of the STMC that are about steps, switches, phases and time, on the golden model."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from openppmc.model.motion.excitation import step_list
from tests.stmc.model.host import EXT16, INTERNAL, STANDARD, Host, count, init

ALL = 0xFFFFFF
TICK = 1280


@verifies("AC-09", "STMC-RMP-01")
def test_tie_rounds_up():
    host = Host(init(0x1A, 15, 5, 8))
    host.move("c 43 " + count(11))
    assert host.gaps()[3] == 8


@verifies("AC-10", "STMC-MOT-06", "STMC-CLK-01")
def test_internal_clock_at_16_mhz():
    host = Host(init(0x0A, 5, 5, 0))
    host.move("c 43 " + count(4))
    assert host.intervals() == [6400] * 4
    assert 80 <= host.pulses()[0] - host.model.log.falls("hold")[0] <= 82


@verifies("AC-11", "AC-12", "STMC-CLK-01")
@pytest.mark.parametrize("clk_hz, first, n", [(10_000_000, (50, 52), 4), (12_345_678, (62, 64), 101)])
def test_internal_clock_at_other_clocks(clk_hz, first, n):
    host = Host(INTERNAL, clk_hz=clk_hz, ext=0)
    host.move("c 44 d 0A " + count(n - 1))
    falls = host.pulses()
    exact = [-(-i * 12800 * clk_hz // 16_000_000) for i in range(n)]
    assert [t - falls[0] for t in falls] == exact
    assert clk_hz != 12_345_678 or exact[-1] == 987_655
    assert first[0] <= falls[0] - host.model.log.falls("hold")[0] <= first[1]


@verifies("AC-13", "STMC-EXC-04", "STMC-SGL-01", "STMC-SGL-03")
def test_single_steps():
    host = Host()
    seen = []
    for code, outputs in ((0x42, None), (0x42, None), (0x42, 0x90), (0x4A, 0x32)):
        assert host.move(f"c {code:02X}") == (0x82, 0)
        seen += host.phases()
        if outputs is not None:
            assert host.run("c 83 r")[0] & ~4 == outputs
    assert seen == ["00110", "01100", "01001", "01100"]
    first = host.model.log.of("s")[1][0]
    assert 80 <= first - host.model.log.falls("hold")[0] <= 82


@verifies("AC-14", "AC-15", "AC-16", "AC-17", "STMC-EXC-01", "STMC-EXC-04", "STMC-EXC-05")
@pytest.mark.parametrize("code, phases, half", [
    (0x1E, 4, True), (0x19, 3, False), (0x1D, 3, True), (0x1B, 5, False), (0x1F, 5, True), (0x1A, 4, False),
])  # fmt: skip
def test_excitation(code, phases, half):
    table = step_list(phases, half)
    for logic in (8, 0):
        host = Host(init(code & ~8 | logic, 20, 5, 8))
        mask = 0 if logic else 0b11111
        assert host.out("s") == table[0] ^ mask
        host.move("c 44 d 01 " + count(len(table) - 1))
        assert host.phases() == [f"{p ^ mask:05b}" for p in (*table[1:], table[0])]
        host.move("c 4C d 01 " + count(1))
        assert host.phases() == [f"{p ^ mask:05b}" for p in (table[-1], table[-2])]


@verifies("AC-19")
def test_constant_speed():
    host = Host()
    assert host.move("c 44 d 07 " + count(4)) == (0x84, 0) and host.gaps() == [7] * 4


@verifies("AC-21", "STMC-REM-01")
def test_the_rest_of_a_stopped_move():
    host = Host()
    host.start("c 43 " + count(99))
    host.in_gap(3)
    mark = host.mark
    host.command(0x41)
    host.mark = mark
    assert host.finish() == (0xC3, 0x5B)
    assert host.move("c 43 " + count(0x5B)) == (0x83, 0) and len(host.pulses()) == 92


@verifies("AC-23", "STMC-DEC-01", "STMC-STP-04")
@pytest.mark.parametrize("gap, status", [(5, 0x04), (6, 0xF4)])
def test_command_1_around_the_turn(gap, status):
    host = Host()
    host.start("c 43 " + count(11))
    host.in_gap(gap)
    mark = host.mark
    assert host.command(0x41) == status
    host.mark = mark
    assert host.finish() == (0x83, 0) and len(host.pulses()) == 12


@verifies("AC-24", "AC-25", "STMC-STP-01", "STMC-STP-02")
@pytest.mark.parametrize("move, gap, code, steps, result", [
    ("c 43 " + count(0x63), 10, 0x40, 11, (0xC3, 0x58)),
    ("c 44 d 14 " + count(0xFF), 2, 0x41, 3, (0xC4, 0xFC)),
    ("c 44 d 14 " + count(0xFF), 2, 0x40, 3, (0xC4, 0xFC)),
])  # fmt: skip
def test_stop_commands(move, gap, code, steps, result):
    host = Host()
    host.start(move)
    host.in_gap(gap)
    mark = host.mark
    host.command(code)
    host.mark = mark
    assert host.finish() == result and len(host.pulses()) == steps


@verifies("AC-26", "STMC-IN-01", "STMC-DEC-05")
def test_deceleration_limit_pulse():
    host = Host()
    host.start("c 43 " + count(0x63))
    host.in_gap(10)
    host.blip(4, l3_n=0)
    assert host.finish() == (0x8B, 0x4F) and len(host.pulses()) == 20


@verifies("AC-27", "STMC-IN-03")
def test_limits_of_the_other_direction():
    host = Host()
    host.pins(l4_n=0, l2_n=0)
    assert host.move("c 43 " + count(0x63)) == (0x83, 0) and len(host.pulses()) == 100


@verifies("AC-28", "STMC-DEC-06", "STMC-FIN-02")
def test_stop_limit_during_the_ramp_down():
    host = Host()
    host.start("c 46")
    host.in_gap(30)
    host.pins(l3_n=0)
    host.in_gap(33, 20)
    host.pins(l1_n=0)
    assert host.finish() == (0x9E, ALL - 34) and len(host.pulses()) == 34


@verifies("AC-29")
def test_accelerated_to_limit_ccw():
    host = Host()
    host.start("c 4E")
    host.in_gap(12)
    host.pins(l4_n=0)
    assert host.finish() == (0x8E, ALL - 22) and len(host.pulses()) == 22


@verifies("AC-30")
def test_constant_speed_to_limit():
    host = Host()
    host.start("c 45 d 0A")
    host.in_gap(20)
    host.pins(l3_n=0)
    host.in_gap(49)
    host.pins(l1_n=0)
    assert host.finish() == (0x95, ALL - 50) and len(host.pulses()) == 50


@verifies("AC-32", "STMC-RUN-03")
def test_reference_point():
    host = Host()
    host.start("c 47 d 0A")
    host.in_gap(19)
    host.pins(cnp_n=0)
    assert host.finish() == (0x87, ALL - 20) and len(host.pulses()) == 20
    assert host.move("c 47 d 0A") == (0x87, ALL) and host.pulses() == []


@verifies("AC-33", "STMC-IN-04")
def test_deceleration_limit_stops_command_7():
    host = Host()
    host.start("c 47 d 0A")
    host.in_gap(5)
    host.pins(l3_n=0)
    assert host.finish() == (0x8F, ALL - 6) and len(host.pulses()) == 6


@verifies("AC-41", "STMC-CHP-01", "STMC-CHP-02", "STMC-HLD-01", "STMC-OUT-02")
def test_chopper_and_hold():
    host = Host(init(0x3A, 20, 5, 8), hold_xt=1600)
    done = host.model.next_event
    host.pause(20_000)
    host.sync()
    log = host.model.log
    changes = [(t, value) for t, value in log.of("s") if t > done - 5][1:]
    lengths = [b[0] - a[0] for a, b in zip(changes[1:], changes[2:], strict=False)]
    assert {value for _, value in changes} == {0, 0b00011} and log.of("hold") == []
    assert lengths[:4] == [1740, 1040, 1740, 1040]
    for _ in range(5):
        assert host.run("c 83 r") == [0xC4]
        host.pause(511)
    host.start("c 42")
    host.idle()
    end = log.falls("int_n")[-1]
    fall = log.falls("hold")[-1]
    host.pause(5000)
    host.sync()
    assert [value for t, value in log.of("s") if t >= fall][:3] in ([0b00110, 0, 0b00110], [3, 6, 0])
    off = next(t for t, value in log.of("s", end) if value == 0)
    step = next(t for t, value in log.of("s", fall) if value == 0b00110)
    assert 80 <= step - fall <= 82 and abs(off - end - 1040) <= 8
    assert 1600 <= log.rises("hold")[-1] - step <= 1624


@verifies("AC-42", "STMC-CLK-05")
def test_clock_that_stands_still():
    host = Host(ext=0)
    host.start("c 43 " + count(5))
    host.pause(100_000)
    host.command(0x40)
    assert host.finish() == (0xC3, 5) and host.pulses() == []
    host.start("c 43 " + count(5))
    assert host.command(0x41) == 0x04
    for level in (1, 0, 1, 0):
        host.pause(100)
        host.pins(ext_clk=level)
    assert host.finish() == (0xC3, 4) and len(host.model.log.of("s")) == 2


@verifies("AC-50", "STMC-DEC-03", "STMC-IN-04")
def test_starts_at_the_deceleration_limit():
    host = Host()
    host.pins(l3_n=0)
    for script, result, steps in (
        ("c 43 " + count(0x63), (0x8B, 0x62), 1),
        ("c 46", (0x8E, ALL - 1), 1),
        ("c 43 " + count(0), (0x83, 0), 1),
        ("c 47 d 0A", (0x8F, ALL), 0),
    ):
        assert host.move(script) == result and len(host.pulses()) == steps
    host.pins(l1_n=0)
    assert host.move("c 43 " + count(0x63)) == (0x93, 0x63)


@verifies("STMC-BAD-14")
def test_all_switches_active():
    host = Host()
    host.pins(l1_n=0, l2_n=0, l3_n=0, l4_n=0, cnp_n=0)
    for code, number in ((0x42, 2), (0x43, 3), (0x44, 4), (0x45, 5), (0x46, 6), (0x47, 7)):
        for ccw in (0, 8):
            data = {3: count(9), 4: "d 05 " + count(9), 5: "d 05", 7: "d 05"}.get(number, "")
            status, _ = host.move(f"c {code | ccw:02X} {data}")
            assert status == (0x9F if number == 7 else 0x90 | number) and host.pulses() == []


@verifies("STMC-DEC-03")
@pytest.mark.parametrize("stop", ["c 41", "l3_n"])
def test_request_in_the_first_levels_of_a_flat_start(stop):
    """x(v) = D1 also for levels above 0: the request stops at once there, too."""
    host = Host(init(0x1A, 10, 9, 16))
    host.start("c 43 " + count(99))
    host.in_gap(3)
    mark = host.mark
    if stop == "l3_n":
        host.pins(l3_n=0)
    else:
        host.command(0x41)
    host.mark = mark
    assert host.finish() == (0xC3 if stop == "c 41" else 0x8B, 99 - 4)
    assert host.gaps() == [10] * 3


@verifies("STMC-HLD-01", "STMC-HLD-02")
def test_hold_default():
    host = Host(STANDARD)
    host.move("c 42")
    fall = host.model.log.falls("int_n")[0]
    host.pause(560_000)
    host.sync()
    assert 544_000 <= host.model.log.rises("hold")[0] - fall <= 544_016
    assert EXT16 == 16
