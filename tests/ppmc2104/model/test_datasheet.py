"""DATASHEET timing of the golden model of the PPMC-2104: windows, polling, rate limits."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import verifies
from cocotb_tests.ppmc2104.datasheet_timing import CONSTANT, SETTING, detection
from openppmc.model import Latency
from tests.ppmc2104.model.host import B1, B2, LONG, Host

# The window latency of this core is 0, so that all times are exactly those of the tables.
PLAIN = Latency(ds_window=0)


def ready(script: str = B1) -> Host:
    return Host(script + " ready ", timing="DATASHEET", latency=PLAIN)


def c_event(host: Host) -> int:
    return host.written + 2


@verifies("P2104-DS-01")
def test_ac_73_setting():
    host = Host(B1, timing="DATASHEET", latency=PLAIN)
    since = c_event(host)
    assert host.out("s1_n") == 0b11100 and host.status() == 0x10
    host.write(0, 0xC1)
    host.go(since + 71_000 * 16 - 6)
    assert host.read(1) == 0x12
    host.model.run_until(since + 71_000 * 16)
    assert host.model.status == 0x02
    host.model.run_until(since + 71_000 * 16 + 1)
    assert host.model.status == 0x80


@verifies(
    "P2104-DS-04",
    "P2104-DS-05",
    "P2104-DS-06",
    "P2104-DS-07",
    "P2104-DS-08",
    "P2104-DS-09",
    "P2104-DS-14",
)
@pytest.mark.parametrize(
    "script, us",
    [
        ("c 42", 103),
        ("c 44 d 63 d 02 d 00 d 00", 29),
        ("c 45 d 63", 32),
        ("c 47 d 63", 32),
        ("c 46", 118),
        ("c C6", 118),
        ("c 43 d 09 d 00 d 00", 340),
        ("c 43 d 13 d 00 d 00", 340),
        ("c 43 d 14 d 00 d 00", 110),
        ("c C3 d 63 d 00 d 00", 110),
    ],
)
def test_ac_71_first_pulse(script, us):
    host = ready()
    words = script.split()
    host.run(" ".join(words[:-2]))
    event = host.write(int(words[-2] == "c"), int(words[-1], 16)) + 2
    host.model.run_until(event)
    assert host.model.status == 0x14
    host.model.run_until(event + 1)
    assert host.model.outputs["hold"] == 0b10
    assert host.fall(1) - event == 16 * us + 80 + 1


@verifies("P2104-DS-02")
def test_ac_72_immediate_stop():
    host = ready()
    host.run("c 44 d 63 d FF d 0F d 00")
    host.fall(10, after=100)
    mark = host.mark
    cut = host.write(1, 0x40) + 2
    host.pause(100)
    host.write(1, 0xD1)
    host.go(cut + 6390)
    assert host.status() & 0x16 == 0x16
    host.model.run_until(cut + 6400)
    assert host.model.status == 0x02 and host.model.outputs["auxo"] == 3
    host.model.run_until(cut + 6401)
    assert host.model.status == 0 and host.model.outputs["int_n"] == 0
    host.model.run_until(cut + 6401 + 640)
    assert host.model.outputs["auxo"] == 2
    host.mark, host.t = mark, host.model.now + 1
    assert host.end() == (0xC4, 4096 - 11) and len(host.pulses()) == 10


@verifies("P2104-DS-02", "P2104-STP-05")
def test_immediate_stop_in_fin_does_not_delay_the_end():
    host = ready()
    host.run("c 42")
    fall = host.fall(1)
    host.go(fall + 4)
    cut = host.write(1, 0x40) + 2
    host.model.run_until(cut + 100)
    assert host.model.status == 0x10 and host.model.outputs["int_n"] == 0
    host.model.run_until(cut + 6400)
    assert host.model.status == 0


@verifies("P2104-DS-03")
@pytest.mark.parametrize("lead, pulses", [(512, 10), (511, 12)])
def test_deceleration_stop_acts_at_the_end_of_its_window(lead, pulses):
    """A deceleration stop takes effect at pulse 6 if its window ends before this pulse event, else at a later
    pulse.
    """
    host = ready()
    host.run(LONG)
    sixth = host.fall(5) - 1 + 992
    host.go(sixth - lead - 6)
    assert host.write(1, 0x41) + 2 == sixth - lead
    assert host.end()[0] == 0xC3 and len(host.pulses()) == pulses


@verifies("P2104-DS-10", "P2104-DS-12")
@pytest.mark.parametrize("code, us", [(0x80, 40), (0x81, 36), (0x82, 32), (0x83, 37), (0x86, 43), (0xC2, 40)])
def test_ac_74_reads(code, us):
    host = ready()
    event = host.write(1, code) + 2
    host.model.run_until(event + 16 * us - 1)
    assert host.model.status == (0x00 if code == 0xC2 else 0x10)
    host.model.run_until(event + 16 * us)
    assert host.model.status == 0x01


@verifies("P2104-DS-11", "P2104-DS-13")
def test_excitation_off_switching_hold_delay():
    host = ready()
    event = host.write(1, 0xC0) + 2
    host.model.run_until(event + 512)
    assert host.model.outputs["s1_n"] == 0b11100
    host.model.run_until(event + 513)
    assert host.model.outputs["s1_n"] == 31
    host.t = event + 520
    for script, us in (("c 84 d 40", 36), ("c 85", 32)):
        host.run(script)
        event = host.write(0, 0x50) + 2
        host.model.run_until(event + 16 * us - 1)
        assert host.model.status == 0x10
        host.model.run_until(event + 16 * us)
        assert host.model.status == 0
        host.t = host.model.now + 1


def test_refused_instructions_have_no_window():
    host = ready()
    event = host.write(1, 0x87) + 2
    host.model.run_until(event)
    assert host.model.status == 0x80
    host.t = event + 1
    event = host.write(1, 0x40) + 2
    host.model.run_until(event)
    assert host.model.status == 0x80


@verifies("P2104-DS-20")
def test_ac_75_polled_limit():
    ended = []
    for step in range(7):
        host = ready()
        host.run("c 45 d FF")
        host.fall(3)
        host.go(((host.t // 560) + 20) * 560 + 80 * step)
        low = host.t
        host.pin("fl_n", 0)
        host.go(low + 160)
        host.pin("fl_n", 1)
        host.pause(3000)
        host.sync()
        ended.append(not host.model.busy(1))
        if not ended[-1]:
            low = host.t
            host.pin("fl_n", 0)
            host.go(low + 576)
            host.pin("fl_n", 1)
            host.pause(10)
            host.sync()
            falls = [t for t, level in host.model.log.of("int_n") if level == 0]
            assert not host.model.busy(1) and falls[-1] - low <= 568
            assert host.end()[0] == 0x95
    assert 1 <= sum(ended) <= 3


@verifies("P2104-DS-23")
def test_polling_examples_of_the_data_sheet():
    """`detection` returns the four results that the data sheet prints."""
    assert detection(SETTING, 0, 0) == 71_035
    assert detection(0, CONSTANT, 0, 100) == 73
    assert detection(0, CONSTANT, CONSTANT, 100) == 187
    assert detection(SETTING, CONSTANT, 0, 50) == 295_995


@verifies("P2104-DS-20")
def test_no_ticks_while_a_window_is_open():
    host = ready(B1 + " ready " + B2)
    host.run("c 45 d FF")
    host.fall(3, after=50)
    event = host.write(1, 0xA6) + 2
    host.pin("fl_n", 0)
    host.idle()
    # The longest detection time is the window of 43 us plus a complete polling period.
    assert host.model.now == event + 688 + 560 + 1


@verifies("P2104-DS-02")
def test_immediate_stop_while_pout_is_low():
    host = ready()
    host.run("c 44 d 63 d FF d 0F d 00")
    fall = host.fall(10)
    host.go(fall + 10)
    cut = host.write(1, 0x40) + 2
    host.idle()
    assert host.model.now == cut + 6400 and len(host.pulses()) == 10 and host.lows()[-1] == 80


@verifies("P2104-DS-20")
@pytest.mark.parametrize("early, ends", [(0, 0), (1, 688 - 1 + 560)])
def test_tick_on_the_edge_on_which_a_window_opens(early, ends):
    """A polling tick on the edge that opens a window still takes effect; if the window opens one cycle
    earlier, the tick is delayed until after the window.
    """
    host = ready(B1 + " ready " + B2)
    host.run("c 45 d FF")
    tick = c_event(host) + 32 * 16 + 20 * 560
    # A byte is accepted 6 cycles after its strobe begins; a level is detected 2 cycles after the edge that
    # samples it.
    host.go(tick - 6 - early)
    assert host.write(1, 0xA6) + 2 == tick - early
    host.model.pins(tick - 2, fl_n=0b10)
    host.idle()
    assert host.model.now == tick + ends + 1


@verifies("P2104-DS-20")
@pytest.mark.parametrize("late, ends", [(0, 560), (560, 560), (561, 1120)])
def test_first_tick_after_a_window(late, ends):
    """The first polling tick after a window is one complete period after its end, not at its end."""
    host = ready(B1 + " ready " + B2)
    host.run("c 45 d FF")
    host.fall(3, after=50)
    end = host.write(1, 0xA6) + 2 + 43 * 16
    host.model.pins(end + late - 2, fl_n=0b10)
    host.idle()
    assert host.model.now == end + ends + 1


@verifies("P2104-DS-21")
def test_ac_76_origin_at_pulse_events():
    host = ready()
    host.run("c 47 d 31")
    host.fall(5, after=100)
    host.pin("org_n", 0)
    host.pause(500)
    host.pin("org_n", 1)
    host.fall(8, after=1500)
    host.pin("org_n", 0)
    assert host.end() == (0x87, 0xFFFFF6) and len(host.pulses()) == 9


@verifies("P2104-DS-22")
def test_live_levels_at_the_start():
    host = ready()
    host.pin("fl_n", 0)
    host.pause(4)
    assert host.run("c 42 e1 c 81 r") == [7, 0xC7]


def error(host: Host, script: str) -> int:
    """Return the error number of an operation of axis 1; stop the operation if it has started."""
    (code,) = host.run(script + " e1")
    if host.model.busy(1):
        host.run("c 40")
        host.poll(0x04, 0)
    return code


def counted(code: int, rate: int) -> str:
    return f"c {code:02X} d {rate:02X}" + (" d 09 d 00 d 00" if code == 0x44 else "")


def ramp(rh: int, code: int = 0xC3) -> str:
    return f"c 02 d 63 d {rh:02X} d 0A d 00 ready c {code:02X} d 18 d 00 d 00"


@verifies("P2104-DS-30")
@pytest.mark.parametrize("csel, limits", [(1, (0x12, 0x14, 0x0C)), (0, (0x04, 0x05, 0x03))])
def test_ac_67_68_one_axis(csel, limits):
    host = ready()
    host.pins(csel=csel | 2)
    host.pause(4)
    phase, origin, pulse = limits
    for code, limit in ((0x44, phase), (0x45, phase), (0x47, origin)):
        assert error(host, counted(code, limit - 1)) == 12
        assert error(host, counted(code, limit)) == 0
    assert error(host, ramp(pulse - 1)) == 12 and error(host, ramp(pulse)) == 0
    assert error(host, ramp(phase - 1, 0x43)) == 12 and error(host, ramp(phase, 0x43)) == 0


@verifies("P2104-DS-30", "P2104-DS-31")
@pytest.mark.parametrize("csel, limits", [(1, (0x23, 0x25, 0x19)), (0, (0x08, 0x09, 0x06))])
@pytest.mark.parametrize("switching", [False, True])
def test_ac_69_two_axes(csel, limits, switching):
    host = ready(B1 + " ready " + B2.replace("22", "32" if switching else "22"))
    host.pins(csel=csel | 2, run=1)
    host.pause(4)
    host.run("" if switching else "c 62")
    phase, origin, pulse = limits
    for code, limit in ((0x44, phase), (0x47, origin)):
        assert error(host, counted(code, limit - 1)) == 13
        assert error(host, counted(code, limit)) == 0
    assert error(host, ramp(pulse - 1)) == 13 and error(host, ramp(pulse)) == 0
    assert error(host, counted(0x44, 0x11 if csel else 3)) == 12


@verifies("P2104-DS-33", "P2104-DS-34", "P2104-DS-32")
def test_ac_70_what_is_not_limited():
    host = ready(B1 + " ready " + B2.replace("22", "2A"))
    assert host.run("c 65 d 00 e2 c 42 e1") == [0, 0]
    host.axis = 1
    host.poll(4, 0)
    assert len(host.model.pulses(1)) == 1 and host.model.busy(2)
    fast = Host(B1 + " ready " + B2 + " ready c 65 d 01")
    assert fast.run("c 44 d 01 d 09 d 00 d 00 e1") == [0] and fast.model.busy(2)
