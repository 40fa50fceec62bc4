"""Acceptance checks of moves, stops, limits and registers after a move, on the golden model at pin level."""

from __future__ import annotations

import pytest

from tests.ppmc104.model.host import INIT_A, INIT_B, ModelHost

LONG = " c 43 d E7 d 03 d 00"
EX_01 = [320, 256, 192, 192, *[160] * 5, 192, 192, 256, 320]
EX_02 = {
    10: [9, 7, 5, 5, 4, 5, 5, 7, 9],
    9: [9, 7, 5, 5, 5, 5, 7, 9],
    8: [9, 7, 5, 5, 5, 7, 9],
    7: [9, 7, 5, 5, 7, 9],
    6: [9, 7, 5, 7, 9],
    5: [9, 7, 7, 9],
    4: [9, 7, 9],
    3: [9, 9],
    2: [9],
    1: [],
}
EX_04A = [640, 576, 512, 480, 512, 576, 640]


def started(script: str, **parameters: object) -> ModelHost:
    host = ModelHost(**parameters)
    host.run(script)
    return host


def with_pins(script: str, move: str, **levels: int) -> ModelHost:
    host = started(script)
    host.pins(**levels)
    host.pause(8)
    host.run(move)
    return host


def test_ac_09_13_14_ramp_start_and_pulse_shape():
    host = started(INIT_A + " c 43 d 0D d 00 d 00")
    host.idle()
    log, falls = host.model.log, host.pulses()
    assert host.intervals() == EX_01 and falls[-1] - falls[0] == 2720
    assert host.out("s") == 0b01100
    (hold,) = log.falls("hold")
    assert 80 <= falls[0] - hold <= 82
    assert [t for t, _ in log.of("s", hold)] == falls
    host.sync()
    assert host.lows() == [80] * 14
    host.run("c 44 d 00 d 09 d 00 d 00")
    host.idle()
    assert host.intervals() == [32] * 9 and host.lows() == [*[16] * 9, 80]


@pytest.mark.parametrize("n", range(1, 11))
def test_ac_10_short_moves(n):
    host = started(INIT_A + f" c 43 d {n - 1:02X} d 00 d 00")
    assert host.finish() == (0x83, 0)
    assert host.intervals() == [32 * (rate + 1) for rate in EX_02[n]]


def test_ac_11_long_ramp():
    host = started("c 0A d C7 d 31 d 64 d 00" + LONG)
    host.idle()
    intervals = host.intervals()
    assert len(intervals) == 999 and sum(intervals) == 1_795_008
    assert intervals[:8] == [6400, 5984, 5600, 5312, 5056, 4832, 4640, 4480]
    assert intervals[-8:] == intervals[7::-1] and intervals.count(1600) == 799 + 2 * 2


def test_ac_12_rounding_corner():
    host = started("c 0A d 04 d 00 d 08 d 00 c 43 d 13 d 00 d 00")
    host.idle()
    ramp = [160, 96, 64, 64]
    assert host.intervals() == [*ramp, *[32] * 11, *ramp[::-1]]


@pytest.mark.parametrize("csel, vsel, clk", [(1, 1, 3200), (0, 1, 12800), (1, 0, 3320), (0, 0, 12920)])
def test_ac_15_base_clock_pins(csel, vsel, clk):
    host = with_pins(INIT_A, "c 44 d 63 d 04 d 00 d 00", csel=csel, vsel=vsel)
    host.idle()
    assert host.intervals() == [clk] * 4


def test_ac_16_base_clock_pins_are_latched():
    host = started(INIT_A + " c 44 d 63 d 04 d 00 d 00")
    host.fall(2, 50)
    host.pins(csel=0, vsel=0)
    host.idle()
    assert host.intervals() == [3200] * 4


def test_ac_17_normal_end():
    host = started(INIT_A + " c 43 d 01 d 00 d 00")
    host.idle()
    log = host.model.log
    assert 0 <= log.falls("int_n")[0] - log.rises("pout_n")[-1] <= 4
    assert host.run("c 80 r") == [0x83] and host.out("int_n") == 1
    assert host.run("c 80 r") == [0x03]


def test_ac_18_19_interrupt_mask():
    host = started(INIT_A + " c 53 d 01 d 00 d 00")
    assert host.finish() == (0x83, 0) and host.model.log.of("int_n") == []
    host.run("c 42")
    host.idle()
    assert host.out("int_n") == 0
    host.run("c 52")
    host.idle()
    assert host.out("int_n") == 0
    assert host.run("c 80 r") == [0x82] and host.out("int_n") == 1


def test_ac_20_immediate_stop_and_rest():
    host = started(INIT_A + " c 44 d 63 d E7 d 03 d 00")
    host.fall(10, 400)
    mark = host.mark
    host.run("c 40")
    host.mark = mark
    assert host.finish() == (0xC4, 989)
    assert len(host.pulses()) == 10
    host.run("c 44 d 63 d DD d 03 d 00")
    assert host.finish() == (0x84, 0) and len(host.pulses()) == 990


def test_ac_21_one_pulse_left():
    host = started(INIT_A + " c 44 d 63 d 01 d 00 d 00")
    host.fall(1, 400)
    host.command(0x40)
    assert host.finish() == (0xC4, 0) and len(host.pulses()) == 1


@pytest.mark.parametrize(
    "fall, after, intervals, remaining",
    [
        (4, 100, EX_04A, 991),
        (1, 100, [640], 997),
    ],
)
def test_ac_22_decelerating_stop(fall, after, intervals, remaining):
    host = started(INIT_B + LONG)
    host.fall(fall, after)
    host.command(0x41)
    assert host.finish() == (0xC3, remaining) and host.intervals() == intervals


def test_ac_23_error_7_on_the_plateau():
    host = started(INIT_B + LONG)
    host.fall(29, 50)
    assert host.command(0x41) == 0x04
    host.fall(33, 50)
    assert host.command(0x41) == 0xF4
    assert host.finish() == (0xC3, 959)
    assert host.intervals()[29:] == [32 * (r + 1) for r in (9, 10, 10, 11, 12, 12, 14, 15, 17, 19)]


def test_ac_24_error_7_in_natural_deceleration():
    host = started(INIT_A + " c 43 d 0D d 00 d 00")
    host.fall(11, 50)
    assert host.command(0x41) == 0xF4
    assert host.finish() == (0x83, 0) and host.intervals() == EX_01


def test_ac_25_decelerating_stop_of_constant_speed():
    host = started(INIT_A + " c 45 d 63")
    host.fall(5, 400)
    assert host.command(0x41) & 0x80 == 0
    assert host.finish() == (0xC5, 0xFFFFFA) and len(host.pulses()) == 5


def test_ac_26_start_on_a_slow_down_limit():
    host = with_pins(INIT_B, LONG.strip(), l3_n=0)
    assert host.finish() == (0x8B, 998) and len(host.pulses()) == 1


def test_ac_27_short_slow_down_limit():
    host = started(INIT_B + LONG)
    host.fall(4, 100)
    host.pins(l3_n=0)
    host.pause(9)
    host.pins(l3_n=1)
    assert host.finish() == (0x8B, 991) and host.intervals() == EX_04A


def test_ac_28_pulse_only_mode_sees_the_limit_on_the_plateau():
    host = with_pins(INIT_B, "c C3 d E7 d 03 d 00", l3_n=0)
    host.idle()
    assert host.model.log.of("s", host.mark) == []
    assert [i.index for i in host.model.intervals] == [*range(10), 10, *range(9, -1, -1)]
    assert host.finish() == (0x8B, 977) and len(host.pulses()) == 22


def test_ac_29_pulse_only_mode_ignores_the_limit_before():
    host = started(INIT_B + " c C3 d E7 d 03 d 00")
    host.fall(3, 50)
    host.pins(l3_n=0)
    host.fall(8, 1)
    host.pins(l3_n=1)
    assert host.finish() == (0x83, 0) and len(host.pulses()) == 1000


def test_ac_30_other_direction():
    host = with_pins(INIT_B, "c 4B d 1D d 00 d 00", l1_n=0, l3_n=0)
    assert host.finish() == (0x83, 0) and len(host.pulses()) == 30 and host.out("dir") == 1
    host = with_pins(INIT_B, "c 4B d 1D d 00 d 00", l4_n=0)
    assert host.finish() == (0x8B, 28) and len(host.pulses()) == 1


def test_ac_31_hard_limit():
    host = started(INIT_A + " c 45 d 63")
    host.fall(5, 400)
    pin = host.t
    host.pins(l1_n=0)
    host.idle()
    assert 0 < host.model.now - pin <= 8
    assert host.finish() == (0x95, 0xFFFFFA) and len(host.pulses()) == 5
    host.run("c 45 d 63")
    assert host.finish() == (0x95, 0xFFFFFF) and host.pulses() == []
    host.run("c 4D d 63")
    host.fall(3)
    assert host.model.busy


def test_ac_32_alarm():
    host = started(INIT_A + " c 46")
    host.fall(6, 100)
    host.pins(alm_n=0)
    assert host.finish() == (0xA6, 0xFFFFF9) and len(host.pulses()) == 6


def test_ac_33_start_on_limit_and_alarm():
    host = with_pins(INIT_A, "c 43 d 09 d 00 d 00", l1_n=0, alm_n=0)
    assert host.finish() == (0xB3, 9) and host.pulses() == []
    host.run("c 42")
    assert host.finish() == (0xB2, 0) and host.pulses() == []
    assert host.out("s") == 0b00011 and len(host.model.log.falls("int_n")) == 2


def test_ac_34_origin_search():
    host = started(INIT_A + " c 47 d 63")
    host.fall(7, 400)
    host.pins(cnp_n=0)
    assert host.finish() == (0x87, 0xFFFFF8) and len(host.pulses()) == 7
    host.run("c 47 d 63")
    assert host.finish() == (0x87, 0xFFFFFF) and host.pulses() == []
    host.run("c 44 d 63 d 04 d 00 d 00")
    assert host.finish() == (0x84, 0) and len(host.pulses()) == 5


def test_ac_35_limit_after_the_last_pulse():
    host = started(INIT_A + " c 43 d 02 d 00 d 00")
    host.fall(3, 4)
    host.pins(l1_n=0)
    assert host.finish() == (0x83, 0)


def test_ac_60_immediate_end_keeps_a_short_pulse():
    host = started(INIT_A + " c 44 d 00 d 63 d 00 d 00")
    host.fall(10, 2)
    host.pins(l1_n=0)
    assert host.finish() == (0x94, 89)
    assert len(host.pulses()) == 10 and host.lows()[-1] == 16


def test_ex_05_indices_and_ex_09_order():
    host = started("c 0F d 09 d 04 d 04 d 00 c 4C d 63 d 03 d 00 d 00")
    host.idle()
    shown = [value for _, value in host.model.log.of("s", host.mark)]
    assert shown == [0b10011, 0b10001, 0b11001, 0b11000]


@pytest.mark.parametrize("vsel, total", [(1, 2720), (0, 4280)])
def test_ex_07_vsel(vsel, total):
    host = with_pins(INIT_A, "c 43 d 0D d 00 d 00", vsel=vsel)
    host.idle()
    assert sum(host.intervals()) == total


def test_ex_11_flat_ramp():
    host = started("c 0A d 0A d 0A d 04 d 00 c 43 d 0B d 00 d 00")
    host.idle()
    assert host.intervals() == [352] * 11
