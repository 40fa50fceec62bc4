"""Acceptance checks of the PPMC-312: registers, blocks, settings, monitors, terminals."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import D16, directed
from cocotb_tests.harness.bus import CSR, DRR, DWR, MREF, MWEF, RAR, RCR, WAR, WCR
from cocotb_tests.ppmc312.blocks import RATES, T1, T3, TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import OUTPUTS, SPONTANEOUS, Answer, Code


@directed("P312-CHK-01", "P312-PAR-01", "P312-PRT-02")
async def p312_reset_values(dut: Any) -> None:
    host = await Host.start(dut)
    assert host.bench.initial == OUTPUTS
    assert host.bench.edges("out_oe") == [(3, 1)]
    assert (await host.read(CSR), await host.read(RAR)) == (0x04, 0x40)
    assert {name: host.out(name) for name in OUTPUTS if name not in ("d_o", "out_oe")} == {
        name: level for name, level in OUTPUTS.items() if name not in ("d_o", "out_oe")
    }


@directed("P312-CHK-02", "P312-PAR-02")
async def p312_interrupt_levels(dut: Any) -> None:
    host = await Host.start(dut)
    await host.write(CSR, 0xFF)
    assert await host.read(CSR) == 0x74
    await host.pause(8)
    assert host.out("irq_n") == 0
    await host.write(CSR, 0x10)
    await host.pause(8)
    assert host.out("irq_n") == 1
    await host.issue(message(Code.VERSION))
    await host.wait()
    assert host.out("irq_n") == 0
    for _ in range(3):
        await host.read(DRR)
        assert host.out("irq_n") == 0
    await host.read(DRR)
    await host.pause(8)
    assert host.out("irq_n") == 1


@directed("P312-CHK-03", "P312-PAR-07", "P312-BAD-08")
async def p312_read_window(dut: Any) -> None:
    host = await Host.start(dut)
    await host.issue(message(Code.VERSION))
    await host.wait()
    assert await host.read(RAR) == 0x3C
    assert [await host.read(DRR) for _ in range(2)] == [0x12, 0x40]
    assert await host.read(RAR) == 0x3E
    assert await host.read(RCR) == 0
    assert await host.read(RAR) == 0x3C
    assert bytes([await host.read(DRR) for _ in range(4)])[::-1].hex() == "03024012"
    assert await host.read(RAR) == 0x40 and await host.read(DRR) == 0 and await host.read(CSR) & MREF


@directed("P312-CHK-04", "P312-CHK-05", "P312-CHK-06")
async def p312_states_and_lengths(dut: Any) -> None:
    host = await Host.start(dut)
    assert await host.ask(message(Code.STEP, "00")) == message(Answer.STATUS, "00 01")
    assert await host.ask(T1) == message(Code.INITIAL)
    assert await host.ask(message(Code.STATUS)) == message(Code.STATUS, "00 02 00")
    assert await host.ask(message(Code.INITIAL, "01 03 E8 00 C8 00 07")) == message(
        Answer.PARAMETER, "00 00 01 03 E8 00 C8 00 07"
    )
    assert host.condition == 0x01
    await host.pause(10_000)
    assert host.pulses() == []


@cocotb.parametrize(
    case=[
        ("01", "01 03E8 0001 0007D0"),
        ("01", "01 0010 0002 0007D0"),
        ("01", "01 FFFF FFF0 0007D0"),
        ("05", "01 03E8 00C8 0002F9"),
        ("02", "01 03E8 0369 0007D0"),
        ("03", "01 03E8 03E8 0007D0"),
        ("04", "11 03E8 0147 00C8 0007D0 0007D0"),
        ("00", "11 03E8 00C8 0007D0"),
    ]
)
@directed("P312-CHK-07", "P312-CHK-08")
async def p312_initial_errors(dut: Any, case: Any) -> None:
    number, setting = case
    host = await Host.start(dut, T1)
    data = bytes.fromhex(setting)
    answer = await host.ask(message(Code.INITIAL, f"{data.hex()}"))
    assert answer == f"03 {len(data) + 3:02X} F0 {number} 00 {data.hex(' ').upper()}"
    assert host.condition == 0x01


@directed("P312-CHK-09", "P312-CHK-11")
async def p312_table_read(dut: Any) -> None:
    for setting, count, first in (
        (T1, 55, "02 0A 41 7F 7F 00 00 07 D0 00 07 D0"),
        (T3, 79, "02 0A 41 7F 7F 60 00 07 D0 00 05 DC"),
    ):
        host = await Host.start(dut, setting)
        assert await host.ask(message(Code.TABLE_READ)) == first
        blocks = []
        for left in range(count - 1, 0, -1):
            await host.wait()
            assert bool(await host.read(CSR) & MWEF) == (left > 1)
            blocks.append(await host.response())
        assert [block[:2] for block in blocks] == ["00"] * (count - 2) + ["01"]
        assert await host.quiet() and await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")


@directed("P312-CHK-12")
async def p312_free_curve(dut: Any) -> None:
    host = await Host.start(dut, T1)
    assert await host.ask(TF[0]) == message(Code.FREE_CURVE, "00 03")
    assert host.condition == 0x01
    assert await host.ask(TF[1]) == message(Code.FREE_CURVE, "01 03")
    assert await host.ask(TF[2]) == message(Code.FREE_CURVE, "0F 00 00 0C 00 00 0C")
    assert host.condition == 0x02


@cocotb.parametrize(
    case=[
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
    ]
)
@directed("P312-CHK-13", "P312-BAD-04", "P312-BAD-11")
async def p312_free_curve_errors(dut: Any, case: Any) -> None:
    number, blocks = case
    host = await Host.start(dut, T1, *blocks[:-1])
    echo = bytes.fromhex(blocks[-1])[2:]
    assert await host.ask(blocks[-1]) == f"03 {len(echo) + 2:02X} F0 {number} {echo.hex(' ').upper()}"
    assert host.condition == 0x01
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    assert await host.ask(RATES) == message(Answer.STATUS, "01 01")


@directed("P312-CHK-14")
async def p312_instruction_inside_a_transfer(dut: Any) -> None:
    host = await Host.start(dut, TF[0])
    assert await host.ask(message(Code.VERSION)) == message(Answer.STATUS, "02 01")
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    host = await Host.start(dut, TF[0])
    assert await host.ask(message(Code.RESET)) == message(Code.RESET)
    assert await host.ask(TF[1]) == message(Answer.STATUS, "01 01")


@directed("P312-CHK-18")
async def p312_parameter_errors(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    for data, number in (("00 0063 0000001E", 0x20), ("00 0191 0000001E", 0x20), ("00 0000 00000000", 0x23)):
        assert (await host.ask(message(Code.RAMP, data))).startswith(f"03 0A F0 {number:02X} 82")
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
        assert (await host.ask(block)).split()[2:4] == ["F0", f"{number:02X}"], block
    assert await host.ask(message(Code.IN_POSITION, "00 0000")) == message(Code.IN_POSITION)
    assert host.condition == 0x02


@directed("P312-CHK-51", "P312-BAD-05", "P312-BAD-06")
async def p312_bad_blocks(dut: Any) -> None:
    host = await Host.start(dut, T1)
    assert await host.ask("03 02 40") == message(Answer.SIZE, "02")
    assert await host.ask("03 00 40") == message(Answer.SIZE, "00")
    assert await host.ask("07 01 40") == message(Answer.STATUS, "01 02")
    assert await host.ask("02 01 40") == message(Answer.STATUS, "01 02")
    assert await host.ask("03 01 46") == message(Answer.COMMAND, "46")
    host.mark = host.t
    await host.put("03")
    assert await host.response() == message(Answer.SIZE, "00")
    long = "03 1F" + " 40" * 30
    assert await host.ask(long) == message(Answer.SIZE, "1F")


@directed("P312-CHK-52", "P312-BAD-02", "P312-BAD-03", "P312-BAD-07", "P312-BAD-10")
async def p312_write_window(dut: Any) -> None:
    host = await Host.start(dut)
    await host.write(WCR, 0x00)
    await host.write(WAR, 0x1D)
    for byte in (0x40, 0x01, 0x03):
        await host.write(DWR, byte)
    assert await host.quiet() and not await host.read(CSR) & MWEF
    await host.write(WCR, 0x20)
    await host.write(WAR, 0x20)
    await host.write(DWR, 0x03)
    await host.write(WAR, 0x1C)
    await host.write(DWR, 0x99)
    assert await host.quiet() and not await host.read(CSR) & MWEF
    assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")
    await host.write(DWR, 0x03)
    assert await host.quiet()
    host.bench.set(cs_n=0, we_n=0, oe_n=0, rs=CSR, d_i=0x70)
    await host.pause(6)
    host.bench.set(cs_n=1, we_n=1, oe_n=1)
    await host.pause(6)
    assert not host.bench.rises("d_oe", host.t - 12) and await host.read(CSR) == 0x04


@directed("P312-BAD-01")
async def p312_unused_registers(dut: Any) -> None:
    host = await Host.start(dut)
    for reg in (1, 4, 6):
        await host.write(reg, 0x55)
        assert await host.read(reg) == 0
    assert await host.read(5) == 0


@directed("P312-CHK-53", "P312-PAR-12", builds=(D16,))
async def p312_wait_request(dut: Any) -> None:
    host = await Host.start(
        dut,
    )
    await host.write(CSR, 0x40)
    host.mark = host.t
    await host.put(message(Code.VERSION))
    await host.pause(20)
    low, high = host.bench.edges("wrq_n", host.mark)
    second, third = host.header - 6, host.header
    assert (low[1], high[1]) == (0, 1)
    assert low[0] - (second - 3) in range(0, 5) and high[0] - third in range(0, 13)
    assert await host.response() == message(Code.VERSION, "12")


@directed("P312-CHK-39", "P312-RSP-20")
async def p312_two_instructions_without_reading(dut: Any) -> None:
    host = await Host.start(dut, T1)
    await host.issue(message(Code.VERSION))
    await host.pause(200)
    await host.issue(message(Code.OUTPUT, "3F"))
    assert await host.response() == message(Code.VERSION, "12")
    assert await host.response() == message(Answer.ALARM, "01", source=SPONTANEOUS)
    assert host.condition == 0x10 and host.out("auxo_n") == 0x3F
    assert await host.quiet()


@directed("P312-CHK-37", "P312-CHK-38", "P312-INP-33")
async def p312_alarm_clear_waits_for_the_pin(dut: Any) -> None:
    host = await Host.start(dut, T1)
    await host.pins(alm_n=0)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    assert await host.ask(message(Code.ALARM_CLEAR)) == message(Code.ALARM_CLEAR)
    await host.pause(160_000)
    assert host.condition == 0x10
    await host.pins(alm_n=1)
    await host.pause(10)
    assert host.condition == 0x02
    await host.pins(alm_n=0)
    assert await host.response() == message(Answer.ALARM, "00", source=SPONTANEOUS)
    await host.ask(message(Code.ALARM_CLEAR))
    await host.pause(400_000)
    await host.pins(alm_n=1)
    await host.pause(1000)
    assert host.condition == 0x10
    await host.ask(message(Code.ALARM_CLEAR))
    assert host.condition == 0x02
    await host.pause(400_000)
    low, high = host.bench.edges("aclr_n")[-2:]
    assert (low[1], high[1], high[0] - low[0]) == (0, 1, 393_216)


@directed("P312-CHK-62")
async def p312_software_reset(dut: Any) -> None:
    host = await Host.start(dut, T1, message(Code.POSITION_SET, "00 00000007"), message(Code.OUTPUT, "3F"))
    await host.write(CSR, 0x70)
    assert await host.ask(message(Code.RESET)) == message(Code.RESET)
    assert await host.read(CSR) == 0x04 and host.condition == 0x01 and host.bench.golden.position == 0
    assert host.out("auxo_n") == 0x3F and host.out("out_oe") == 1
    assert host.bench.edges("out_oe") == [(3, 1)]


@directed("P312-CHK-62", "P312-BAD-09")
async def p312_reset_recovers_a_host_that_never_read(dut: Any) -> None:
    host = await Host.start(dut, T1)
    for _ in range(4):
        await host.issue(message(Code.VERSION))
        await host.pause(200)
    await host.issue(message(Code.RESET))
    await host.pause(500)
    assert await host.response() == message(Code.RESET) and await host.quiet() and host.condition == 0x01


@directed("P312-CMD-22")
async def p312_counter_clear_restarts(dut: Any) -> None:
    host = await Host.start(dut, message(Code.COUNTER_CLEAR))
    await host.pause(100_000)
    await host.ask(message(Code.COUNTER_CLEAR))
    again = host.header
    await host.pause(400_000)
    (low, high) = host.bench.edges("cclr_n")
    assert high[0] - again - 393_216 in range(1, 100) and high[0] - low[0] > 450_000


@directed("P312-CMD-27", "P312-CMD-20", "P312-CMD-21", "P312-CMD-23", "P312-CMD-41")
async def p312_terminals(dut: Any) -> None:
    host = await Host.start(dut)
    assert await host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, "FF E0")
    await host.pins(fl_n=0, org_n=0, run=0, evt1_n=0)
    assert await host.ask(message(Code.TERMINALS)) == message(Code.TERMINALS, "ED 40")
    assert (
        await host.ask(message(Code.EXCITATION_ON)) == message(Code.EXCITATION_ON) and host.out("exon_n") == 0
    )
    assert (
        await host.ask(message(Code.EXCITATION_OFF)) == message(Code.EXCITATION_OFF)
        and host.out("exon_n") == 1
    )
    assert await host.ask(message(Code.ZERO_CLAMP)) == message(Code.ZERO_CLAMP) and host.out("zclmp_n") == 0
    assert await host.ask(message(Code.TABLE_READ)) == message(Answer.STATUS, "00 01")


@directed("P312-PRT-01", "P312-PRT-03")
async def p312_serial_mode_is_silent_on_the_bus(dut: Any) -> None:
    host = await Host.start(dut)
    host.bench.set(mode=0)
    await host.bench.reset(20, settle=80)
    mark = host.t
    await host.put(message(Code.VERSION))
    assert await host.read(CSR) == 0
    assert not host.bench.rises("d_oe", mark)
