"""Acceptance checks of the host side, initialisation and registers, on the golden model at pin level."""

from __future__ import annotations

import pytest

from openppmc.model.motion.excitation import step_list
from openppmc.model.single.codes import Kind, decode
from tests.ppmc104.model.host import INIT_A, ModelHost


def test_ac_01_reset_levels():
    host = ModelHost()
    expected = {"int_n": 1, "pout_n": 1, "hold": 1, "dir": 0, "aux_n": 1, "auxo": 15, "s": 31, "d_oe": 0}
    assert {name: host.out(name) for name in expected} == expected
    assert (host.read(1), host.read(0)) == (0, 0)


def test_ac_02_read_strobe_windows():
    host = ModelHost()
    start = host.t
    host.model.read(start, 1, strobe=6)
    host.model.run_until(start + 12)
    (on, one), (off, zero) = host.model.log.of("d_oe", start)
    assert (one, zero) == (1, 0)
    assert on - start <= 2 and 0 <= off - (start + 6) <= 2
    assert all(t <= start + 2 for t, _ in host.model.log.of("d_o", start))


def test_ac_03_errors_before_initialisation():
    host = ModelHost()
    assert host.statuses("c 42 c 40 c 41 c 46 c C3 d 00") == [0xA0, 0x80, 0x80, 0xA0, 0xA0, 0xB0]
    assert host.pulses() == [] and host.out("hold") == 1


def test_ac_04_all_codes_after_reset():
    undefined = [code for code in range(256) if decode(code).kind is Kind.UNDEFINED]
    assert len(undefined) == 97
    plain = {Kind.EXCITATION_OFF: 0, Kind.AUX_ON: 0, Kind.AUX_OFF: 0, Kind.INITIALISE: 0x40}
    plain |= {Kind.SWITCHING: 0x20, Kind.AUX_OUTPUT: 0x10, Kind.READ: 0x01, Kind.OPERATION: 0xA0}
    plain |= {Kind.STOP: 0x80, Kind.SLOW_STOP: 0x80, Kind.UNDEFINED: 0x80}
    for code in range(256):
        assert ModelHost().command(code) == plain[decode(code).kind], hex(code)


def test_ac_05_parameter_count():
    assert ModelHost().statuses(INIT_A) == [0x40, 0x30, 0x20, 0x10, 0x00]


def test_ac_06_07_08_output_register():
    host = ModelHost()
    assert host.run(INIT_A + " c 82 r") == [0xC4] and host.out("s") == 0b00011
    host = ModelHost()
    assert host.run("c 02 d 09 d 04 d 04 d 00 c 82 r") == [0x3C] and host.out("s") == 0b11100
    assert ModelHost().run("c 82 r c 81 r c 80 r") == [0xFC, 0xCF, 0x00]


def test_ac_36_37_commands_during_a_move():
    host = ModelHost()
    host.run(INIT_A + " c 44 d 63 d 27 d 00 d 00")
    mark = host.mark
    expected = [0x94, 0x94, 0x94, 0x94, 0x94, 0x84, 0xE4]
    assert host.statuses("c 80 c 44 c 0A c 84 c 85 c 87 d 11") == expected
    assert host.statuses("c 86 d 05 c C1") == [0x14, 0x04, 0x04]
    assert (host.out("auxo"), host.out("aux_n")) == (0b1010, 0)
    assert host.statuses("c C2") == [0x04] and host.out("aux_n") == 1
    assert host.statuses("c C0") == [0x04] and host.out("aux_n") == 0
    host.idle()
    host.mark = mark
    assert host.intervals() == [3200] * 39
    assert host.statuses("c 42") == [0x04]


def test_ac_38_auxiliary_io():
    host = ModelHost()
    host.run("c 86 d FF")
    assert host.out("auxo") == 0
    host.run("c 86 d A0")
    assert host.out("auxo") == 15
    host.pins(auxi=0b1001)
    host.pause(4)
    assert host.run("c 85 r") == [0x09]


def test_ac_39_command_cancels_parameters():
    host = ModelHost()
    host.run(INIT_A + " c 43 d 09")
    assert host.run("c 81 r") == [0xCF]
    assert host.statuses("d 00") == [0xB0]
    host.pause(2000)
    host.sync()
    assert host.model.pulses == []


def test_ac_40_new_read_drops_the_queue():
    host = ModelHost()
    host.run(INIT_A + " c 44 d 63 d E7 d 03 d 00")
    host.fall(10, 400)
    host.run("c 40")
    host.idle()
    assert host.run("c 80 r c 83 r c 80 r") == [0xC4, 0xDD, 0x44]
    assert host.read(0) == 0x44 and host.read(1) == 0


def test_ac_41_refused_initialisations_change_nothing():
    host = ModelHost()
    host.run(INIT_A)
    bad = {"05 06 64 00": 0xD0, "09 04 03 00": 0xD0, "09 04 D5 2B": 0xC0, "05 06 D5 2B": 0xC0}
    for values, status in bad.items():
        script = "c 0A " + " ".join(f"d {byte}" for byte in values.split())
        assert host.statuses(script)[-1] == status
    host.run("c 43 d 0D d 00 d 00")
    host.idle()
    assert host.intervals() == [320, 256, 192, 192, *[160] * 5, 192, 192, 256, 320]


def test_ac_42_corner_initialisations():
    host = ModelHost()
    for values in ("09 04 04 00", "09 04 D4 2B", "FF 00 04 00", "0A 0A 04 00"):
        assert host.statuses("c 0A " + " ".join(f"d {b}" for b in values.split()))[-1] == 0
        assert host.poll(2, 0) == 0
    host.run("c 43 d 0B d 00 d 00")
    host.idle()
    assert host.intervals() == [352] * 11


def test_ac_43_type_is_frozen_until_excitation_off():
    host = ModelHost()
    other = "c 0F d 09 d 04 d 04 d 00"
    host.run(INIT_A + " " + other)
    assert host.out("s") == 0b00011

    def step() -> int:
        host.run("c 42")
        host.idle()
        return host.out("s")

    assert step() == 0b00110
    host.run("c C0")
    host.pause(4)
    assert host.out("s") == 0
    assert host.statuses("c 42") == [0xA0]
    host.run(other)
    assert host.out("s") == 0b00011
    assert [step() for _ in range(3)] == [0b00111, 0b00110, 0b01110]


@pytest.mark.parametrize("code", [0x09, 0x0D, 0x0A, 0x0E, 0x0B, 0x0F, 0x01, 0x05, 0x02, 0x06, 0x03, 0x07])
def test_ac_44_all_step_tables(code):
    host = ModelHost()
    host.run(f"c {code:02X} d 09 d 04 d 04 d 00")
    steps = step_list((code & 3) + 2, bool(code & 4))
    invert = 0 if code & 8 else 31
    walk = [i for i in range(1, 2 * len(steps) + 1)]
    for direction, indices in ((0x42, walk), (0x4A, [-i for i in walk])):
        for index in indices:
            host.run(f"c {direction:02X}")
            host.idle()
            assert host.out("s") == steps[index % len(steps)] ^ invert
            assert host.out("dir") == direction >> 3 & 1


def test_ac_52_datasheet_initialisation_closes_the_mailbox():
    host = ModelHost(timing="DATASHEET")
    for byte in (9, 4, 4, 0):
        if byte == 9:
            host.command(0x0A)
        event = host.write(0, byte)
        host.pause(8)
    host.write(1, 0xC1, gap=8)
    host.write(1, 0xC2)
    while host.t < event + 263_990:
        assert host.read(1) & 6 == 2
        host.pause(5000 if host.t < event + 258_000 else 10)
    host.go(event + 264_400)
    assert host.read(1) == 0
    host.sync()
    assert host.model.log.of("aux_n") == []


def test_ac_57_reset_in_mid_motion():
    host = ModelHost()
    host.run(INIT_A + " c 46")
    host.fall(6, 30)
    t = host.t
    host.pins(rst_n=0)
    assert host.model.log.of("s", t) == [(t, 31)] and host.model.log.of("hold", t) == [(t, 1)]
    assert host.model.log.of("pout_n", t) == [(t, 1)]
    host.pause(10)
    host.pins(rst_n=1)
    host.pause(4)
    assert host.statuses("c 42") == [0xA0]
    host.pause(10_000)
    host.sync()
    assert host.model.log.falls("pout_n", t) == []


def test_ac_58_both_strobes_low():
    host = ModelHost()
    t = host.t
    host.model.pins(t, cs_n=0, rd_n=0, wr_n=0, a0=1, d_i=0x42)
    host.model.pins(t + 10, cs_n=1, rd_n=1, wr_n=1)
    host.t = t + 30
    assert host.read(1) == 0
    assert [edge for edge in host.model.log.of("d_oe") if edge[0] < t + 30] == []
