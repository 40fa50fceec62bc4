"""Example transactions of the PPMC-312, byte for byte on its parallel bus.

A transaction has the same number here and in tb_serial_transactions.py, which uses the serial line.
"""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import directed
from cocotb_tests.harness.bus import CSR, DRR, DWR, MREF, MWEF, RAR, WAR, WCR, clean
from cocotb_tests.ppmc312.blocks import T1, TF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code

T1_8M = message(Code.INITIAL, "00 03E8 00C8 0007D0")
"""Table T1 at F = 8 MHz, for moves that would take 15 to 25 million cycles at 1 MHz."""


async def sends(host: Host, text: str) -> None:
    """Write a block; `text` contains the value for WAR, a semicolon, and the bytes for DWR in bus order."""
    war, data = (piece.strip() for piece in text.split(";"))
    while await host.read(CSR) & MWEF:
        await host.pause(20)
    host.mark = host.t
    await host.write(WCR, 0x20)
    await host.write(WAR, int(war, 16))
    for byte in bytes.fromhex(data):
        await host.write(DWR, byte)


async def gets(host: Host) -> str:
    """Return the next response as text: the value of RAR, a semicolon, and the bytes of DRR in bus order."""
    await host.wait()
    rar = await host.read(RAR)
    data = bytes([await host.read(DRR) for _ in range(0x40 - rar)])
    assert await host.read(CSR) & MREF or await host.read(RAR) != 0x40
    return f"{rar:02X}; {data.hex(' ').upper()}"


SINGLE = [
    # A row contains the number, the setting, the block sent, the immediate response, and the later response.
    (1, (), "15; D0 07 00 C8 00 E8 03 01 00 09 03", "3D; 00 01 03"),
    (2, (), "10; DC 05 00 D0 07 00 C8 00 F4 01 E8 03 11 00 0E 03", "3D; 00 01 03"),
    (3, (), "1A; 0A 00 03 02 04 03", "3D; 02 01 03"),
    (4, (), "1A; 14 00 03 03 04 03", "3D; 03 01 03"),
    (5, (), "19; 88 13 00 00 04 05 03", "3D; 04 01 03"),
    (6, (T1,), "1B; 2C 01 05 03 03", "3D; 05 01 03"),
    (7, (), "1C; 01 06 02 03", "3C; 01 06 02 03"),
    (11, (T1_8M,), "16; 88 13 00 00 00 00 00 82 08 03", "3C; 00 82 02 03", "38; 88 13 00 00 40 E0 06 23"),
    (12, (T1,), "16; 64 00 00 00 F4 01 40 83 08 03", "3C; 00 83 02 03"),
    (13, (T1,), "1C; 40 84 02 03", "3D; 84 01 03"),
    (14, (T1,), "1A; 00 00 00 85 04 03", "3C; 00 85 02 03"),
    (15, (T1,), "1A; 90 01 40 86 04 03", "3C; 00 86 02 03"),
    (18, (T1,), "1A; F4 01 50 10 04 03", "3C; 00 10 02 03"),
    (19, (T1,), "1A; 00 00 00 11 04 03", "3C; 00 11 02 03"),
    (21, (), "1C; 15 26 02 03", "3D; 26 01 03"),
    (22, (), "1D; 27 01 03", "3B; E0 FF 27 03 03"),
    (24, (message(Code.POSITION_SET, "00 12345678"),), "1C; 00 42 02 03", "38; 78 56 34 12 00 42 06 03"),
    (25, (), "18; FF FF FF FF 01 43 06 03", "3D; 43 01 03"),
    (26, (T1,), "1D; 44 01 03", "3C; 01 44 02 03"),
    (27, (T1,), "1D; 45 01 03", "3C; 01 45 02 03"),
    (28, (), "1D; 40 01 03", "3C; 12 40 02 03"),
    (32, (T1,), "1D; 4D 01 03", "3A; 00 02 00 4D 04 03"),
    (33, (T1,), "1D; 41 01 03", "34; D0 07 00 D0 07 00 00 7F 7F 41 0A 02"),
    (37, (T1,), "18; 78 56 34 12 40 82 06 03", "3C; 00 82 02 03"),
    (38, (T1,), "16; 00 00 00 00 00 00 00 82 08 03", "34; 00 00 00 00 00 00 00 82 23 F0 0A 03"),
    (40, (), "1D; 20 01 03", "3D; 20 01 03"),
    (40, (), "1D; 24 01 03", "3D; 24 01 03"),
    (41, (), "1D; FF 01 03", "3D; FF 01 03"),
]


@cocotb.parametrize(case=SINGLE)
@directed("P312-PAR-04", "P312-PAR-05", "P312-PAR-07")
async def p312_single(dut: Any, case: tuple) -> None:
    _, setting, sent, *answers = case
    host = await Host.start(dut, *setting)
    await sends(host, sent)
    for answer in answers:
        assert await gets(host) == answer


@directed("P312-PAR-04", "P312-CMD-80")
async def p312_8_immediate_stop(dut: Any) -> None:
    host = await Host.start(dut, T1)
    await host.ask(message(Code.FOREVER_CONSTANT, "00 01F4"))
    await sends(host, "1C; 00 80 02 03")
    assert await gets(host) == "3D; 80 01 03"


@directed("P312-PAR-04", "P312-CMD-80", "P312-CMD-88", "P312-OVR-01")
async def p312_9_and_17_overrides_at_a_position(dut: Any) -> None:
    host = await Host.start(dut, T1_8M)
    await sends(host, "16; 00 08 00 00 2C 01 04 88 08 03")
    assert await gets(host) == "3D; E8 01 03"
    await sends(host, "18; 00 10 00 00 04 80 06 03")
    assert await gets(host) == "3D; E8 01 03"
    await host.ask(message(Code.FOREVER_CONSTANT, "00 00C8"))
    assert await gets(host) == "3D; 88 01 1B"
    assert await gets(host) == "3D; 80 01 1B"
    assert await gets(host) == "38; 00 10 00 00 04 E0 06 23"
    assert len(host.pulses()) == 0x1000


@directed("P312-PAR-04", "P312-CMD-81", "P312-OVR-01")
async def p312_10_deceleration_stop_on_evt0(dut: Any) -> None:
    host = await Host.start(dut, T1)
    await sends(host, "1C; 05 81 02 03")
    assert await gets(host) == "3D; E8 01 03"
    await host.ask(message(Code.FOREVER_CONSTANT, "00 01F4"))
    await host.blip("evt0_n")
    assert await gets(host) == "3D; 81 01 1B"
    assert (await gets(host)).endswith("08 E0 06 23")


@directed("P312-PAR-04", "P312-CMD-87")
async def p312_16_change(dut: Any) -> None:
    host = await Host.start(dut, T1)
    await host.ask(message(Code.FOREVER_CONSTANT, "00 01F4"))
    await sends(host, "1A; 90 01 00 87 04 03")
    assert await gets(host) == "3D; 87 01 03"


@directed("P312-PAR-04", "P312-CMD-25")
async def p312_20_input(dut: Any) -> None:
    host = await Host.start(dut)
    await host.pins(auxi=0xA5)
    await sends(host, "1D; 25 01 03")
    assert await gets(host) == "3C; A5 25 02 03"


@directed("P312-MON-10", "P312-RSP-21", "P312-CHK-50")
async def p312_23_mask(dut: Any) -> None:
    host = await Host.start(dut)
    await host.pins(auxi=0x32)
    await sends(host, "1B; 24 01 28 03 03")
    assert await gets(host) == "3D; 28 01 03"
    await host.pins(auxi=0x66)
    assert await gets(host) == "3B; 04 00 E9 03 23"
    for level in (0x42, 0x46, 0x62):
        await host.pins(auxi=level)
        await host.pause(2000)
    assert await host.response() == clean(message(Answer.INPUT_CHANGE, "00 24", source=SPONTANEOUS))
    assert await host.response() == clean(message(Answer.INPUT_CHANGE, "01 24", source=SPONTANEOUS))
    assert await host.quiet()


@directed("P312-PAR-04", "P312-CMD-47", "P312-CMD-49")
async def p312_29_to_31_event_buffer(dut: Any) -> None:
    host = await Host.start(dut, T1)
    await sends(host, "12; 64 00 00 00 00 00 00 82 08 03 01 49 0C 03")
    assert await gets(host) == "3C; 00 49 02 03"
    await sends(host, "1C; 01 47 02 03")
    assert await gets(host) == "37; 00 00 00 82 00 01 47 07 03"
    await sends(host, "1C; 03 49 02 03")
    assert await gets(host) == "3C; 04 49 02 03"


@directed("P312-PAR-04", "P312-CMD-01", "P312-CMD-FC-2")
async def p312_34_to_36_free_curve(dut: Any) -> None:
    host = await Host.start(dut)
    await sends(host, "1B; 03 01 01 03 02")
    assert await gets(host) == "3B; 03 00 01 03 03"
    await sends(host, "18; 90 01 C8 00 64 00 06 00")
    assert await gets(host) == "3B; 03 01 01 03 03"
    await sends(host, "15; 03 00 00 04 00 00 05 00 00 09 01")
    assert await gets(host) == "36; 0C 00 00 0C 00 00 0F 01 08 03"


@directed("P312-PAR-04", "P312-INP-30")
async def p312_42_alarm_report(dut: Any) -> None:
    host = await Host.start(dut, *TF)
    await host.pins(alm_n=0)
    assert await gets(host) == "3C; 00 F4 02 23"
