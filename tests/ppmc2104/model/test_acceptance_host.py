"""Acceptance checks of instructions, errors, registers and INT* on the golden model of the PPMC-2104."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from openppmc.model.common.edges import Edge
from openppmc.model.motion.codes import Kind
from openppmc.model.ppmc2104.codes import decode
from tests.ppmc2104.model.host import B1, B2, LONG, Host

HIGH = range(80, 83)


def releases(host: Host, since: int = 0) -> list[tuple[int, int]]:
    """(edge, level) of INT*."""
    return host.model.log.of("int_n", since)


@verifies("P2104-PORT-01", "P2104-PORT-03")
def test_ac_01_reset_levels():
    host = Host()
    levels = {"int_n": 1, "pout_n": 3, "hold": 3, "dir": 0, "s1_n": 31, "s2_n": 31, "auxo": 3, "d_oe": 0}
    assert {name: host.model.outputs[name] for name in levels} == levels
    assert host.status() == 0 and host.read(0) == 0


@verifies("P2104-RD-01", "P2104-RD-04", "P2104-RD-05", "P2104-RD-06", "P2104-RD-07", "P2104-PHS-02")
@pytest.mark.parametrize("base", [0x80, 0xA0])
def test_ac_02_registers_after_reset(base):
    host = Host()
    script = " ".join(f"c {base + low:02X} {'rrr' if low == 3 else 'r'}" for low in (0, 1, 2, 3, 6))
    assert host.run(script) == [0, 0xCF, 0xFC, 0, 0, 0, 0]


@verifies("P2104-CMD-01", "P2104-CMD-03", "P2104-ERR-04")
@pytest.mark.parametrize("busc", [0, 1])
def test_ac_06_all_codes(busc):
    undefined = asking = refused = quiet = 0
    for code in range(256):
        host = Host(busc=busc)
        status = host.command(code)
        axis = code >> 5 & 1
        command = decode(code)
        if command.kind is Kind.UNDEFINED:
            undefined += 1
            expected = [1, 0]
        elif code >> 6 == 1 or (code >> 6 == 3 and code & 7 in (3, 6)):
            refused += 1
            expected = [4, 0]
        elif command.parameters:
            asking += 1
            assert status == 0x10 << axis, f"{code:02X}"
            continue
        else:
            quiet += 1
            expected = [0, 0]
        host.run("rrr" if code in (0x83, 0xA3) else "")
        assert host.run("e1 e2") == (
            expected[::-1] if axis and command.kind is not Kind.AUX_OUTPUT else expected
        )
    assert (undefined, refused, asking, quiet) == (107, 80, 52, 17)


@verifies("P2104-STA-05", "P2104-HSK-05")
@pytest.mark.parametrize("code, shown", [("02", 0x10), ("22", 0x20)])
def test_ac_07_cmnd(code, shown):
    host = Host()
    assert host.statuses(f"c {code} d 63 d 13 d 0A d 00") == [shown] * 5
    stored = host.written
    host.poll(0xFF, 0)
    assert host.t - stored <= 40_000


@verifies("P2104-INI-04", "P2104-RD-05")
def test_ac_08_pattern_after_setting():
    host = Host(B1)
    assert (host.out("s1_n"), host.out("s2_n")) == (0b11100, 0b11111)
    assert host.run("c 82 r") == [0x3C]


@verifies("P2104-END-01", "P2104-RD-03", "P2104-CMD-02")
def test_ac_16_17_end_interrupt():
    host = Host(B1 + " ready c 42 idle")
    host.pause(3)
    assert host.out("int_n") == 0
    rise = [t for t, level in host.model.bits("pout_n", 1) if level][-1]
    (low,) = [t for t, level in releases(host) if level == 0]
    assert 0 <= low - rise <= 4
    assert host.run("c 80 r") == [0x82] and host.out("int_n") == 1
    assert host.run("c 80 r") == [0x02]
    assert host.run("c 52 idle c 80 r") == [0x82] and len(releases(host)) == 2


@verifies("P2104-INT-01", "P2104-INT-02", "P2104-INT-03")
def test_ac_18_19_release_windows():
    host = Host(B1 + " ready " + B2 + " ready c 42 c 62 idle")
    host.pause(500)
    assert host.out("int_n") == 0
    (answer,) = host.run("c 80 r")
    host.pause(200)
    host.sync()
    (up, _), (down, _) = releases(host)[-2:]
    assert answer == 0x82 and down - up in HIGH
    assert host.run("c A0 r") == [0x82]
    host.pause(500)
    assert host.out("int_n") == 1

    host = Host(B1 + " ready " + B2 + " ready c 42 c 62 idle")
    host.pins(errint_n=0)
    host.run("c 87 c A7")
    since, answers = host.t, []
    for code in ("80", "86", "A6", "A0"):
        answers += host.run(f"c {code} r")
        host.pause(200)
    host.sync()
    assert answers == [0x82, 1, 1, 0x82]
    edges = releases(host, since)
    assert [level for _, level in edges] == [1, 0, 1, 0, 1, 0, 1]
    assert all(b[0] - a[0] in HIGH for a, b in zip(edges[::2], edges[1::2], strict=False))


@verifies("P2104-INT-04")
def test_ac_20_reads_that_clear_nothing():
    host = Host()
    host.pins(errint_n=0)
    host.run("c 87 c 80 r c A0 r c A6 r")
    assert [level for _, level in releases(host)] == [0]
    assert host.run("c 86 r") == [1] and host.out("int_n") == 1


@verifies("P2104-INT-01", "P2104-INT-02")
def test_ac_21_errint_is_looked_at_when_the_error_arises():
    host = Host("c 87")
    assert host.status() == 0x80 and host.out("int_n") == 1
    host.pins(errint_n=0)
    host.pause(100)
    assert host.out("int_n") == 1
    host.run("c 87")
    assert host.out("int_n") == 0
    host.pins(errint_n=1)
    host.pause(100)
    assert host.out("int_n") == 0


@verifies("P2104-AUX-02", "P2104-AUX-03")
def test_ac_56_auxiliary_pins():
    host = Host()
    levels = []
    for code in ("C1", "D1", "E1", "F1"):
        host.run(f"c {code}")
        levels.append(host.out("auxo"))
    assert levels == [3, 2, 1, 0]
    for level in (1, 2):
        host.pins(auxi=level)
        host.pause(4)
        assert host.run("c C2 r") == [level]


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
        """d_oe in a strobe with these levels, error after it (the byte is an undefined code)."""
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


@verifies("P2104-RD-04")
def test_ac_81_control_inputs():
    host = Host()
    got = []
    for pin in ("org_n", "alm_n", "fl_n", "fhl_n", "bl_n", "bhl_n"):
        host.pin(pin, 0)
        host.pause(4)
        got += host.run("c 81 r")
        host.pin(pin, 1)
    assert got == [0x4F, 0x8F, 0xC7, 0xCB, 0xCD, 0xCE]
    host.pins(**{pin: 1 for pin in ("org_n", "alm_n", "fl_n", "fhl_n", "bl_n", "bhl_n")})
    host.pause(4)
    assert host.run("c 81 r c A1 r") == [0xCF, 0x00]


@verifies("P2104-BAD-23")
def test_ac_78_reset_in_motion():
    host = Host(B1 + " ready " + B2 + " ready " + LONG + " c 65 d 31 c F1 c 84 d 40 d 40 c 85 d 05")
    host.fall(3, after=20)
    host.pins(rst_n=0)
    host.sync()
    expected = {"int_n": 1, "pout_n": 3, "hold": 3, "dir": 0, "s1_n": 31, "s2_n": 31, "auxo": 3, "d_oe": 0}
    assert {name: host.model.outputs[name] for name in expected} == expected
    host.pause(10)
    host.pins(rst_n=1)
    host.pause(5)
    assert host.status() == 0 and host.run("c 42 e1 c 80 r") == [4, 0]
    host.run(B1 + " ready c 42 idle")
    host.pause(60_000)
    host.sync()
    (low, _), (high, _) = [edge for edge in host.model.bits("hold", 1) if edge[0] > host.mark]
    pulse_end = [t for t, level in host.model.bits("pout_n", 1) if level][-1]
    assert 51_200 <= high - pulse_end <= 51_224 and low < pulse_end


def test_edges_are_ordered_and_single():
    host = Host(B1 + " ready " + B2 + " ready c 43 d 05 d 00 d 00 c 63 d 05 d 00 d 00 idle")
    edges: list[Edge] = host.model.edges
    assert all(a.t <= b.t for a, b in zip(edges, edges[1:], strict=False))
    assert len({(e.t, e.signal) for e in edges}) == len(edges)
