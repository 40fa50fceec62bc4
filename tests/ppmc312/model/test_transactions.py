"""Example transactions of chapter 12 of the PPMC-312, byte for byte on its parallel bus."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc312.host import CSR, DRR, DWR, MREF, MWEF, RAR, T1, TF, WAR, WCR, Host, clean
from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import SPONTANEOUS, Answer, Code

T1_8M = message(Code.INITIAL, "00 03E8 00C8 0007D0")
"""T1 at F = 8 MHz, for moves that would take 15 to 25 million clk at 1 MHz."""


def sends(host: Host, text: str) -> None:
    """`WAR; DWR bytes in bus order`."""
    war, data = (piece.strip() for piece in text.split(";"))
    while host.read(CSR) & MWEF:
        host.t += 20
    host.mark = host.t
    host.write(WCR, 0x20)
    host.write(WAR, int(war, 16))
    for byte in bytes.fromhex(data):
        host.write(DWR, byte)


def gets(host: Host) -> str:
    """`RAR; DRR bytes in bus order` of the next response."""
    host.wait()
    rar = host.read(RAR)
    data = bytes(host.read(DRR) for _ in range(0x40 - rar))
    assert host.read(CSR) & MREF or host.read(RAR) != 0x40
    return f"{rar:02X}; {data.hex(' ').upper()}"


SINGLE = [
    # Number, setting, what is sent, what is got at once, what is got later.
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


@pytest.mark.parametrize("case", SINGLE, ids=lambda case: f"{case[0]}-{case[2][4:].split()[-3]}")
@verifies("P312-PAR-04", "P312-PAR-05", "P312-PAR-07")
def test_single(case: tuple) -> None:
    _, setting, sent, *answers = case
    host = Host(*setting)
    sends(host, sent)
    for answer in answers:
        assert gets(host) == answer


def test_8_immediate_stop() -> None:
    host = Host(T1)
    host.ask(message(Code.FOREVER_CONSTANT, "00 01F4"))
    sends(host, "1C; 00 80 02 03")
    assert gets(host) == "3D; 80 01 03"


def test_9_and_17_overrides_at_a_position() -> None:
    host = Host(T1_8M)
    sends(host, "16; 00 08 00 00 2C 01 04 88 08 03")
    assert gets(host) == "3D; E8 01 03"
    sends(host, "18; 00 10 00 00 04 80 06 03")
    assert gets(host) == "3D; E8 01 03"
    host.ask(message(Code.FOREVER_CONSTANT, "00 00C8"))
    assert gets(host) == "3D; 88 01 1B"
    assert gets(host) == "3D; 80 01 1B"
    assert gets(host) == "38; 00 10 00 00 04 E0 06 23"
    assert len(host.pulses()) == 0x1000


def test_10_deceleration_stop_on_evt0() -> None:
    host = Host(T1)
    sends(host, "1C; 05 81 02 03")
    assert gets(host) == "3D; E8 01 03"
    host.ask(message(Code.FOREVER_CONSTANT, "00 01F4"))
    host.blip("evt0_n")
    assert gets(host) == "3D; 81 01 1B"
    assert gets(host).endswith("08 E0 06 23")


def test_16_change() -> None:
    host = Host(T1)
    host.ask(message(Code.FOREVER_CONSTANT, "00 01F4"))
    sends(host, "1A; 90 01 00 87 04 03")
    assert gets(host) == "3D; 87 01 03"


def test_20_input() -> None:
    host = Host()
    host.pins(auxi=0xA5)
    sends(host, "1D; 25 01 03")
    assert gets(host) == "3C; A5 25 02 03"


@verifies("P312-MON-10", "P312-RSP-21", "P312-CHK-50")
def test_23_mask() -> None:
    host = Host()
    host.pins(auxi=0x32)
    sends(host, "1B; 24 01 28 03 03")
    assert gets(host) == "3D; 28 01 03"
    host.pins(auxi=0x66)
    assert gets(host) == "3B; 04 00 E9 03 23"
    for level in (0x42, 0x46, 0x62):
        host.pins(auxi=level)
        host.pause(2000)
    assert host.response() == clean(message(Answer.INPUT_CHANGE, "00 24", source=SPONTANEOUS))
    assert host.response() == clean(message(Answer.INPUT_CHANGE, "01 24", source=SPONTANEOUS))
    assert host.quiet()


def test_29_to_31_event_buffer() -> None:
    host = Host(T1)
    sends(host, "12; 64 00 00 00 00 00 00 82 08 03 01 49 0C 03")
    assert gets(host) == "3C; 00 49 02 03"
    sends(host, "1C; 01 47 02 03")
    assert gets(host) == "37; 00 00 00 82 00 01 47 07 03"
    sends(host, "1C; 03 49 02 03")
    assert gets(host) == "3C; 04 49 02 03"


def test_34_to_36_free_curve() -> None:
    host = Host()
    sends(host, "1B; 03 01 01 03 02")
    assert gets(host) == "3B; 03 00 01 03 03"
    sends(host, "18; 90 01 C8 00 64 00 06 00")
    assert gets(host) == "3B; 03 01 01 03 03"
    sends(host, "15; 03 00 00 04 00 00 05 00 00 09 01")
    assert gets(host) == "36; 0C 00 00 0C 00 00 0F 01 08 03"


def test_42_alarm_report() -> None:
    host = Host(*TF)
    host.pins(alm_n=0)
    assert gets(host) == "3C; 00 F4 02 23"
