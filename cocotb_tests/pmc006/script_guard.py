"""Scripts: emergency stops, stall detector, port word; what meets in one clk."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies

from .scenes import (
    DECAY,
    EXT1,
    EXT2,
    SPEED_MODE,
    STALL,
    after_steps,
    cruise,
    move,
    quick,
    rest,
    run,
    start,
    still,
)
from .script_host import EXECUTE, Host

STOP = 5
FLAGS = {"ext1": EXT1, "ext2": EXT2}
CLEAR = {"ext1": "b", "ext2": "l"}


@pytest.mark.parametrize("pin", ["ext1", "ext2"])
@pytest.mark.parametrize("rising", [0, 1])
@verifies(
    "P006-EXT-01", "P006-EXT-02", "P006-EXT-05", "P006-EXT-06", "P006-EXT-08", "P006-STA-10", "P006-STA-18"
)
def test_emergency_stop(pin: str, rising: int) -> None:
    """The selected edge stops within 5 clk, also speed mode; the other edge and the other pin do nothing."""
    other = "ext2" if pin == "ext1" else "ext1"
    host = quick(levels={"sda_i": 0, pin: 1 - rising})
    mask = 1 if pin == "ext1" else 2
    host.ok(f=mask, J=mask if rising else 3 - mask)
    assert host.out(f"{pin}_pu") == 1 - rising
    for go in (lambda: start(host, 5_000), lambda: run(host)):
        go()
        mark = host.mark
        after_steps(host, 4)
        host.pins(**{other: 0})
        host.pause(50)
        host.pins(**{other: 1})
        assert host.busy
        host.pins(**{pin: rising})
        edge = host.t - 1
        host.pause(STOP)
        assert not host.out("mon_busy") and not host.steps(edge + STOP + 1)
        assert host.status() == DECAY | FLAGS[pin] and not host.ask("O") & SPEED_MODE
        assert host.ask("s", 1) == 0 and host.ask("N", 1) == 0
        host.pins(**{pin: 1 - rising})
        assert host.ask(CLEAR[other]) == 0 and host.status() == DECAY | FLAGS[pin]
        assert host.ask(CLEAR[pin]) == 0 and host.status() == DECAY
        assert host.position() == host.made(0) and still(host, 2_000) and host.made(mark) > 3


@verifies("P006-EXT-02", "P006-EXT-03", "P006-EXT-04", "P006-EXT-07", "P006-EXT-09", "P006-BAD-26")
def test_levels_never_stop() -> None:
    """Enabling with an active switch, changing the mode at an active level: no flag, no stop."""
    for level in (0, 1):
        host = quick(levels={"sda_i": 0, "ext1": level, "ext2": level})
        start(host, 2_000)
        for mode in (3, 1, 0):
            host.ok(J=mode, f=3)
            host.ok(f=0)
            host.ok(f=3, J=mode)
        assert host.busy and host.status() == DECAY | 1
        host.ask("I")


@verifies("P006-EXT-04", "P006-EXT-09")
def test_edges_with_the_enable_off_are_forgotten() -> None:
    host = quick()
    host.pins(ext1=0)
    host.pause(10)
    host.ok(f=1)
    assert host.status() == DECAY
    host.pins(ext1=1)
    host.pause(10)
    host.pins(ext1=0)
    assert host.status() == DECAY | EXT1
    # f 0 does not clear it; b does.
    host.ok(f=0)
    assert host.status() == DECAY | EXT1 and host.ask("s", 1) == 0
    assert host.ask("b") == 0 and len(move(host, 2)) == 1


@verifies("P006-EXT-05", "P006-EXT-02", "P006-BAD-21", "P006-STA-17")
def test_both_inputs_and_chatter() -> None:
    host = quick()
    host.ok(f=3)
    start(host, 3_000)
    after_steps(host, 3)
    for level in (0, 1, 0, 1, 1, 0, 1):
        host.pins(ext1=level, ext2=level)
        host.pause(2)
    assert not host.busy and host.status() == DECAY | EXT1 | EXT2
    assert host.ask("b") == 0 and host.status() == DECAY | EXT2 and host.ask("s", 1) == 0
    assert host.ask("l") == 0 and host.ask("l") == 0 and host.status() == DECAY
    assert len(move(host, 2)) == 1


@verifies("P006-EXT-11", "P006-STA-11", "P006-EXT-10")
def test_locked_part_answers_everything_else() -> None:
    host = quick()
    host.ok(f=1)
    host.pins(ext1=0)
    host.ok(m=32, d=0, u=2, y=0x50, e=1500, i=-9, T=3, Y=1, Z=40, F=1)
    assert host.status() == DECAY | EXT1 and host.ask("x") == 0xB57
    assert [host.ask(code) for code in "kruA"] == [32, 2, 0, 0]
    host.ok(g=1, F=0)
    assert host.ask("b") == 0 and host.ask("s", 1) == 0
    host.ok(g=0)
    assert len(move(host, 2)) == 1 and host.position() == -11


@verifies("P006-EXT-10", "P006-EXT-08", "P006-EXT-07")
def test_homing() -> None:
    """Towards the switch, clear, off it by a fixed count: settings and position are exact."""
    host = quick()
    host.ok(f=1, d=0)
    start(host, 0x7FFFFFFF)
    after_steps(host, 12)
    host.pins(ext1=0)
    host.pause(20)
    made = host.made()
    assert host.position() == -made and host.ask("b") == 0
    host.ok(d=1)
    start(host, 20)
    after_steps(host, 6)
    host.pins(ext1=1)
    rest(host)
    assert host.made() == 20 and host.position() == 20 - made and host.status() == DECAY
    assert [host.ask(code) for code in "qLS"] == [3000] * 3


@verifies("P006-STA-14", "P006-EXT-02", "P006-STA-18")
def test_ext_around_the_last_step() -> None:
    """The edge walks over the clk of the last step: the flag is set, the count is what was made."""
    for offset in range(-5, 4):
        host = quick()
        host.ok(f=1)
        start(host, 3)
        edge = after_steps(host, 2) + host.us(1000) // 3 + offset
        host.go(max(host.t, edge))
        host.pins(ext1=0)
        host.pause(host.us(400))
        assert not host.busy and 2 <= host.made() <= 3
        assert host.status() == DECAY | EXT1 and host.position() == host.made()


@verifies("P006-STA-14", "P006-STA-17", "P006-EXT-02")
def test_flag_set_and_cleared_in_one_clk() -> None:
    """Setting wins; b that is executed later clears."""
    host = quick()
    host.ok(f=1)
    outcomes = set()
    for offset in range(-4, 8):
        host.pins(ext1=1)
        host.pause(20)
        host.say("b")
        answer_end = host.e
        host.go(answer_end + offset)
        host.pins(ext1=0)
        assert host.hear() == 0
        flag = host.status() & EXT1
        outcomes.add((offset, bool(flag)))
        assert host.ask("b") == 0
    flags = [flag for _, flag in sorted(outcomes)]
    assert flags == sorted(flags) and True in flags


# ---------------------------------------------------------------------- stall


def cruising(level: int = 256, length: int = 5, y: int = 1) -> Host:
    """A host on a part in speed mode at constant speed, with the stall detector on."""
    host = quick()
    host.ok(Z=level, T=length, Y=y)
    run(host)
    cruise(host, 1_000_000 / 3000)
    return host


def samples(host: Host, *levels: int) -> None:
    """Strobes of the BEMF."""
    for level in levels:
        host.strobe(bemf_level=level)
        host.pause(30)


@pytest.mark.parametrize(("length", "needed"), [(0, 1), (1, 1), (2, 2), (63, 63)])
@verifies("P006-STL-02", "P006-CMD-16")
def test_stall_length(length: int, needed: int) -> None:
    host = cruising(level=10, length=length)
    samples(host, *[9] * (needed - 1), 10, *[9] * (needed - 1))
    assert not host.status() & STALL
    samples(host, *[0] * needed)
    assert host.status() == DECAY | STALL | 1 and 0 < host.ask("X") <= host.made()
    host.ask("I")


@verifies("P006-STL-06", "P006-STL-05", "P006-STL-01", "P006-CMD-20", "P006-CMD-21")
def test_stall_after_reset_and_level_0() -> None:
    """Length 64 after reset; at level 0 nothing is below; without Y bit 0 nothing is looked at."""
    host = quick()
    host.ok(Z=511, Y=1)
    run(host)
    cruise(host, 1_000_000 / 3000)
    samples(host, *[510] * 63)
    assert not host.status() & STALL
    samples(host, 510)
    assert host.status() & STALL and host.ask("p") == 0
    host.ok(Z=0)
    samples(host, *[0] * 80)
    assert not host.status() & STALL
    host.ok(Z=511, Y=0, T=1)
    samples(host, *[0] * 4)
    assert not host.status() & STALL
    host.ask("I")
    host.ok(Y=1)
    samples(host, *[0] * 4)
    assert not host.status() & STALL


@verifies("P006-STL-01", "P006-STL-02", "P006-BAD-20")
def test_samples_off_constant_speed() -> None:
    """In a ramp nothing counts, and the count begins anew; a strobe that stays is a sample every clk."""
    host = Host()
    host.ok(L=1000, S=1000, v=1500, u=5, o=5, Z=100, T=3, Y=1)
    run(host)
    samples(host, *[50] * 20)
    assert not host.status() & STALL
    cruise(host, 667)
    host.ms(3)
    samples(host, 50, 50)
    host.ok(v=1600)
    samples(host, *[50] * 10)
    cruise(host, 625)
    host.ms(3)
    samples(host, 50, 50)
    assert not host.status() & STALL
    host.pins(bemf_level=50, bemf_valid=1)
    host.pause(4)
    host.pins(bemf_valid=0)
    assert host.status() & STALL
    host.ask("I")


@verifies("P006-STL-04", "P006-STL-02", "P006-STL-01")
def test_the_count_of_low_samples_begins_anew() -> None:
    """With each start, though no sample came between; and with a sample at rest, low as it is."""
    host = quick(2500)
    host.ok(L=2500, S=2500, Z=256, T=3, Y=1)
    for between in ((), (1,)):
        run(host)
        cruise(host, 400)
        samples(host, 1, 1)
        assert host.ask("I") == 0
        samples(host, *between)
        run(host)
        cruise(host, 400)
        samples(host, 1, 1)
        assert not host.status() & STALL
        samples(host, 1)
        assert host.status() & STALL and host.ask("I") == 0
    stalled_at = host.ask("X")
    run(host)
    assert not host.status() & STALL and host.ask("I") == 0 and host.ask("X") == stalled_at


@verifies("P006-STL-03", "P006-STL-04", "P006-STA-03", "P006-STA-10", "P006-CMD-37", "P006-IO-01")
def test_what_a_stall_does() -> None:
    host = cruising(y=5, length=2)
    host.ok(y=0x08)
    samples(host, 1, 1)
    edge = host.edges("gpo")[-1][0]
    assert host.out("gpo") == 0x11 and host.busy and host.t - edge < 100
    assert host.ask("x") & 0xF8 == 0x88 and host.ask("y", 0x10) == 0x10 and host.out("gpo") == 0x12
    stalled_at = host.ask("X")
    # Bit 1 set behind the stall stops the motion, too.
    host.ok(Y=7)
    assert not host.busy and host.out("gpo") == 0x12
    host.ok(Y=3)
    assert host.out("gpo") == 2
    host.ok(Y=4)
    assert host.out("gpo") == 0x12
    assert host.ask("s", 0) == 0 and host.status() == DECAY | STALL
    start(host, 1)
    assert not host.status() & STALL and host.out("gpo") == 2 and host.ask("X") == stalled_at
    rest(host)
    host.reset()
    host.boot()
    assert host.ask("X") == 0 and host.ask("T", 64) == 64


@verifies("P006-STL-03", "P006-STL-02", "P006-STA-14", "P006-STA-18")
def test_stall_stops_at_once() -> None:
    host = cruising(y=3, length=1)
    mark = host.mark
    host.strobe(bemf_level=0)
    edge = host.t - 2
    host.pause(STOP + 1)
    assert not host.out("mon_busy") and not host.steps(edge + STOP + 1)
    assert host.status() == DECAY | STALL and host.ask("X") == host.position() == host.made(mark)
    assert not host.ask("O") & SPEED_MODE
    run(host)
    assert not host.status() & STALL and host.ask("I") == 0


# ---------------------------------------------------------------------- ports


@verifies("P006-IO-01", "P006-IO-02", "P006-IO-03", "P006-IO-04", "P006-PORT-03")
def test_port_word() -> None:
    host = Host()
    host.ok(J=3, f=3)
    for number, gpi in enumerate((0, 1, 2, 4, 8, 16, 21, 31)):
        for ext in (number % 4, 3 - number % 4):
            host.pins(gpi=gpi, ext1=ext & 1, ext2=ext >> 1)
            value = (gpi * 9) & 0xF8
            host.ok(y=value)
            assert host.ask("x") == ext << 10 | gpi >> 3 << 8 | value | gpi & 7
            assert host.out("gpo") == value >> 3
    host.ok(g=1)
    assert host.ask("I") == 0 and host.out("gpo") == value >> 3
    change = host.t
    host.reset()
    assert host.out("gpo") == 0 and host.edges("gpo", change)
    host.boot()
    assert not host.edges("gpo", change + 20)


@verifies("P006-STA-14", "P006-STA-15", "P006-STA-10")
def test_frames_executed_around_a_step() -> None:
    """i, I, g walk over the clk of a step: no step is lost or doubled, none follows a stop."""
    for code, data in (("i", 500), ("I", 0), ("g", 1)):
        for offset in range(-2, 5):
            host = quick()
            start(host, 12)
            mark = host.mark
            first = after_steps(host, 1)
            target = first + host.us(1000) * 3 + offset
            host.go(target - int(79.5 * host.bit) - 2)
            assert host.ask(code, data) == data
            if code == "i":
                rest(host)
                left = sum(t > target - 2 for t in host.steps(mark))
                assert host.made(mark) == 12 and 0 <= left - (host.position() - 500) <= 1
            else:
                assert not host.busy and not host.steps(host.e + EXECUTE + STOP)
                assert host.position() == host.made(mark)
