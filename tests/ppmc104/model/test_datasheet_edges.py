"""DATASHEET times of the golden model, exact to the cycle, with the fixed latencies of NOMINAL (P104-DS)."""

from __future__ import annotations

from functools import partial

import pytest

from tests.ppmc104.model.host import INIT_A, INIT_B, NOMINAL
from tests.ppmc104.model.host import Host as AnyHost

ModelHost = partial(AnyHost, latency=NOMINAL, timing="DATASHEET")


def ready(init: str = INIT_B, **pins: int) -> AnyHost:
    """Return an initialised host whose pins are set and whose mailbox is open."""
    host = ModelHost()
    host.run(init)
    host.pause(270_000)
    if pins:
        host.pins(**pins)
        host.pause(4)
    return host


@pytest.mark.parametrize(
    "move, busy, first",
    [
        ("c 42", 432, 1376),
        ("c 44 d 63 d 01 d 00 d 00", 432, 3104),
        ("c 45 d 63", 432, 3104),
        ("c 47 d 63", 432, 3104),
        ("c 43 d 13 d 00 d 00", 1792, 3200 + 123 * 20 // 16),
        ("c 43 d 14 d 00 d 00", 1792, 3200),
        ("c 46", 1792, 3200),
        ("c C6", 1792, 3200),
    ],
)
def test_start(move, busy, first):
    """BUSY, hold and dir change together, and pulse 1 follows after its documented time; the motor pins are
    one cycle later (P104-DS-03..06).
    """
    host = ready()
    host.run(move)
    event = host.written
    host.model.run_until(event + busy - 1)
    assert not host.model.busy and host.model.status & 2 == 0
    host.model.run_until(event + busy)
    assert host.model.busy
    assert host.fall(1) - event == first + 1
    assert host.model.log.falls("hold") == [event + busy + 1]


def test_bytes_wait_for_the_start():
    """A byte written after a start waits until BUSY rises and is then checked with BUSY = 1 (P104-DS-03)."""
    host = ready()
    host.run("c 46")
    event = host.written
    host.pause(20)
    host.write(1, 0x42)
    for t, status in ((1791, 0x02), (1792, 0x06), (1793, 0x94)):
        host.model.run_until(event + t)
        assert host.model.status == status


@pytest.mark.parametrize(
    "code, fall, delay, pulses",
    [
        (0x41, 4, 272, (8, 10)),
        ("l3_n", 4, 192, (8, 10)),
        ("l3_n", 20, 272, (31, 32)),
    ],
)
def test_forced_deceleration_flag_comes_late(code, fall, delay, pulses):
    """The deceleration flag is set 17 us after the write event, or 12 us (on the plateau 17 us) after the
    level was detected (P104-DS-10).
    """
    for offset, expected in zip((-1, 0), pulses, strict=True):
        host = ready()
        host.run("c 43 d E7 d 03 d 00")
        begin = host.fall(fall) - 1
        flag = begin + 4 * host.model.intervals[fall - 1].quanta + offset
        if isinstance(code, int):
            host.go(flag - delay - 4)
            host.write(1, code)
        else:
            host.go(flag - delay - 2)
            host.pins(**{code: 0})
            host.pins(**{code: 0})
            host.pins(**{code: 1})
        host.idle()
        assert len(host.pulses()) == expected
        assert host.finish()[0] == (0xC3 if code == 0x41 else 0x8B)


def test_second_decelerating_stop_waits_for_the_first():
    host = ready()
    host.run("c 43 d E7 d 03 d 00")
    host.fall(4, 20)
    event = host.write(1, 0x41)
    host.pause(10)
    host.write(1, 0x41)
    for t, status in ((272, 0x06), (273, 0xF4)):
        host.model.run_until(event + t)
        assert host.model.status == status
    host.pause(500)
    host.idle()
    assert len(host.pulses()) == 8


@pytest.mark.parametrize("move, closed", [("c C3", False), ("c 43", True)])
def test_speed_limit_depends_on_the_mode(move, closed):
    """Intervals of 112 quanta are too short to accept bytes in phase mode, but not in POUT mode
    (P104-DS-12).
    """
    host = ready("c 0A d 0D d 0D d 04 d 00")
    host.run(move + " d 63 d 00 d 00")
    host.fall(10, 20)
    host.write(1, 0xC1)
    host.pause(300)
    host.sync()
    assert host.model.status & 2 == (2 if closed else 0)
    assert host.out("aux_n") == int(closed)


def test_speed_limit_ends_with_the_fast_part():
    """In the deceleration of a fast move, bytes are accepted again from the first interval of 148 quanta on
    (P104-DS-12).
    """
    host = ready("c 0A d 27 d 09 d 04 d 00")
    host.run("c 43 d 13 d 00 d 00")
    host.fall(8, 20)
    event = host.write(1, 0xC1)
    quanta = [i.quanta for i in host.model.intervals]
    assert quanta[-1] < 148 <= quanta[0]
    host.idle()
    slow = next(i for i in host.model.intervals if i.number > 8 and i.quanta >= 148)
    (aux,) = host.model.log.falls("aux_n")
    assert aux == host.pulses()[slow.number - 1] - 1 + NOMINAL.ds12_lag + 224 > event


@pytest.mark.parametrize(
    "move, pulses, disturb, end, opened",
    [
        ("c 42", 1, None, 416, 416),
        ("c 44 d 63 d 02 d 00 d 00", 3, None, 416, 2496),
        ("c 43 d 02 d 00 d 00", 3, None, 416, 2496),
        ("c 43 d E7 d 03 d 00", 1, "l3_n", 3200, 3200),
        ("c 43 d E7 d 03 d 00", 2, "l1_n", 3200, 3200),
        ("c 44 d 63 d 63 d 00 d 00", 2, "alm_n", 416, 2496),
        ("c 47 d 63", 2, "cnp_n", 416, 2496),
    ],
)
def test_end(move, pulses, disturb, end, opened):
    """After the last pulse or the deciding edge, BUSY and INT change after their documented times, and then
    the mailbox opens (P104-DS-06..08).
    """
    host = ready(INIT_A, **({"l3_n": 0} if disturb == "l3_n" else {}))
    host.run(move)
    since = host.fall(pulses)
    if disturb not in (None, "l3_n"):
        host.go(since + 100)
        since = host.t + 2
        host.pins(**{disturb: 0})
    host.go(since + 20)
    host.write(1, 0x80)
    host.go(since + opened + 100)
    host.sync()
    log = host.model.log
    assert log.falls("int_n") == [since + end]
    assert log.rises("int_n") == [since + opened + 1] and host.model.status == 0x01


def test_auxiliary_output_and_excitation_off_roles():
    """AUX outputs change after 14 us. Excitation off takes effect after 18 us, or after 14 us if it is
    executed as AUX ON (P104-DS-11).
    """
    host = ready()
    host.run("c 86 d 0A")
    event = host.written
    host.pause(300)
    host.sync()
    assert host.model.log.of("auxo") == [(event + 224, 0b0101)]
    host.run("c 45 d 63")
    host.fall(1, 100)
    event = host.write(1, 0xC0)
    host.pause(300)
    host.sync()
    assert host.model.log.of("aux_n") == [(event + 224, 0)]


def test_cause_at_the_start_ends_as_an_immediate_end():
    host = ready(alm_n=0)
    host.run("c 46")
    event = host.written
    host.pause(1792 + 3210)
    host.sync()
    assert host.model.log.falls("int_n") == [event + 1792 + 1 + 3200]
    assert host.pulses() == []


def test_chopping_goes_on_until_busy_rises():
    host = ModelHost()
    host.run("c 2A d 09 d 04 d 04 d 00")
    host.pause(270_000)
    host.run("c 42")
    event = host.written
    host.pause(1400)
    host.sync()
    before = [t for t, level in host.model.log.of("s", event) if t < event + 433]
    assert all(event < t < event + 433 for t in before)
    assert host.model.log.levels["s"] in (0b00110, 0b00011)
    after = [(t, level) for t, level in host.model.log.of("s", event + 433)]
    assert after in ([(event + 1377, 0b00110)], [(event + 433, 0b00011), (event + 1377, 0b00110)])
