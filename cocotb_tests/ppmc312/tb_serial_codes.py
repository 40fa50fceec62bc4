"""Every instruction of the serial mode: effect, replies, rejections."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import directed

from .serial_frames import TS
from .serial_host import SerialHost

PARAMETER, STATE, LIMIT, SIZE, REGISTRATION = "B0 42", "B0 43", "B0 44", "B0 48", "B0 49"
EVENT = "03 01 20 00 00 00 00 00 00 00"
STOPPED = "A0 37"


@directed("P312-CMD-00", "P312-SER-41", "P312-SER-47", "P312-SER-20")
async def p312_serial_initial_setting(dut: Any) -> None:
    host = await SerialHost.start(dut)
    assert await host.ask(TS) == "90" and await host.state() == 0x02
    for bad in ("00 00 01F4 0001 000320", "00 00 0064 0096 000320", "00 00 00C8 0096 000320"):
        assert await host.ask(bad) == PARAMETER and await host.state() == 0x01
    # If a stage has only one pulse, this is detected while the table is built.
    assert await host.ask("00 00 01F4 00C8 0001BC") == PARAMETER and await host.state() == 0x01
    assert await host.ask("00 F8 01F4 00C8 000320") == "90" and await host.state() == 0x02
    assert await host.asks("85 01F4", TS) == ["90", STATE]
    assert await host.ask("80") == "90" and await host.settle() == [STOPPED]


@directed("P312-CMD-02", "P312-CMD-03", "P312-SER-42", "P312-MON-05")
async def p312_serial_monitors(dut: Any) -> None:
    """RES is ignored: the monitors continue after a report."""
    host = await SerialHost.start(dut, TS)
    for code, bit, note in (("02", 0x08, 0x26), ("03", 0x10, 0x24)):
        assert await host.ask(f"{code} 01 0000") == PARAMETER
        assert await host.ask(f"{code} 00 0000") == "90"
        for flags in ("01", "03"):
            assert await host.ask(f"{code} {flags} 0005") == "90"
            for position, moved in (("0000000A", 1), ("00000002", 0), ("FFFFFFF0", 1), ("00000000", 0)):
                assert await host.ask(f"43 {position}") == "90"
                assert int((await host.status())[:2], 16) == bit | moved << (1 if code == "03" else 0)
                assert await host.polls(2) == [f"B0 {note + moved:02X}", "90"]
        assert await host.ask(f"{code} 00 0005") == "90" and await host.status() == "00 02 00"


@directed("P312-CMD-02", "P312-MON-06")
async def p312_serial_monitor_with_clamp(dut: Any) -> None:
    host = await SerialHost.start(dut, TS, "02 05 0003")
    await host.pause(40)
    assert host.out("zclmp_n") == 0
    assert await host.ask("84 00C8 00000005") == "90" and host.out("zclmp_n") == 1
    await host.at_rest()
    assert await host.polls(3) == ["A0 38", "B0 27", "90"]
    for _ in range(2):
        await host.pins(epin=1)
        await host.pause(5)
        await host.pins(epin=0)
        await host.pause(5)
    assert await host.poll() == "B0 26" and host.out("zclmp_n") == 0


@directed("P312-CMD-04", "P312-CMD-44", "P312-OUT-03", "P312-SER-30")
async def p312_serial_interlock(dut: Any) -> None:
    host = await SerialHost.start(dut, TS, "04 00000004")
    assert await host.ask("44") == "90" and host.out("intlk_n") == 0 and await host.status() == "40 02 00"
    assert await host.ask("44") == "90" and host.out("intlk_n") == 1
    assert await host.ask("44") == "90"
    await host.ask("84 00C8 0000000A")
    await host.at_rest()
    assert await host.polls(3) == ["B0 22", "A0 38", "90"]
    assert host.out("intlk_n") == 1 and await host.status() == "00 02 00"


@directed("P312-CMD-05", "P312-INP-11", "P312-SER-47")
async def p312_serial_speed_limit(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    assert await host.asks("05 0001", "05 012C") == [PARAMETER, "90"]
    await host.pins(fhl_n=0)
    assert await host.ask("84 00C8 00000003") == LIMIT
    assert await host.ask("84 0190 00000003") == "90" and await host.settle() == ["A0 38"]
    await host.pins(fl_n=0)
    assert await host.asks("84 0190 00000003", "82") == [LIMIT, LIMIT]
    assert await host.ask("A2") == "90" and await host.settle() == ["A0 38"]
    assert await host.ask("4E") == "A0 44"


@directed("P312-CMD-06", "P312-SER-30", "P312-STA-02", "P312-BAD-18")
async def p312_serial_end_terminal(dut: Any) -> None:
    host = await SerialHost.start(dut, TS, "06 01")
    assert await host.ask("06 02") == PARAMETER
    assert await host.ask("82") == "90"
    await host.at_rest()
    assert await host.poll() == "80" and await host.ask("40") == "A0 00" and await host.status() == "04 08 00"
    for instruction in ("80", "81", "89 00C8", "8A 00C8"):
        assert await host.ask(instruction) == "90"
    await host.pins(end_n=0)
    await host.pause(20)
    assert await host.poll() == "A0 38" and await host.ask("40") == "A0 38" and await host.poll() == "90"
    await host.pins(end_n=1)
    assert await host.ask("82") == "90"
    await host.at_rest()
    assert await host.ask("06 00") == "90" and await host.poll() == "A0 38"


@directed("P312-CMD-20", "P312-CMD-22", "P312-CMD-23", "P312-CMD-24", "P312-CMD-26")
async def p312_serial_terminals(dut: Any) -> None:
    host = await SerialHost.start(dut)
    for instruction, pin, level in (
        ("20", "exon_n", 0),
        ("21", "exon_n", 1),
        ("22", "cclr_n", 0),
        ("23", "zclmp_n", 0),
        ("24", "aclr_n", 0),
        ("26 3F", "auxo_n", 0x00),
        ("26 D5", "auxo_n", 0x2A),
    ):
        assert await host.ask(instruction) == "90" and host.out(pin) == level


@directed("P312-CMD-25", "P312-CMD-27", "P312-CMD-40", "P312-SER-44")
async def p312_serial_read_outs_of_pins(dut: Any) -> None:
    host = await SerialHost.start(dut)
    for level in (0x00, 0xFF, 0x5A):
        await host.pins(auxi=level)
        await host.pause(5)
        assert await host.ask("25") == f"A0 {level:02X}"
    assert await host.ask("27") == "A0 FF E0"
    for pin, answer in (("end_n", "BF E0"), ("index_n", "DF E0"), ("org_n", "EF E0"), ("evt1_n", "FF 60")):
        await host.pins(**{pin: 0})
        await host.pause(5)
        assert await host.ask("27") == f"A0 {answer}"
        await host.pins(**{pin: 1})
    assert await host.ask("41") == "A0 12"


@directed("P312-CMD-28", "P312-MON-10", "P312-RSP-21", "P312-SER-21")
async def p312_serial_mask(dut: Any) -> None:
    """The input monitor is always automatic. Two changes are stored, and a third one replaces the second."""
    host = await SerialHost.start(dut)
    await host.pins(auxi=0x32)
    assert await host.ask("28 24") == "90"
    for level in (0x66, 0x32, 0x36, 0x12):
        await host.pins(auxi=level)
        await host.pause(1_000)
    assert await host.polls(3) == ["B0 2A 00 04", "B0 2A 01 24", "90"]
    await host.pins(auxi=0xFF)
    await host.pause(1_000)
    assert await host.ask("28 00") == "90" and await host.poll() == "90"


@directed("P312-CMD-42", "P312-CMD-43", "P312-SER-40")
async def p312_serial_positions(dut: Any) -> None:
    host = await SerialHost.start(dut, "43 12345678", "63 9ABCDEF0")
    assert await host.asks("42", "62") == ["A0 12 34 56 78", "A0 9A BC DE F0"]
    await host.pins(epin=1, epdir=0)
    assert await host.asks("62", "42") == ["A0 9A BC DE F1", "A0 12 34 56 78"]


@directed("P312-CMD-45", "P312-INP-20", "P312-SER-30")
async def p312_serial_held_operation(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    await host.pins(run=0)
    assert (
        await host.ask("84 00C8 00000003") == "90"
        and await host.poll() == "80"
        and await host.state() == 0x20
    )
    assert await host.asks("42", "4E") == ["A0 00 00 00 00", STATE]
    assert await host.ask("45") == "90"
    await host.at_rest()
    assert await host.polls(3) == ["B0 23", "A0 38", "90"] and await host.status() == "80 02 00"
    assert await host.asks("45", "82") == ["90", "90"] and await host.poll() == "80"
    await host.pins(run=1)
    await host.at_rest()
    assert await host.polls(3) == ["B0 23", "A0 38", "90"]


@directed("P312-CMD-49", "P312-SER-43", "P312-EVT-01", "P312-SER-22")
async def p312_serial_event_buffers(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    for code, delete, pin, buffers in (("49", "69", "evt0_n", "40"), ("59", "79", "evt1_n", "80")):
        assert await host.ask(delete) == REGISTRATION
        assert await host.asks(*[f"{code} {EVENT}"] * 5) == ["90"] * 4 + [REGISTRATION]
        assert await host.status() == f"00 02 {buffers}"
        await host.blip(pin)
        assert host.out("exon_n") == 0 and await host.polls(2) == ["B0 29", "90"]
        assert await host.ask("21") == "90"
        assert await host.asks(*[delete] * 5) == ["90"] * 4 + [REGISTRATION]
        await host.blip(pin)
        assert await host.poll() == "90" and await host.status() == "00 02 00"
    assert await host.ask("4E") == "A0 49"


@cocotb.parametrize(
    case=[
        ("03 08 83 00 0190 00000003", "90"),
        ("03 01 20 FF FF FF FF FF FF FF", "90"),
        ("03 02 26 15 00 00 00 00 00 00", "90"),
        ("03 00 20 00 00 00 00 00 00 00", PARAMETER),
        ("02 01 20 00 00 00 00 00 00 00", PARAMETER),
        ("23 08 83 00 0190 00000003", PARAMETER),
        ("03 09 83 00 0190 00000003", SIZE),
        ("03 FF 83 00 0190 00000003", SIZE),
        ("00 0E 83 00 0190 00000003", SIZE),
    ]
)
@directed("P312-SER-43", "P312-SER-47")
async def p312_serial_lengths_of_events(dut: Any, case: Any) -> None:
    data, answer = case
    host = await SerialHost.start(dut, TS)
    for code, pin in (("49", "evt0_n"), ("59", "evt1_n")):
        assert await host.ask(f"{code} {data}") == answer
        assert await host.ask("4E") == ("A0 00" if answer == "90" else f"A0 {answer[3:]}")
        await host.blip(pin, gap=4_000)
        assert (await host.poll() == "90") == (answer != "90")


@directed("P312-SER-43", "P312-STA-01")
async def p312_serial_events_in_other_states(dut: Any) -> None:
    """The size is checked before the state, and the state before the header."""
    host = await SerialHost.start(dut)
    for data, answer in (
        (EVENT, STATE),
        ("02 01 20 00 00 00 00 00 00 00", STATE),
        ("03 00 20 00 00 00 00 00 00 00", STATE),
        ("03 09 20 00 00 00 00 00 00 00", SIZE),
    ):
        assert await host.ask(f"49 {data}") == answer
    assert await host.ask("69") == STATE


@directed("P312-OVR-01", "P312-SER-47", "P312-CMD-49")
async def p312_serial_registrations_that_fail(dut: Any) -> None:
    host = await SerialHost.start(dut, TS)
    assert await host.asks(*["90 00000014"] * 9) == ["90"] * 8 + [REGISTRATION]
    assert await host.ask(TS) == "90"
    assert await host.asks("A0", f"49 {EVENT}") == ["90", REGISTRATION]
    assert await host.asks(f"59 {EVENT}", "B0") == ["90", REGISTRATION]
    assert await host.asks("4E", "4E") == ["A0 49", "A0 00"]


@directed("P312-STA-01", "P312-SER-47", "P312-SER-45")
async def p312_serial_states(dut: Any) -> None:
    """The reply is 43 in every state in which the table does not allow the instruction.

    Instructions 4E and 4F are accepted only in INI and NOR; instruction 40 is always accepted.
    """
    initial = ("05 012C", "80", "81", "82", "83 0000 00000005", "84 0000 00000005", "85 0000", "86 0000")
    initial += ("87 0190", "88 0190", "89 0190", "8A 0190", "44", "45", "69", "90 00000005", "A0")
    moving = (
        TS,
        "02 00 0000",
        "03 00 0000",
        "04 00000000",
        "05 012C",
        "06 00",
        "20",
        "21",
        "22",
        "23",
        "24",
        "28 00",
    )
    moving += (
        "43 00000000",
        "63 00000000",
        "44",
        "45",
        "69",
        "4E",
        "4F",
        "82",
        "83 0000 00000005",
        "88 0190",
    )
    always = (("25", "A0 00"), ("26 00", "90"), ("27", "A0 FF E0"), ("41", "A0 12"), ("40", "A0 00"))
    host = await SerialHost.start(dut)
    for instruction in initial:
        assert await host.ask(instruction) == STATE, instruction
    for instruction, answer in (*always, ("4E", "A0 43"), ("4F", "A0 00 00 00")):
        assert await host.ask(instruction) == answer
    assert await host.asks(TS, "85 01F4") == ["90", "90"]
    for instruction in moving:
        assert await host.ask(instruction) == STATE, instruction
    for instruction, answer in always:
        assert await host.ask(instruction) == answer
    assert await host.ask("62") == "A0 00 00 00 00"
    await host.pins(alm_n=0)
    await host.pause(3_000)
    for instruction in (*moving[:10], *moving[11:], *initial[1:]):
        assert await host.ask(instruction) == STATE, instruction
    assert await host.ask("24") == "90" and await host.poll() == "B0 46"
    await host.pins(alm_n=1)
    await host.pause(20)
    assert await host.poll() == "A0 31" and await host.ask("4E") == "A0 43"
