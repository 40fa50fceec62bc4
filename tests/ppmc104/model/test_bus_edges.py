"""Bus, mailbox and output queue of the golden model, exact to the cycle (P104-BUS, P104-HSK)."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import pytest

from openppmc.model import Ppmc104 as AnyModel
from tests.ppmc104.model.host import INIT_A, NOMINAL
from tests.ppmc104.model.host import Host as AnyHost

Ppmc104 = partial(AnyModel, latency=NOMINAL)
ModelHost = partial(AnyHost, latency=NOMINAL)


def test_write_event_and_c_event_edges():
    model = Ppmc104()
    edge0 = model.write(10, 1, 0xC1)
    for t, status, aux_n in ((edge0 + 1, 0, 1), (edge0 + 2, 2, 1), (edge0 + 3, 2, 1), (edge0 + 4, 0, 0)):
        model.run_until(t)
        assert (model.status, model.outputs["aux_n"]) == (status, aux_n), t - edge0


@pytest.mark.parametrize("after", range(8))
def test_a_written_byte_is_never_invisible(after):
    """A status read directly after a write returns IBF = 1 or already the effect of the byte
    (P104-BUS-07).
    """
    model = Ppmc104()
    edge0 = model.write(10, 1, 0xFF)
    assert model.read(edge0 + after, 1) in ((0x02,) if after < 3 else (0x02, 0x80))
    assert model.read(edge0 + after + 8, 1) == 0x80


def test_byte_is_the_last_one_under_the_strobe():
    model = Ppmc104()
    model.pins(10, cs_n=0, wr_n=0, a0=1, d_i=0xC2)
    model.pins(12, d_i=0xC1)
    model.pins(13, wr_n=1, cs_n=1, d_i=0x42, a0=0)
    model.run_until(20)
    assert model.outputs["aux_n"] == 0 and model.status == 0


@pytest.mark.parametrize("ending", ["cs_n", "wr_n"])
def test_either_pin_ends_a_write(ending):
    model = Ppmc104()
    model.pins(10, cs_n=0, wr_n=0, a0=1, d_i=0xC1)
    model.pins(12, **{ending: 1})
    model.run_until(17)
    assert model.outputs["aux_n"] == 0


def test_read_strobe_ends_a_write():
    """If rd_n falls during a write strobe, the write ends, and no read takes place (P104-BUS-02)."""
    model = Ppmc104()
    model.pins(10, cs_n=0, wr_n=0, a0=1, d_i=0xC1)
    model.pins(12, rd_n=0)
    model.run_until(20)
    assert model.outputs["aux_n"] == 0 and model.log.of("d_oe") == []


def test_replacement_in_the_window_and_on_the_c_event_edge():
    """If a byte is replaced while it waits, only the newer byte is accepted. If it is replaced on the edge on
    which it is consumed (its C-event), both bytes are accepted, the older one first (P104-HSK-02).
    """
    model = AnyModel(latency=replace(NOMINAL, build_clk=lambda rl, rh, pa: 500))
    t = 10
    for i, byte in enumerate((0x0A, 9, 4, 4, 0)):
        t = model.write(t, int(i == 0), byte) + 6
    t = model.write(t, 1, 0xC1) + 6
    t = model.write(t, 1, 0x86) + 6
    model.run_until(t + 600)
    assert model.log.of("aux_n") == [] and model.status == 0x10

    model = Ppmc104()
    # Write events at 14 and 16; the first byte is accepted at 16, the second at 18.
    model.write(10, 1, 0xC1)
    assert model.write(13, 1, 0xC2, strobe=1) == 14
    model.run_until(30)
    assert model.log.of("aux_n") == [(16, 0), (18, 1)]


def test_data_read_takes_the_byte_once():
    host = ModelHost()
    host.run("c 81")
    start = host.t
    model = host.model
    assert model.read(start, 0) == 0xCF
    for t, obf in ((start + 5, 1), (start + 6, 0)):
        model.run_until(t)
        assert model.status & 1 == obf
    assert model.read(start + 8, 0) == 0xCF and model.read(start + 14, 1) == 0


@pytest.mark.parametrize("gap", [1, 2, 3])
def test_status_never_shows_a_byte_already_read(gap):
    host = ModelHost()
    host.run("c 81")
    assert host.model.read(host.t, 0) == 0xCF
    assert host.model.read(host.t + 4 + gap, 1) == 0


def test_three_byte_answer():
    host = ModelHost()
    host.run(INIT_A + " c 44 d 63 d 03 d 02 d 01")
    host.fall(1, 200)
    host.command(0x40)
    host.idle()
    host.run("c 83")
    model = host.model
    for byte, more in ((2, 1), (2, 1), (1, 0)):
        end = host.t + 4
        assert model.read(host.t, 0) == byte
        for t, obf in ((end + 1, 1), (end + 2, 0), (end + 3, 0), (end + 4, more)):
            model.run_until(t)
            assert model.status & 1 == obf
        host.t = end + 6
    assert host.read(0) == 1


def test_read_command_beats_a_byte_on_its_way_out():
    """If a read command is accepted while a data read consumes a byte, the new answer replaces this byte
    (P104-HSK-08).
    """
    for wait in range(6):
        host = ModelHost()
        host.run("c 81")
        edge0 = host.write(1, 0x82, gap=wait) - 2
        first = host.read(0)
        assert first == (0xCF if edge0 + wait < edge0 + 4 else 0xFC)
        host.pause(8)
        if first == 0xCF:
            assert host.fetch() == 0xFC
        else:
            assert host.read(1) == 0


def test_output_survives_motion():
    """A motion does not change an answer byte that was not read yet (P104-HSK-08, P104-BAD-22)."""
    host = ModelHost()
    host.run(INIT_A + " c 81 c 44 d 63 d 02 d 00 d 00")
    assert host.read(1) == 0x05 and host.fetch() == 0xCF
    assert host.read(1) == 0x04


def test_reset_between_two_edges_and_short():
    """If rst_n is low only between two edges, the core is reset; the changes of its outputs have the number
    of the next edge.
    """
    host = ModelHost(phase_idle=0)
    assert host.out("s") == 0
    host.run(INIT_A + " c C1 c 4A")
    host.fall(1)
    t = host.model.now + 1
    host.model.pins(t, rst_n=0)
    host.model.pins(t, rst_n=1)
    changes = {e.signal: e.value for e in host.model.edges if e.t == t}
    assert changes == {"s": 0, "hold": 1, "pout_n": 1, "dir": 0, "aux_n": 1, "d_o": 0}
    host.go(t + 1)
    assert host.read(1) == 0 and not host.model.initialised
    assert host.statuses("c 42") == [0xA0]


def test_strobe_across_reset_release():
    model = Ppmc104()
    model.pins(5, rst_n=0, cs_n=0, wr_n=0, a0=1, d_i=0xC1)
    model.pins(10, rst_n=1, wr_n=1)
    model.run_until(30)
    assert model.log.of("aux_n") == []
    model.pins(40, rst_n=0, wr_n=0)
    model.pins(45, rst_n=1)
    model.pins(46, wr_n=1)
    model.run_until(60)
    assert model.log.of("aux_n") == [(50, 0)]


def test_quantum_counter_starts_at_the_release():
    """After a reset, the chopper has the same phase as after power-up, whichever edge releases the reset."""

    def chopped(release: int) -> list[int]:
        model = Ppmc104()
        if release:
            model.pins(release - 5, rst_n=0)
            model.pins(release, rst_n=1)
        t = release + 10
        for i, byte in enumerate((0x2A, 9, 4, 4, 0)):
            t = model.write(t, int(i == 0), byte) + 6
        model.run_until(release + 5000)
        return [edge - release for edge, _ in model.log.of("s", release)]

    assert len(chopped(0)) > 3
    assert chopped(0) == chopped(1001) == chopped(1002) == chopped(1003)
