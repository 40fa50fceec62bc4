"""Single edges of the golden model that no acceptance check covers: bus, table builds, switching."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import verifies
from openppmc.model.clock import Edge
from tests.ppmc2104.model.host import B1, B2, Host


@verifies("P2104-BUS-08")
@pytest.mark.parametrize("busc", [0, 1])
def test_ac_79_three_bytes(busc):
    host = Host(B1 + " ready c 43 d E8 d 03 d 00 c 40 idle c 83", busc=busc)
    got = []
    for _ in range(3):
        got.append(host.model.read(host.t, 0, 2))
        edge0 = host.t + 2
        host.t += 5
        host.model.run_until(edge0 + 2)
        assert host.model.status & 1 == 0
        host.model.run_until(edge0 + 6)
        host.t = edge0 + 7
        assert host.model.status & 1 == (len(got) < 3)
    assert got == [0xE8, 3, 0] and host.read(0) == 0


@verifies("P2104-BUS-01", "P2104-BUS-02", "P2104-BAD-11", "P2104-BAD-12")
def test_what_makes_a_strobe():
    def shows(busc: int, first: int, second: int) -> tuple[int, int]:
        """Return d_oe while the strobe pins have the levels `first` and `second`, and the bit ERROR
        afterwards; the byte on the bus is an undefined code.
        """
        host = Host(busc=busc)
        host.pins(cs_n=0, ds_wrs_n=first, rw_rds_n=second, a0=1, d_i=0x87)
        host.pause(6)
        driven = host.out("d_oe")
        host.pins(cs_n=1, ds_wrs_n=1, rw_rds_n=1)
        host.pause(10)
        return driven, host.status() >> 7

    levels = ((0, 0), (0, 1), (1, 0), (1, 1))
    assert [shows(0, *pair) for pair in levels] == [(0, 0), (0, 1), (1, 0), (0, 0)]
    assert [shows(1, *pair) for pair in levels] == [(0, 1), (1, 0), (0, 0), (0, 0)]


def test_edges_are_ordered_and_single():
    host = Host(B1 + " ready " + B2 + " ready c 43 d 05 d 00 d 00 c 63 d 05 d 00 d 00 idle")
    edges: list[Edge] = host.model.edges
    assert all(a.t <= b.t for a, b in zip(edges, edges[1:], strict=False))
    assert len({(e.t, e.signal) for e in edges}) == len(edges)


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
    """A code that waits for the end of a build is accepted one edge after CMND falls; a later code waits no
    longer than usual.
    """
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
