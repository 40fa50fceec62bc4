"""Acceptance checks of the STMC that are about bytes, registers and the interrupt, on the golden model."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from openppmc.model.motion.codes import Kind
from openppmc.model.stmc.codes import decode
from openppmc.model.stmc.part import Stmc
from tests.stmc.model.host import INTERNAL, STANDARD, SWITCHES, Host, count, init


@verifies("AC-01", "STMC-ST-01", "STMC-FIN-01", "STMC-INP-01", "STMC-OUT-01", "STMC-REM-02")
def test_reset_values():
    host = Host("")
    assert dict(host.model.outputs) == {"d_o": 0, "d_oe": 0, "int_n": 1, "s": 0, "hold": 1}
    assert host.status() == 0
    assert host.run("c 80 r c 83 r c 82 r c 84 rrr") == [0x80, 0x04, 0xCF, 0, 0, 0]


@verifies("AC-02", "STMC-MOT-01", "STMC-STP-05")
def test_before_the_first_initialisation():
    host = Host("")
    assert host.statuses("c 42 c 40 d 55 c C0") == [0xA0, 0x80, 0xB0, 0x80]
    assert host.model.log.of("s") == []


@verifies("AC-03", "STMC-ST-02", "STMC-INI-06", "STMC-INI-08")
def test_initialisation_counts_down():
    host = Host("")
    assert host.statuses("c 0A d 14 d 05 d 08 d 00") == [0x40, 0x30, 0x20, 0x10, 0x00]
    assert host.out("s") == 0b00011 and not host.model.busy


@verifies("AC-04", "STMC-INI-05", "STMC-BAD-06")
def test_motor_type_00():
    host = Host("")
    assert host.statuses("c 08 d 14") == [0x80, 0xB0] and host.out("s") == 0
    assert host.statuses("c 42") == [0xA0]
    host.run(STANDARD)
    assert host.statuses("c 18 d 14") == [0x80, 0xB0]
    assert host.move("c 43 " + count(3)) == (0x83, 0) and host.gaps() == [20, 12, 20]


@verifies("AC-05", "STMC-MOT-08")
def test_normal_end():
    host = Host()
    host.start("c 43 d 13 d 00 d 00")
    host.idle()
    host.pause(5)
    assert host.out("int_n") == 0 and host.status() == 0
    assert host.finish() == (0x83, 0) and len(host.pulses()) == 20


@verifies("AC-18", "STMC-INI-04")
def test_second_initialisation_keeps_the_frozen_bits():
    host = Host()
    assert host.statuses("c 05 d 14 d 05 d 08 d 00")[-1] == 0
    host.move("c 42")
    assert host.phases() == ["00110"]
    host.move("c 44 d 03 " + count(2))
    assert host.intervals() == [3840, 3840]


@verifies("AC-20", "STMC-MOT-03", "STMC-BAD-07")
def test_divisor_0():
    host = Host()
    assert host.statuses("c 44 d 00 d 04 d 00 d 00") == [0x40, 0x30, 0x20, 0x10, 0xD0]
    assert host.statuses("c 45 d 00") == [0x10, 0xD0]
    assert host.statuses("c 47 d 00 d 01") == [0x10, 0xD0, 0xB0]
    assert host.finish() == (0x80, 0) and host.pulses()[:-1] == []


@verifies("AC-31", "STMC-MOT-05", "STMC-SGL-02", "STMC-MOT-10")
def test_start_against_a_limit():
    host = Host()
    host.pins(l1_n=0)
    host.pause(5_000)
    host.start("c 42")
    risen = host.written - 2
    host.idle()
    assert host.model.log.falls("int_n")[0] - risen <= 24
    assert host.finish() == (0x92, 0) and host.pulses() == [] and host.out("int_n") == 1
    assert host.move("c 43 " + count(5)) == (0x93, 5) and host.pulses() == []
    assert host.move("c 4A") == (0x82, 0) and len(host.pulses()) == 1


@verifies("AC-34", "STMC-IN-05")
def test_motor_off():
    host = Host()
    host.start("c 44 d 0A " + count(0x63))
    host.in_gap(9)
    host.pins(mon=0)
    assert host.finish() == (0xA4, 99 - 10)
    assert host.move("c 42") == (0xA2, 0) and host.pulses() == []
    assert host.run("c 82 r") == [0x8F]


@verifies("AC-35", "STMC-FIN-05", "STMC-MOT-09", "STMC-MOT-10")
def test_interrupt():
    host = Host()
    host.move("c 53 " + count(0))
    assert host.model.log.of("int_n") == []
    host.run("c 43 " + count(0) + "idle")
    host.run("c 42 idle")
    assert host.out("int_n") == 0
    host.status()
    assert host.out("int_n") == 0
    host.command(0x80)
    assert host.out("int_n") == 1 and host.fetch() == 0x82


@verifies("AC-36", "STMC-FSM-01", "STMC-FSM-02", "STMC-RD-01", "STMC-BAD-17")
def test_bytes_during_a_move():
    host = Host()
    host.start("c 43 " + count(99))
    mark = host.mark
    codes = host.statuses("c 80 c 0A c C0 c 42 d 00")
    assert codes == [0x94, 0x94, 0x84, 0x94, 0xE4]
    host.mark = mark
    assert host.finish() == (0x83, 0) and len(host.pulses()) == 100


@verifies("AC-37", "AC-51", "STMC-CMD-01", "STMC-BAD-11", "STMC-BUS-22")
def test_half_read_answer():
    host = Host()
    assert host.run("c 84 r c 82 r") == [0, 0xCF]
    assert host.status() == 0 and host.read(0) == 0xCF
    host.start("c 43 " + count(99))
    host.in_gap(10)
    host.run("c 40 idle")
    assert host.run("c 84 r c 42 idle rr") == [0x58, 0, 0] and host.status() & 1 == 0


@verifies("AC-38", "STMC-BAD-04", "STMC-CMD-01", "STMC-BAD-02", "STMC-BAD-03")
def test_command_instead_of_data():
    host = Host()
    host.start("c 43 d 05 c 42")
    host.idle()
    assert len(host.model.log.of("s", host.mark)) == 1
    assert host.statuses("d 00") == [0xB0]


@verifies("AC-39", "STMC-INI-02", "STMC-BAD-05")
@pytest.mark.parametrize("d1, d2", [(5, 20), (0, 0), (20, 0), (0, 5), (254, 255)])
def test_refused_divisors(d1, d2):
    host = Host()
    host.run(init(0x1A, d1, d2, 8))
    assert host.status() == 0xD0
    host.move("c 43 " + count(3))
    assert host.gaps() == [20, 12, 20]
    host = Host(init(0x1A, d1, d2, 8))
    assert host.statuses("c 42") == [0xA0] and host.out("s") == 0


@verifies("AC-40", "STMC-INI-07", "STMC-BUS-14", "STMC-BAD-09", "STMC-FSM-03")
def test_bytes_meet_the_table_build():
    host = Host()
    host.run(init(0x1A, 255, 5, 400))
    host.write(1, 0x40, gap=12)
    host.write(1, 0x80)
    assert host.poll(2, 0) == 0x01 and host.fetch() == 0x80
    host.move("c 43 " + count(3))
    assert host.gaps()[0] == 255


@verifies("AC-43", "STMC-RUN-01")
def test_bit_5_of_a_motion_byte():
    host = Host()
    assert host.move("c 63 " + count(0)) == (0x83, 0) and host.phases() == ["00110"]


@verifies("AC-44", "AC-45", "STMC-BAD-01")
def test_read_maps():
    family = Host(read_map="FAMILY")
    assert family.run("c 81 r c 82 r c 83 rrr") == [0xCF, 0xC4, 0, 0, 0]
    assert family.statuses("c 84") == [0x80]
    sheet = Host()
    assert sheet.statuses("c 81") == [0x80] and sheet.run("c 84 rrr") == [0, 0, 0]


@verifies("AC-49", "STMC-BAD-16")
def test_reset_in_motion():
    host = Host()
    host.start("c 43 " + count(99))
    host.in_gap(5)
    host.model.pins(host.t, rst_n=0)
    host.model.run_until(host.t)
    assert dict(host.model.outputs) | {"d_o": 0} == {"d_o": 0, "d_oe": 0, "int_n": 1, "s": 0, "hold": 1}
    assert not host.model.busy
    host.model.pins(host.t + 5, rst_n=1)
    host.pause(12)
    assert host.statuses("c 42") == [0xA0] and host.finish() == (0x80, 0)


@verifies("STMC-BAD-01", "STMC-MOT-01")
def test_every_code():
    data = {"init": 4, 3: 3, 4: 4, 5: 1, 7: 1}
    for read_map, reads in (("SHEET", {0x80, 0x82, 0x83, 0x84}), ("FAMILY", {0x80, 0x81, 0x82, 0x83})):
        for code in range(256):
            command = decode(code, read_map)
            if code < 0x40:
                known, bytes_ = code & 3 != 0, 4
            elif code < 0x80:
                known, bytes_ = True, data.get(code & 7, 0)
                assert (command.kind is Kind.OPERATION) == (code & 7 > 1)
            else:
                known, bytes_ = code in reads, 0
            assert (command.kind is not Kind.UNDEFINED) == known
            assert not known or command.parameters == bytes_
    with pytest.raises(ValueError, match="256"):
        decode(256)


@verifies("STMC-INP-01")
def test_inputs_one_by_one():
    host = Host(INTERNAL)
    for pin, bit in zip(SWITCHES, (3, 2, 1, 0, 7, 6), strict=True):
        host.pins(**{pin: 0})
        host.pause(4)
        assert host.run("c 82 r") == [0xCF & ~(1 << bit)]
        host.pins(**{pin: 1})


@verifies("AC-52", "STMC-BUS-06", "STMC-BAD-12")
def test_both_strobes():
    host = Host()
    before = host.status()
    since = host.t
    host.model.pins(host.t, cs_n=0, rd_n=0, wr_n=0, a0=1, d_i=0x42)
    host.model.pins(host.t + 10, cs_n=1, rd_n=1, wr_n=1)
    host.pause(40)
    host.sync()
    assert [e for e in host.model.edges if e.t >= since and e.signal != "s"] == []
    assert host.status() == before


def test_model_refuses_nonsense():
    for wrong in (
        {"timing": "fast"},
        {"phase_idle": 2},
        {"clk_hz": 1},
        {"xtal_hz": 20_000_001},
        {"read_map": "sheet"},
        {"chop_on_xt": 0},
        {"hold_xt": 0},
    ):
        with pytest.raises(ValueError):
            Stmc(**wrong)
    assert Stmc(xtal_hz=20_000_000, phase_idle=1).outputs["s"] == 0b11111
