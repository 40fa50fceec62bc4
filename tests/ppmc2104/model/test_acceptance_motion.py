"""Acceptance checks of moves, inputs, RUN, HOLD and switching on the golden model of the PPMC-2104."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from openppmc.model.motion.excitation import step_list
from tests.ppmc2104.model.host import B1, B2, LONG, Host


def ready(script: str = B1) -> Host:
    return Host(script + " ready ")


@verifies("P2104-TIM-01", "P2104-TIM-04", "P2104-TIM-05", "P2104-PHS-04")
def test_ac_09_13_first_pulse_and_shape():
    host = ready()
    host.run("c 43 d 18 d 00 d 00 idle")
    host.pause(5)
    host.sync()
    falls = host.pulses()
    (hold,) = [t for t, level in host.model.bits("hold", 1) if level == 0]
    assert 80 <= falls[0] - hold <= 82
    assert [t for t, _ in host.model.log.of("s1_n", hold)] == falls
    assert host.lows() == [80] * 25 and host.out("s1_n") == 0b11001
    assert host.model.log.of("s2_n") == [] and host.model.pulses(2) == []


@verifies("P2104-END-06")
def test_ac_41_remaining_completes_the_move():
    host = ready()
    host.run(LONG)
    host.fall(7, after=100)
    host.write(1, 0x40)
    assert host.end() == (0xC3, 992)
    host.run("c 43 d E0 d 03 d 00")
    assert host.end() == (0x83, 0) and len(host.pulses()) == 993


@verifies("P2104-TIM-02", "P2104-OPR-10", "P2104-BCK-05")
def test_ac_50_common_start():
    host = ready(B1 + " " + B2)
    host.pins(run=0)
    host.pause(4)
    host.run("c 43 d 18 d 00 d 00 c 6C d 31 d 04 d 00 d 00")
    host.pins(run=3)
    host.idle()
    one, two = host.model.pulses(1), host.model.pulses(2)
    assert one[0] == two[0] and [b - a for a, b in zip(two, two[1:], strict=False)] == [1600] * 4
    assert sum(host.intervals()) == 27_008 and host.out("dir") == 0b10


@verifies("P2104-OPR-08")
def test_ac_52_pulse_only():
    host = ready()
    host.run("c C3 d 18 d 00 d 00 idle")
    assert sum(host.intervals()) == 27_008 and host.phases() == []
    host.run("c C6")
    host.fall(5, after=50)
    host.write(1, 0x40)
    assert host.end()[0] == 0xC6 and len(host.pulses()) == 5


@verifies("P2104-PHS-01", "P2104-PHS-05", "P2104-PHS-03")
@pytest.mark.parametrize("axis", [1, 2])
@pytest.mark.parametrize(
    "code, phases, half", [(1, 3, 0), (5, 3, 1), (2, 4, 0), (6, 4, 1), (3, 5, 0), (7, 5, 1)]
)
def test_ac_53_step_tables(code, phases, half, axis):
    base = 0x20 * (axis - 1)
    host = Host(f"c {code + base:02X} d 63 d 13 d 0A d 00 ready")
    host.axis = axis
    steps = step_list(phases, bool(half))
    host.mark = start = host.t
    for step in [0x42] * (2 * len(steps)) + [0x4A] * (2 * len(steps)):
        host.run(f"c {step + base:02X} idle")
    host.mark = start
    host.pause(4)
    host.sync()
    forward = [31 ^ steps[i % len(steps)] for i in range(1, 2 * len(steps) + 1)]
    backward = [31 ^ steps[-i % len(steps)] for i in range(1, 2 * len(steps) + 1)]
    assert host.phases() == [f"{value:05b}" for value in (*forward, *backward)]


@verifies("P2104-SW-01", "P2104-SW-02", "P2104-SW-03", "P2104-SW-04", "P2104-SW-05", "P2104-AUX-06")
def test_ac_54_switching():
    host = Host("c 12 d 63 d 13 d 0A d 00 ready")
    host.pause(10_000)
    host.sync()
    log = host.model.log
    shown = log.of("s1_n")
    assert [value for _, value in shown[:5]] == [0b11100, 31, 0b11100, 31, 0b11100]
    times = [b[0] - a[0] for a, b in zip(shown, shown[1:], strict=False)][1:5]
    assert all(abs(a - b) <= 5 for a, b in zip(times, (1328, 664, 1328, 664), strict=True))
    assert host.run("c 82 r c 84 d 40 d 80") == [0x3C]
    host.pause(10_000)
    host.sync()
    since = log.of("s1_n")[-4:]
    assert sorted(b[0] - a[0] for a, b in zip(since, since[1:], strict=False))[0] == 512
    host.run("c 42")
    fall = host.fall(1)
    assert log.of("s1_n")[-1] == (fall, 0b11001)
    assert all(not 0 < fall - t < 80 for t, _ in log.of("s1_n"))
    host.idle()
    ended = host.model.now
    host.pause(2000)
    host.sync()
    off, on = log.of("s1_n", ended)[:2]
    assert off[1] == 31 and abs(off[0] - ended - 512) <= 10 and on[0] - off[0] == 1024


@verifies("P2104-SW-01", "P2104-SW-02", "P2104-AUX-01")
def test_switching_survives_a_setting_and_ends_with_the_excitation():
    host = Host("c 12 d 63 d 13 d 0A d 00 ready")
    host.pause(20_000)
    host.run("c 12 d 63 d 12 d 0A d 00 ready")
    host.pause(20_000)
    host.sync()
    shown = host.model.log.of("s1_n")
    times = [b[0] - a[0] for a, b in zip(shown[1:], shown[2:], strict=False)]
    assert set(times) == {664, 1328}
    host.run("c C0 c 02 d 63 d 13 d 0A d 00 ready")
    set_up = host.model.now
    host.pause(10_000)
    host.sync()
    assert host.model.log.of("s1_n", set_up) == [] and host.out("s1_n") == 0b11100


@verifies("P2104-END-07", "P2104-AUX-05", "P2104-HLD-01")
def test_ac_55_hold_delay():
    host = ready()
    for script, delay in (("c 42", 51_200), ("c 85 d 00 c 42", 2048), ("c 85 d FF c 42", 524_288)):
        host.run(script + " idle")
        host.pause(delay + 100)
        host.sync()
        rise = host.model.bits("hold", 1)[-1]
        end = [t for t, level in host.model.bits("pout_n", 1) if level][-1]
        assert rise[1] == 1 and 0 <= rise[0] - end - delay <= 24
    host.run("c 85 d 01 c 42 idle")
    held = len(host.model.bits("hold", 1))
    host.pause(2000)
    host.run("c 42 idle")
    host.pause(4000)
    host.sync()
    assert len(host.model.bits("hold", 1)) == held


@verifies("P2104-AUX-01", "P2104-PHS-02")
def test_ac_57_excitation_off():
    host = ready()
    host.run("c 42 idle c C0")
    assert host.run("c 42 e1") == [4] and host.out("s1_n") == 31
    host.run("c 03 d 63 d 13 d 0A d 00 ready")
    assert host.out("s1_n") == 0b11100
    host.run("c 42 idle")
    assert host.out("s1_n") == 0b11001


@verifies("P2104-INI-05", "P2104-INI-06")
def test_ac_58_setting_again():
    host = ready()
    host.run("c 1F d 09 d 04 d 04 d 00 ready")
    host.pause(5000)
    host.sync()
    assert len(host.model.log.of("s1_n")) == 1
    host.run("c 42 idle")
    assert host.out("s1_n") == 0b11001
    host.run("c 43 d 0D d 00 d 00 idle")
    assert host.intervals() == [320, 256, 192, 192, *[160] * 5, 192, 192, 256, 320]


@verifies("P2104-GEN-03")
def test_ac_65_slower_crystal():
    host = Host(B1 + " ready c 43 d 18 d 00 d 00 idle", xtal_hz=8_000_000)
    assert host.intervals()[:2] == [6400, 3456] and sum(host.intervals()) == 2 * 27_008
    host.run("c 42 idle")
    host.pause(103_000)
    host.sync()
    rise, end = host.model.bits("hold", 1)[-1][0], host.model.bits("pout_n", 1)[-1][0]
    assert host.lows() == [160] and 102_400 <= rise - end <= 102_424


@verifies("P2104-HSK-05")
def test_shared_builder_queues():
    host = Host(B1 + " " + B2)
    first = second = None
    while second is None:
        host.step()
        building = host.model.status & 0x30
        first = first or (None if building & 0x10 else host.model.now)
        second = None if building else host.model.now
    build = host.model.latency.build(99, 19, 10) + host.model.latency.build_queue
    assert second - first == build and second < 80_000


@pytest.mark.parametrize("early, taken", [(0, 1), (1, 1), (-1, 1), (-2, 2)])
def test_code_that_meets_the_end_of_the_build(early, taken):
    """CMND falls on one edge, a code that waited is taken on the next; later ones are not delayed."""
    host = Host(B1)
    while host.model.status & 0x10:
        host.step()
    ready_at = host.model.now
    host = Host(B1)
    host.go(ready_at - early - 6)
    assert host.write(1, 0xC0) + 2 == ready_at - early
    host.model.run_until(ready_at + taken - 1)
    assert host.model.status & 2
    host.model.run_until(ready_at + taken)
    assert host.model.status & 2 == 0 and host.model.status & 0x10 == 0
