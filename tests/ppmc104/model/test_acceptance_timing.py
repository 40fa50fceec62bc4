"""Acceptance checks of chopping, hold, external clock, odd CLK_HZ and DATASHEET times, on the model."""

from __future__ import annotations

import pytest

from tests.ppmc104.model.host import INIT_A, INIT_B, ModelHost

CHOPPED = "c 2A d 09 d 04 d 04 d 00"
EXTERNAL = "c 1A d 09 d 04 d 04 d 00"


def phases(host: ModelHost, count: int) -> list[tuple[int, int]]:
    """The next `count` complete phases of the chopper: (level, length)."""
    host.sync()
    since = host.model.now
    while len(host.model.log.of("s", since)) < count + 2:
        host.step()
    edges = host.model.log.of("s", since)[1:]
    return [(level, b - a) for (a, level), (b, _) in zip(edges, edges[1:], strict=False)][:count]


def clock_run(host: ModelHost, period: int, edges: int, phase: int = 0) -> None:
    """So many periods of the external clock, high for half of each."""
    start = host.t + phase
    for i in range(edges):
        host.model.pins(start + i * period, clock=1)
        host.model.pins(start + i * period + period // 2, clock=0)
    host.t = start + edges * period


def test_ac_45_switching_times():
    host = ModelHost()
    host.run(CHOPPED)
    host.pause(300)
    assert sorted(phases(host, 4)) == [(0, 1740)] * 2 + [(3, 1040)] * 2
    assert host.run("c 82 r") == [0xC4]
    host.run("c 84 d 10 d 20")
    host.pause(3000)
    assert sorted(phases(host, 4)) == [(0, 2064)] * 2 + [(3, 1200)] * 2
    host.pins(vsel=0)
    host.pause(3000)
    assert sorted(phases(host, 4)) == [(0, 1996)] * 2 + [(3, 1168)] * 2
    host.run("c 42")
    host.idle()
    (fall,) = host.pulses()
    before = [t for t, _ in host.model.log.of("s") if t < fall][-1]
    assert fall - before >= 80 and host.run("c 82 r") == [0x60]


def test_ac_46_chopper_starts_with_on():
    host = ModelHost()
    host.run(CHOPPED + " c 42")
    host.idle()
    (end,) = host.model.log.falls("int_n")
    host.pause(1100)
    host.sync()
    assert abs(host.model.log.of("s", end)[0][0] - end - 1040) <= 6


def test_ac_47_reinitialisation_without_chopping():
    host = ModelHost()
    host.run(CHOPPED)
    host.pause(5000)
    host.run(INIT_A)
    host.pause(40_100)
    host.sync()
    assert host.model.log.of("s")[-1][1] == 0b00011
    assert host.model.next_event is None


def test_ac_48_hold_time():
    host = ModelHost()
    host.run(INIT_A + " c 42")
    host.pause(320_000)
    host.run("c 42")
    host.idle()
    end = host.model.now
    host.pause(560_000)
    host.sync()
    assert len(host.model.log.falls("hold")) == 1
    (rise,) = host.model.log.rises("hold")
    assert 544_000 <= rise - end <= 545_600


@pytest.mark.parametrize(
    "period, vsel, clk",
    [(64, 1, 640), (64, 0, 760), (160, 0, 1600), (160, 1, 1600), (128, 0, 1400)],
)
def test_ac_49_external_clock(period, vsel, clk):
    host = ModelHost()
    host.run(EXTERNAL)
    host.pins(vsel=vsel)
    host.pause(6)
    host.run("c 44 d 09 d 09 d 00 d 00")
    clock_run(host, period, 12 * clk // period + 4)
    assert host.finish() == (0x84, 0)
    assert host.intervals() == [clk] * 9 and host.lows() == [80] * 10


def test_tim_05_external_pulse_width():
    """Cases b and c: cut at a base edge, cut at the falling clock edge."""
    for rate, period, low in (
        (1, 64, 64),
        (3, 16, 32),
        (0, 40, 20),
        (0, 126, 63),
        (0, 128, 80),
        (1, 100, 80),
    ):
        host = ModelHost()
        host.run(EXTERNAL + f" c 44 d {rate:02X} d 03 d 00 d 00")
        clock_run(host, period, 30)
        assert host.finish() == (0x84, 0), (rate, period)
        assert host.lows() == [low, low, low, 80], (rate, period)


def test_ac_50_59_stopped_external_clock():
    host = ModelHost()
    host.run(EXTERNAL + " c 44 d 09 d 09 d 00 d 00")
    host.pause(16_000)
    host.sync()
    assert host.model.busy and host.pulses() == []
    host.command(0x40)
    assert host.finish() == (0xC4, 9)
    host.pause(560_000)
    host.run("c 42")
    host.idle()
    (fall,) = host.pulses()
    assert 80 <= fall - host.model.log.falls("hold")[-1] <= 82 and host.lows() == [80]
    assert host.out("s") == 0b00110 and host.finish() == (0x82, 0)


def test_ac_51_odd_core_clock():
    host = ModelHost(clk_hz=11_059_200)
    host.run(INIT_A + " c 44 d 00 d E8 d 03 d 00")
    host.idle()
    first, *rest = host.pulses()
    assert len(rest) == 1000
    assert [fall - first for fall in rest] == [-(-221184 * n // 10000) for n in range(1, 1001)]


def datasheet(init: str) -> ModelHost:
    host = ModelHost(timing="DATASHEET")
    host.run(init)
    host.pause(270_000)
    return host


def test_ac_53_datasheet_constant_speed():
    host = datasheet(INIT_A)
    host.run("c 44 d 63 d 02 d 00 d 00")
    event = host.written
    while not host.model.busy:
        host.step()
    assert 432 <= host.model.now - event <= 448
    host.fall(3)
    falls = host.pulses()
    assert 3104 <= falls[0] - event <= 3120
    host.go(falls[-1] + 20)
    host.write(1, 0x80)
    host.go(falls[-1] + 2600)
    host.sync()
    log = host.model.log
    assert 416 <= log.falls("int_n")[0] - falls[-1] <= 432
    assert 2496 <= log.rises("int_n")[0] - falls[-1] <= 2512


def test_ac_54_datasheet_single_step():
    host = datasheet(INIT_A)
    host.run("c 42")
    event = host.written
    host.fall(1)
    host.idle()
    assert 1376 <= host.pulses()[0] - event <= 1392
    assert 1792 <= host.model.log.falls("int_n")[0] - event <= 1808


@pytest.mark.parametrize("n, clk", [(1000, 3200), (10, 3276), (20, 3353), (21, 3200)])
def test_ac_55_datasheet_ramp_start(n, clk):
    host = datasheet(INIT_B)
    host.run(f"c 43 d {n - 1 & 255:02X} d {n - 1 >> 8:02X} d 00")
    event = host.written
    assert clk <= host.fall(1) - event <= clk + 16


def test_ac_56_datasheet_fast_intervals():
    host = datasheet(INIT_A)
    host.run("c 44 d 09 d 63 d 00 d 00")
    host.fall(20, 20)
    host.write(1, 0xC1)
    last = host.fall(100)
    while host.t < last + 2440:
        host.pause(40)
        assert host.read(1) & 2 == 2 and host.out("aux_n") == 1
    host.pause(400)
    host.sync()
    assert 2496 + 224 <= host.model.log.falls("aux_n")[0] - last <= 2496 + 224 + 16
    assert host.finish() == (0x84, 0)

    host = datasheet(INIT_A)
    host.run("c 44 d 09 d 63 d 00 d 00")
    host.fall(20, 100)
    host.command(0x40)
    assert host.finish() == (0xC4, 0x4F) and len(host.pulses()) == 20


def test_ds_01_pattern_and_ds_11_delays():
    host = ModelHost(timing="DATASHEET")
    for byte in (9, 4, 4, 0):
        if byte == 9:
            host.command(0x0A)
        event = host.write(0, byte)
    host.pause(270_000)
    host.sync()
    (shown, level), *_ = host.model.log.of("s")
    assert level == 0b00011 and 704 <= shown - event <= 720
    for code, signal, clk in ((0xC1, "aux_n", 224), (0xC2, "aux_n", 224), (0xC0, "s", 288)):
        event = host.write(1, code)
        host.pause(400)
        host.sync()
        ((edge, _),) = host.model.log.of(signal, event)
        assert clk <= edge - event <= clk + 16


def test_ds_08_immediate_and_forced_ends():
    for script, end in (("c 44 d 63 d 63 d 00 d 00", 416), ("c 43 d E7 d 03 d 00", 3200)):
        host = datasheet(INIT_B)
        host.run(script)
        host.fall(3, 100)
        t = host.t
        host.pins(l1_n=0)
        host.idle()
        assert 0 <= host.model.now - (t + 2) - end <= 16
    host = datasheet(INIT_B)
    host.run("c 43 d E7 d 03 d 00")
    host.fall(4, 100)
    host.pins(l3_n=0)
    host.pins(l3_n=0)
    host.pins(l3_n=1)
    host.idle()
    assert len(host.pulses()) == 8
    assert 3200 <= host.model.now - host.pulses()[-1] <= 3216
    assert host.finish() == (0x8B, 991)


def test_ds_10_flag_comes_late():
    """A flag that finds the move slowing down by itself leaves no cause bit."""
    host = datasheet(INIT_B)
    host.run("c 43 d E7 d 03 d 00")
    host.fall(3, 400)
    host.pins(l3_n=0)
    assert host.finish() == (0x8B, 991) and len(host.pulses()) == 8
    host = datasheet(INIT_A)
    host.run("c 43 d 05 d 00 d 00")
    host.fall(3, 100)
    host.pins(l3_n=0)
    assert host.finish() == (0x83, 0) and len(host.pulses()) == 6
