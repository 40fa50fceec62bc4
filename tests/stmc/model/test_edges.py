"""Cases on the golden model that no acceptance check of the RTL covers: all codes, both logics, all
switches.
"""

from __future__ import annotations

import pytest

from cocotb_tests.harness import verifies
from openppmc.model.motion.codes import Kind
from openppmc.model.motion.excitation import step_list
from openppmc.model.stmc.codes import decode
from openppmc.model.stmc.part import Stmc
from tests.stmc.model.host import EXT16, INTERNAL, STANDARD, SWITCHES, Host, count, init


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
        assert host.run("c 81 r") == [0xCF & ~(1 << bit)]
        host.pins(**{pin: 1})


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


@verifies("AC-14", "AC-15", "AC-16", "AC-17", "STMC-EXC-01", "STMC-EXC-04", "STMC-EXC-05")
@pytest.mark.parametrize("code, phases, half", [
    (0x1E, 4, True), (0x19, 3, False), (0x1D, 3, True), (0x1B, 5, False), (0x1F, 5, True), (0x1A, 4, False),
])  # fmt: skip
def test_excitation(code, phases, half):
    table = step_list(phases, half)
    for logic in (8, 0):
        host = Host(init(code & ~8 | logic, 20, 5, 8))
        mask = 0 if logic else 0b11111
        assert host.out("s") == table[0] ^ mask
        host.move("c 44 d 01 " + count(len(table) - 1))
        assert host.phases() == [f"{p ^ mask:05b}" for p in (*table[1:], table[0])]
        host.move("c 4C d 01 " + count(1))
        assert host.phases() == [f"{p ^ mask:05b}" for p in (table[-1], table[-2])]


@verifies("STMC-BAD-14")
def test_all_switches_active():
    host = Host()
    host.pins(l1_n=0, l2_n=0, l3_n=0, l4_n=0, cnp_n=0)
    for code, number in ((0x42, 2), (0x43, 3), (0x44, 4), (0x45, 5), (0x46, 6), (0x47, 7)):
        for ccw in (0, 8):
            data = {3: count(9), 4: "d 05 " + count(9), 5: "d 05", 7: "d 05"}.get(number, "")
            status, _ = host.move(f"c {code | ccw:02X} {data}")
            assert status == (0x9F if number == 7 else 0x90 | number) and host.pulses() == []


@verifies("STMC-DEC-03")
@pytest.mark.parametrize("stop", ["c 41", "l3_n"])
def test_request_in_the_first_levels_of_a_flat_start(stop):
    """If a level above 0 also has the divisor D1, a deceleration request at this level stops the motion
    immediately.
    """
    host = Host(init(0x1A, 10, 9, 16))
    host.start("c 43 " + count(99))
    host.in_gap(3)
    mark = host.mark
    if stop == "l3_n":
        host.pins(l3_n=0)
    else:
        host.command(0x41)
    host.mark = mark
    assert host.finish() == (0xC3 if stop == "c 41" else 0x8B, 99 - 4)
    assert host.gaps() == [10] * 3


@verifies("STMC-HLD-01", "STMC-HLD-02")
def test_hold_default():
    host = Host(STANDARD)
    host.move("c 42")
    fall = host.model.log.falls("int_n")[0]
    host.pause(560_000)
    host.sync()
    assert 544_000 <= host.model.log.rises("hold")[0] - fall <= 544_016
    assert EXT16 == 16
