"""Acceptance checks of the PPMC-312: registers, blocks, settings, monitors, terminals."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import (
    CSR,
    DRR,
    DWR,
    MREF,
    MWEF,
    RAR,
    RATES,
    RCR,
    T1,
    T3,
    TF,
    WAR,
    WCR,
    Host,
)
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code
from openppmc.model.ppmc312.pins import OUTPUTS


@verifies("P312-CHK-01", "P312-PAR-01", "P312-PRT-02")
def test_reset_values() -> None:
    host = Host()
    assert host.model.log.initial == OUTPUTS
    assert [edge for edge in host.model.edges if edge.signal == "out_oe"] == [(3, "out_oe", 1)]
    assert (host.read(CSR), host.read(RAR)) == (0x04, 0x40)
    assert {name: host.out(name) for name in OUTPUTS if name not in ("d_o", "out_oe")} == {
        name: level for name, level in OUTPUTS.items() if name not in ("d_o", "out_oe")
    }


@verifies("P312-CHK-02", "P312-PAR-02")
def test_interrupt_levels() -> None:
    host = Host()
    host.write(CSR, 0xFF)
    assert host.read(CSR) == 0x74
    host.pause(8)
    assert host.out("irq_n") == 0
    host.write(CSR, 0x10)
    host.pause(8)
    assert host.out("irq_n") == 1
    host.issue(message(Code.VERSION))
    host.wait()
    assert host.out("irq_n") == 0
    for _ in range(3):
        host.read(DRR)
        assert host.out("irq_n") == 0
    host.read(DRR)
    host.pause(8)
    assert host.out("irq_n") == 1


@verifies("P312-CHK-03", "P312-PAR-07", "P312-BAD-08")
def test_read_window() -> None:
    host = Host()
    host.issue(message(Code.VERSION))
    host.wait()
    assert host.read(RAR) == 0x3C
    assert [host.read(DRR) for _ in range(2)] == [0x12, 0x40]
    assert host.read(RAR) == 0x3E
    assert host.read(RCR) == 0
    assert host.read(RAR) == 0x3C
    assert bytes(host.read(DRR) for _ in range(4))[::-1].hex() == "03024012"
    assert host.read(RAR) == 0x40 and host.read(DRR) == 0 and host.read(CSR) & MREF


@verifies("P312-CHK-04", "P312-CHK-05", "P312-CHK-06")
def test_states_and_lengths() -> None:
    host = Host()
    assert host.ask(message(Code.STEP, "00")) == message(Answer.STATUS, "00 01")
    assert host.ask(T1) == message(Code.INITIAL)
    assert host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")
    assert host.ask(message(Code.INITIAL, "01 03 E8 00 C8 00 07")) == message(
        Answer.PARAMETER, "00 00 01 03 E8 00 C8 00 07"
    )
    assert host.condition == 0x01
    host.pause(10_000)
    assert host.pulses() == []


@pytest.mark.parametrize(
    ("number", "setting"),
    [
        ("01", "01 03E8 0001 0007D0"),
        ("01", "01 0010 0002 0007D0"),
        ("01", "01 FFFF FFF0 0007D0"),
        ("05", "01 03E8 00C8 000476"),
        ("02", "01 03E8 0369 0007D0"),
        ("03", "01 03E8 03E8 0007D0"),
        ("04", "11 03E8 0147 00C8 0007D0 0007D0"),
        ("00", "11 03E8 00C8 0007D0"),
    ],
)
@verifies("P312-CHK-07", "P312-CHK-08")
def test_initial_errors(number: str, setting: str) -> None:
    host = Host(T1)
    data = bytes.fromhex(setting)
    answer = host.ask(message(Code.INITIAL, f"{data.hex()}"))
    assert answer == f"03 {len(data) + 3:02X} F0 {number} 00 {data.hex(' ').upper()}"
    assert host.condition == 0x01


@verifies("P312-CHK-09", "P312-CHK-11")
def test_table_read() -> None:
    for setting, count, first in (
        (T1, 55, "02 0A 41 7F 7F 00 00 07 D0 00 07 D0"),
        (T3, 79, "02 0A 41 7F 7F 60 00 07 D0 00 05 DC"),
    ):
        host = Host(setting)
        assert host.ask(message(Code.TABLE_READ)) == first
        blocks = []
        for left in range(count - 1, 0, -1):
            host.wait()
            assert bool(host.read(CSR) & MWEF) == (left > 1)
            blocks.append(host.response())
        assert [block[:2] for block in blocks] == ["00"] * (count - 2) + ["01"]
        assert host.quiet() and host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")


@verifies("P312-CHK-12")
def test_free_curve() -> None:
    host = Host(T1)
    assert host.ask(TF[0]) == message(Code.FREE_CURVE, "00 03")
    assert host.condition == 0x01
    assert host.ask(TF[1]) == message(Code.FREE_CURVE, "01 03")
    assert host.ask(TF[2]) == message(Code.FREE_CURVE, "0F 00 00 0C 00 00 0C")
    assert host.condition == 0x02


@pytest.mark.parametrize(
    ("number", "blocks"),
    [
        ("17", (TF[0], TF[1], "00 09 000005 000004 000003")),
        ("18", (TF[0], "00 06 0064 0001 0190")),
        ("19", (TF[0], TF[1], "01 09 000005 000001 000003")),
        ("11", ("02 03 01 01 01",)),
        ("11", ("02 03 01 01 80",)),
        ("11", ("02 02 01 01",)),
        ("10", (message(Code.FREE_CURVE, "01 03"),)),
        ("10", (message(Code.FREE_CURVE, "01"),)),
        ("16", (TF[0], "00 05 0064 00C8 01")),
        ("16", (TF[0], "00 05 0064 00C8")),
        ("15", (TF[0], "00 1F 0064 00C8")),
    ],
)
@verifies("P312-CHK-13", "P312-BAD-04", "P312-BAD-11")
def test_free_curve_errors(number: str, blocks: tuple[str, ...]) -> None:
    host = Host(T1, *blocks[:-1])
    echo = bytes.fromhex(blocks[-1])[2:]
    assert host.ask(blocks[-1]) == f"03 {len(echo) + 2:02X} F0 {number} {echo.hex(' ').upper()}"
    assert host.condition == 0x01
    assert host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    assert host.ask(RATES) == message(Answer.STATUS, "01 01")


@verifies("P312-CHK-14")
def test_instruction_inside_a_transfer() -> None:
    host = Host(TF[0])
    assert host.ask(message(Code.VERSION)) == message(Answer.STATUS, "02 01")
    assert host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    host = Host(TF[0])
    assert host.ask(message(Code.RESET)) == message(Code.RESET)
    assert host.ask(TF[1]) == message(Answer.STATUS, "01 01")


@verifies("P312-CHK-18")
def test_parameter_errors() -> None:
    host = Host(*TF)
    for data, number in (("00 0063 0000001E", 0x20), ("00 0191 0000001E", 0x20), ("00 0000 00000000", 0x23)):
        assert host.ask(message(Code.RAMP, data)).startswith(f"03 0A F0 {number:02X} 82")
    for block, number in (
        (message(Code.ORIGIN_SEARCH, "00 0000"), 0x20),
        (message(Code.SPEED_LIMIT, "0001"), 0x20),
        (message(Code.END_TERMINAL, "02"), 0x23),
        (message(Code.POSITION_READ, "02"), 0x23),
        (message(Code.POSITION_SET, "02 00000000"), 0x23),
        (message(Code.EVENT_READ, "02"), 0x24),
        (message(Code.IN_POSITION, "01 0000"), 0x26),
        (message(Code.ENCODE, "01 0000"), 0x27),
        (message(Code.STEP), 0x23),
        (message(Code.EVENT_SET, "00 03 01"), 0x25),
        (message(Code.EVENT_SET), 0x25),
        (message(Code.EVENT_SET, "02 00"), 0x25),
    ):
        assert host.ask(block).split()[2:4] == ["F0", f"{number:02X}"], block
    assert host.ask(message(Code.IN_POSITION, "00 0000")) == message(Code.IN_POSITION)
    assert host.condition == 0x02


@verifies("P312-CHK-51", "P312-BAD-05", "P312-BAD-06")
def test_bad_blocks() -> None:
    host = Host(T1)
    assert host.ask("03 02 40") == message(Answer.SIZE, "02")
    assert host.ask("03 00 40") == message(Answer.SIZE, "00")
    assert host.ask("07 01 40") == message(Answer.STATUS, "01 02")
    assert host.ask("02 01 40") == message(Answer.STATUS, "01 02")
    assert host.ask("03 01 46") == message(Answer.COMMAND, "46")
    host.mark = host.t
    host.put("03")
    assert host.response() == message(Answer.SIZE, "00")
    long = "03 1F" + " 40" * 30
    assert host.ask(long) == message(Answer.SIZE, "1F")


@verifies("P312-CHK-52", "P312-BAD-02", "P312-BAD-03", "P312-BAD-07", "P312-BAD-10")
def test_write_window() -> None:
    host = Host()
    host.write(WCR, 0x00)
    host.write(WAR, 0x1D)
    for byte in (0x40, 0x01, 0x03):
        host.write(DWR, byte)
    assert host.quiet() and not host.read(CSR) & MWEF
    host.write(WCR, 0x20)
    host.write(WAR, 0x20)
    host.write(DWR, 0x03)
    host.write(WAR, 0x1C)
    host.write(DWR, 0x99)
    assert host.quiet() and not host.read(CSR) & MWEF
    assert host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    host.write(DWR, 0x03)
    assert host.quiet()
    host.model.pins(host.t, cs_n=0, we_n=0, oe_n=0, rs=CSR, d_i=0x70)
    host.model.pins(host.t + 6, cs_n=1, we_n=1, oe_n=1)
    host.t += 12
    assert not host.model.log.rises("d_oe", host.t - 12) and host.read(CSR) == 0x04


@verifies("P312-BAD-01")
def test_unused_registers() -> None:
    host = Host()
    for reg in (1, 4, 6):
        host.write(reg, 0x55)
        assert host.read(reg) == 0
    assert host.read(5) == 0


@verifies("P312-CHK-53", "P312-PAR-12")
def test_wait_request() -> None:
    host = Host(timing="DATASHEET")
    host.write(CSR, 0x40)
    host.mark = host.t
    host.put(message(Code.VERSION))
    host.pause(20)
    low, high = host.model.log.of("wrq_n", host.mark)
    second, third = host.header - 6, host.header
    assert (low[1], high[1]) == (0, 1)
    assert low[0] - (second - 3) in range(0, 5) and high[0] - third in range(0, 13)
    assert host.response() == message(Code.VERSION, "12")


@verifies("P312-CHK-39", "P312-RSP-20")
def test_two_instructions_without_reading() -> None:
    host = Host(T1)
    host.issue(message(Code.VERSION))
    host.pause(200)
    host.issue(message(Code.OUTPUT, "3F"))
    assert host.response() == message(Code.VERSION, "12")
    assert host.response() == message(Answer.ALARM, "01", source=SPONTANEOUS)
    assert host.condition == 0x10 and host.out("auxo_n") == 0x3F
    assert host.quiet()


@verifies("P312-CHK-37", "P312-CHK-38", "P312-INP-33")
def test_alarm_clear_waits_for_the_pin() -> None:
    host = Host(T1)
    host.pins(alm_n=0)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert host.ask(message(Code.ALARM_CLEAR)) == message(Code.ALARM_CLEAR)
    host.pause(160_000)
    assert host.condition == 0x10
    host.pins(alm_n=1)
    host.pause(10)
    assert host.condition == 0x02
    host.pins(alm_n=0)
    assert host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    host.ask(message(Code.ALARM_CLEAR))
    host.pause(400_000)
    host.pins(alm_n=1)
    host.pause(1000)
    assert host.condition == 0x10
    host.ask(message(Code.ALARM_CLEAR))
    assert host.condition == 0x02
    host.pause(400_000)
    low, high = host.model.log.of("aclr_n")[-2:]
    assert (low[1], high[1], high[0] - low[0]) == (0, 1, 393_216)


@verifies("P312-CHK-62")
def test_software_reset() -> None:
    host = Host(T1, message(Code.POSITION_SET, "00 00000007"), message(Code.OUTPUT, "3F"))
    host.write(CSR, 0x70)
    assert host.ask(message(Code.RESET)) == message(Code.RESET)
    assert host.read(CSR) == 0x04 and host.condition == 0x01 and host.model.position == 0
    assert host.out("auxo_n") == 0x3F and host.out("out_oe") == 1
    assert host.model.log.of("out_oe") == [(3, 1)]


@verifies("P312-CHK-62", "P312-BAD-09")
def test_reset_recovers_a_host_that_never_read() -> None:
    host = Host(T1)
    for _ in range(4):
        host.issue(message(Code.VERSION))
        host.pause(200)
    host.issue(message(Code.RESET))
    host.pause(500)
    assert host.response() == message(Code.RESET) and host.quiet() and host.condition == 0x01


@verifies("P312-CMD-22")
def test_counter_clear_restarts() -> None:
    host = Host(message(Code.COUNTER_CLEAR))
    host.pause(100_000)
    host.ask(message(Code.COUNTER_CLEAR))
    again = host.t
    host.pause(400_000)
    (low, high) = host.model.log.of("cclr_n")
    assert high[0] - again - 393_216 in range(-60, 10) and high[0] - low[0] > 450_000


def test_terminals() -> None:
    host = Host()
    assert host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, "FF E0")
    host.pins(fl_n=0, org_n=0, run=0, evt1_n=0)
    assert host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, "ED 40")
    assert host.ask(message(Code.EXCITATION_ON)) == message(Code.EXCITATION_ON) and host.out("exon_n") == 0
    assert host.ask(message(Code.EXCITATION_OFF)) == message(Code.EXCITATION_OFF) and host.out("exon_n") == 1
    assert host.ask(message(Code.ZERO_CLAMP)) == message(Code.ZERO_CLAMP) and host.out("zclmp_n") == 0
    assert host.ask(message(Code.TABLE_READ)) == message(Answer.STATUS, "00 01")


def test_serial_mode_is_silent_on_the_bus() -> None:
    model_host = Host()
    model = model_host.model
    model.pins(model_host.t, rst_n=0, mode=0)
    model.pins(model_host.t + 20, rst_n=1)
    model_host.t += 100
    model_host.mark = model_host.t
    model_host.put(message(Code.VERSION))
    assert model_host.read(CSR) == 0
    assert not model.log.rises("d_oe", model_host.mark)
