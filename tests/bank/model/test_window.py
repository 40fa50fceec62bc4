"""The window of the bank's model: addresses, registers, strobes, snapshots (BANK-WIN, BANK-GEN).

R is the number of cycles in a round.
"""

from __future__ import annotations

import pytest

from openppmc.model.bank import PpmcBank
from openppmc.model.bank.window import INFO, PENDING
from tests.bank.model.host import CONFIG, DATA, GO, MASK, POSITION, STATUS, STOP, Host


@pytest.mark.parametrize(
    "parameters",
    [
        {"axes": 5},
        {"axes": 128},
        {"phase_idle": 2},
        {"clk_hz": 33_000_000},
        {"axes": 32, "clk_hz": 28_000_000},
        {"axes": 64, "clk_hz": 60_000_000},
        {"clk_hz": 204_000_000},
        {"xtal_hz": 20_000_000},
    ],
)
def test_parameters_that_are_refused(parameters):
    """Invalid parameters raise ValueError (BANK-GEN-01, BANK-GEN-02)."""
    with pytest.raises(ValueError, match="|".join(parameters)):
        PpmcBank(**parameters)


@pytest.mark.parametrize("axes, clk_hz", [(4, 8_000_000), (32, 32_000_000), (64, 64_000_000)])
def test_slowest_clocks(axes, clk_hz):
    """At the lowest clock frequency, CYC(16) is exactly one round (BANK-GEN-01, BANK-GEN-02)."""
    bank = PpmcBank(axes, clk_hz)
    assert bank.round == max(axes, 8) == bank.timebase.cyc(16)
    assert bank.visit(3, 0) == 3 + 8 + bank.round and bank.visit(3, 12 + bank.round) == 11 + 2 * bank.round


def test_reset_levels():
    """A reset sets all outputs to their reset levels (BANK-GEN-05, P104-PORT-03)."""
    for idle in (0, 1):
        host = Host(4, phase_idle=idle)
        rest = {"d_o": 0, "d_oe": 0, "int_n": 1, "pout_n": 15, "dir": 0, "hold": 15}
        assert dict(host.model.outputs) == rest | {"s": ((1 << 20) - 1) * idle}
        host.ready(1)
        start = host.send(1, "c 4D d 63")
        host.model.pins(start + 700, rst_n=0)
        assert host.model.outputs["hold"] == host.model.outputs["pout_n"] == 15
        assert host.model.outputs["dir"] == 0 and not host.model.busy(1)
        host.t = start + 800
        host.model.pins(host.t, rst_n=1)
        first = host.t
        assert host.model.visit(0, 0) == first + 16
        host.t += 30
        assert host.read(1, STATUS) == 0 and host.position(1) == 0


@pytest.mark.parametrize("after, status, config", [(14, 2, 0), (15, 0, 3)])
def test_not_ready(after, status, config):
    """Reads whose edge 2 is edge R + 7 or later return the registers; earlier ones return the values of a
    bank that is not ready (BANK-GEN-05).
    """
    for register, value in ((STATUS, status), (CONFIG, config), (DATA, 0), (0x3, 0xFF)):
        host = Host()
        host.t = after - 2
        assert host.read(1, register) == value


@pytest.mark.parametrize("event, mask", [(15, 0), (16, 5)])
def test_writes_before_ready_do_nothing(event, mask):
    """A write event on edge R + 7 or earlier has no effect; one on edge R + 8 has an effect (BANK-GEN-05)."""
    host = Host()
    host.t = 4
    host.write_at(event, 0, MASK, 5)
    host.t = 60
    assert host.read(0, MASK) == mask


def test_addresses():
    """Each address accesses its register; absent axes and registers read as FF (BANK-WIN-01,
    BANK-WIN-02, BANK-WIN-03).
    """
    host = Host(16)
    for register in (0x3, 0xD, 0xE, 0xF):
        assert host.read(2, register) == 0xFF
    for register in range(16):
        host.write(16, register, 0)
        assert host.read(16, register) == 0xFF == host.read(63, register)
    for register, value in (
        (DATA, 0),
        (STATUS, 0),
        (CONFIG, 3),
        (GO, 0),
        (STOP, 0),
        (POSITION, 0),
        (PENDING, 0),
    ):
        assert host.read(2, register) == value
    assert [host.read(k, INFO) for k in range(9)] == [0x42, 1, 16, 0, 0, 0, 0, 0, 0x42]
    host.write(2, CONFIG, 0xFE)
    assert host.read(2, CONFIG) == 2 and host.read(3, CONFIG) == 3
    host.write(2, INFO, 0)
    host.write(2, PENDING, 0xFF)
    host.write(2, POSITION, 0xFF)
    assert (host.read(2, INFO), host.read(2, PENDING), host.read(2, POSITION)) == (16, 0, 0)


def test_mask_has_a_byte_for_eight_axes():
    """Bit i of MASK byte k belongs to axis 8 k + i, with k = a[6:4]; bits of absent axes stay 0
    (BANK-WIN-03).
    """
    host = Host(16)
    host.write(8, MASK, 0x81)
    host.write(1, MASK, 0x42)
    host.write(2, MASK, 0xFF)
    assert [host.read(k, MASK) for k in (0, 1, 2, 9)] == [0x81, 0x42, 0, 0x42]
    small = Host(4)
    small.write(0, MASK, 0xFF)
    assert small.read(0, MASK) == 0x0F


@pytest.mark.parametrize("strobe", [1, 2, 3, 6])
@pytest.mark.parametrize("event", [0, 1, 2])
def test_snapshot_of_a_read(strobe, event):
    """d_oe = 1 on edge 2, and from edge 4 on d_o has the state after edge 2; a read strobe of less than 3
    cycles does not change d_o (BANK-WIN-04, BANK-WIN-05).
    """
    model, edge, address = Host().model, 60, 0x20 | CONFIG
    model.pins(edge + event - 4, cs_n=0, wr_n=0, a=address, d_i=2)
    if event < 2:
        model.pins(edge + event - 2, cs_n=1, wr_n=1)
    model.pins(edge, cs_n=0, wr_n=1, rd_n=0)
    model.pins(edge + strobe, cs_n=1, rd_n=1)
    model.run_until(edge + 40)
    assert [(t - edge, value) for t, value in model.log.of("d_o")] == [(4, 2)] * (strobe >= 3)
    assert [(t - edge, value) for t, value in model.log.of("d_oe")] == [(2, 1), (2 + strobe, 0)]


def test_write_event():
    """The write event is on edge 2; a and d_i of the last sample with the strobe are used (BANK-WIN-06)."""
    host = Host()
    t = host.t
    host.model.pins(t, cs_n=0, wr_n=0, a=0x20, d_i=1)
    host.model.pins(t + 2, a=0x12, d_i=2)
    host.model.pins(t + 3, cs_n=1, wr_n=1, a=0x32, d_i=0)
    host.go(t + 30)
    assert [host.read(axis, CONFIG) for axis in (1, 2, 3)] == [2, 3, 3]
    both = host.t
    host.model.pins(both, cs_n=0, wr_n=0, rd_n=0, a=0x12, d_i=0)
    host.model.pins(both + 6, cs_n=1, wr_n=1, rd_n=1)
    host.t = both + 12
    assert host.read(1, CONFIG) == 2 and host.model.log.rises("d_oe", both) == [host.t - 9 + 2]


def test_position_counts_at_the_visit_that_orders():
    """A pulse is counted at a visit before its edge, at most R - 1 cycles earlier (BANK-WIN-07)."""
    host = Host()
    host.ready(2)
    start = host.send(2, "c 4A")
    pulse = start + host.w
    ordering = host.model.visit(2, pulse) - 8
    assert pulse - 8 < ordering < pulse
    for edge, position in ((ordering - 1, 0), (ordering, -1), (pulse, -1), (pulse + 3000, -1)):
        host.go(edge)
        assert host.model.position(2) == position
    assert host.position(2) == -1


def test_position_of_pulse_mode_and_both_directions():
    """The position also counts pulses in POUT mode; initialisation and excitation off do not change it
    (BANK-WIN-07).
    """
    host = Host()
    host.ready(0)
    for script, position in (
        ("c C3 d 04 d 01 d 00", 261),
        ("c 4C d 00 d 00 d 02 d 00", -252),
        ("c C0", -252),
    ):
        host.send(0, script)
        host.idle(0)
        assert host.position(0) == position
    host.ready(0)
    assert host.position(0) == -252


def test_position_byte_0_keeps_the_others():
    """A read of byte 0 latches the other bytes of the position; reads at any axis then return them
    (BANK-WIN-07).
    """
    host = Host()
    host.ready(0)
    host.send(0, "c 4A")
    host.idle(0)
    assert host.read(0, POSITION) == 0xFF
    assert [host.read(axis, POSITION + place) for axis, place in ((1, 1), (0, 3), (7, 2))] == [0xFF] * 3
    assert host.read(1, POSITION) == 0 and host.read(0, POSITION + 1) == 0


def test_interrupt_map():
    """The interrupt map has a 1 for each axis with a pending interrupt (BANK-WIN-08, P104-END-07)."""
    host = Host(16)
    for axis in (3, 9, 12):
        host.ready(axis)
    for axis, code in ((3, 0x42), (9, 0x42), (12, 0x52)):
        host.send(axis, f"c {code:02X}")
    fall = host.idle(3)
    assert host.model.log.of("int_n") == [(fall, 0)]
    host.idle(12)
    assert [host.read(k, PENDING) for k in range(3)] == [0x08, 0x02, 0]
    host.send(3, "c 80")
    assert host.read(0, PENDING) == 0 and host.model.outputs["int_n"] == 0
    rise = host.send(9, "c 80")
    assert host.model.log.of("int_n")[1:] == [(rise, 1)] and host.read(1, PENDING) == 0
    assert host.read(12, STATUS) == 0
