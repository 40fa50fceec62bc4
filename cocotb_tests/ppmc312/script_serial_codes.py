"""Scripts: every instruction of the serial mode: what it does, its replies, its refusals."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies

from .serial_frames import TS
from .serial_host import SerialHost

PARAMETER, STATE, LIMIT, SIZE, REGISTRATION = "B0 42", "B0 43", "B0 44", "B0 48", "B0 49"
EVENT = "03 01 20 00 00 00 00 00 00 00"
STOPPED = "A0 37"


def status(host: SerialHost) -> str:
    """4D."""
    return host.ask("4D").removeprefix("A0 ")


def at_rest(host: SerialHost) -> None:
    """Let a motion end."""
    end = host.t + 4_000_000
    while not host.model.core.operation.at_rest:
        assert host.t < end, "the motion does not end"
        host.step()
    host.pause(200)


@verifies("P312-CMD-00", "P312-SER-41", "P312-SER-47", "P312-SER-20")
def test_initial_setting() -> None:
    host = SerialHost()
    assert host.ask(TS) == "90" and host.condition == 0x02
    for bad in ("00 00 01F4 0001 000320", "00 00 0064 0096 000320", "00 00 00C8 0096 000320"):
        assert host.ask(bad) == PARAMETER and host.condition == 0x01
    # A stage with two pulses or fewer is found while the table is built.
    assert host.ask("00 00 01F4 00C8 000200") == PARAMETER and host.condition == 0x01
    assert host.ask("00 F8 01F4 00C8 000320") == "90" and host.condition == 0x02
    assert host.ask("85 01F4") == "90" and host.ask(TS) == STATE
    assert host.ask("80") == "90" and host.settle() == [STOPPED]


@verifies("P312-CMD-02", "P312-CMD-03", "P312-SER-42", "P312-MON-05")
def test_monitors() -> None:
    """RES does not count: the monitors go on after a report."""
    host = SerialHost(TS)
    for code, bit, note in (("02", 0x08, 0x26), ("03", 0x10, 0x24)):
        assert host.ask(f"{code} 01 0000") == PARAMETER
        assert host.ask(f"{code} 00 0000") == "90"
        for flags in ("01", "03"):
            assert host.ask(f"{code} {flags} 0005") == "90"
            for position, moved in (("0000000A", 1), ("00000002", 0), ("FFFFFFF0", 1), ("00000000", 0)):
                assert host.ask(f"43 {position}") == "90"
                assert int(status(host)[:2], 16) == bit | moved << (1 if code == "03" else 0)
                assert host.poll() == f"B0 {note + moved:02X}" and host.poll() == "90"
        assert host.ask(f"{code} 00 0005") == "90" and status(host) == "00 02 00"


@verifies("P312-CMD-02", "P312-MON-06")
def test_monitor_with_clamp() -> None:
    host = SerialHost(TS, "02 05 0003")
    host.pause(40)
    assert host.out("zclmp_n") == 0
    assert host.ask("84 00C8 00000005") == "90" and host.out("zclmp_n") == 1
    at_rest(host)
    assert host.poll() == "A0 38" and host.poll() == "B0 27" and host.poll() == "90"
    for _ in range(2):
        host.pins(epin=1)
        host.pause(5)
        host.pins(epin=0)
        host.pause(5)
    assert host.poll() == "B0 26" and host.out("zclmp_n") == 0


@verifies("P312-CMD-04", "P312-CMD-44", "P312-OUT-03", "P312-SER-30")
def test_interlock() -> None:
    host = SerialHost(TS, "04 00000004")
    assert host.ask("44") == "90" and host.out("intlk_n") == 0 and status(host) == "40 02 00"
    assert host.ask("44") == "90" and host.out("intlk_n") == 1
    assert host.ask("44") == "90"
    host.ask("84 00C8 0000000A")
    at_rest(host)
    assert [host.poll() for _ in range(3)] == ["B0 22", "A0 38", "90"]
    assert host.out("intlk_n") == 1 and status(host) == "00 02 00"


@verifies("P312-CMD-05", "P312-INP-11", "P312-SER-47")
def test_speed_limit() -> None:
    host = SerialHost(TS)
    assert host.ask("05 0001") == PARAMETER and host.ask("05 012C") == "90"
    host.pins(fhl_n=0)
    assert host.ask("84 00C8 00000003") == LIMIT
    assert host.ask("84 0190 00000003") == "90" and host.settle() == ["A0 38"]
    host.pins(fl_n=0)
    assert host.ask("84 0190 00000003") == LIMIT and host.ask("82") == LIMIT
    assert host.ask("A2") == "90" and host.settle() == ["A0 38"]
    assert host.ask("4E") == "A0 44"


@verifies("P312-CMD-06", "P312-SER-30", "P312-STA-02", "P312-BAD-18")
def test_end_terminal() -> None:
    host = SerialHost(TS, "06 01")
    assert host.ask("06 02") == PARAMETER
    assert host.ask("82") == "90"
    at_rest(host)
    assert host.poll() == "80" and host.ask("40") == "A0 00" and status(host) == "04 08 00"
    for instruction in ("80", "81", "89 00C8", "8A 00C8"):
        assert host.ask(instruction) == "90"
    host.pins(end_n=0)
    host.pause(20)
    assert host.poll() == "A0 38" and host.ask("40") == "A0 38" and host.poll() == "90"
    host.pins(end_n=1)
    assert host.ask("82") == "90"
    at_rest(host)
    assert host.ask("06 00") == "90" and host.poll() == "A0 38"


@verifies("P312-CMD-20", "P312-CMD-22", "P312-CMD-23", "P312-CMD-24", "P312-CMD-26")
def test_terminals() -> None:
    host = SerialHost()
    for instruction, pin, level in (
        ("20", "exon_n", 0),
        ("21", "exon_n", 1),
        ("22", "cclr_n", 0),
        ("23", "zclmp_n", 0),
        ("24", "aclr_n", 0),
        ("26 3F", "auxo_n", 0x00),
        ("26 D5", "auxo_n", 0x2A),
    ):
        assert host.ask(instruction) == "90" and host.out(pin) == level


@verifies("P312-CMD-25", "P312-CMD-27", "P312-CMD-40", "P312-SER-44")
def test_read_outs_of_pins() -> None:
    host = SerialHost()
    for level in (0x00, 0xFF, 0x5A):
        host.pins(auxi=level)
        host.pause(5)
        assert host.ask("25") == f"A0 {level:02X}"
    assert host.ask("27") == "A0 FF E0"
    for pin, answer in (("end_n", "BF E0"), ("index_n", "DF E0"), ("org_n", "EF E0"), ("evt1_n", "FF 60")):
        host.pins(**{pin: 0})
        host.pause(5)
        assert host.ask("27") == f"A0 {answer}"
        host.pins(**{pin: 1})
    assert host.ask("41") == "A0 12"


@verifies("P312-CMD-28", "P312-MON-10", "P312-RSP-21", "P312-SER-21")
def test_mask() -> None:
    """Always auto; two changes wait, the third one replaces the second."""
    host = SerialHost()
    host.pins(auxi=0x32)
    assert host.ask("28 24") == "90"
    for level in (0x66, 0x32, 0x36, 0x12):
        host.pins(auxi=level)
        host.pause(1_000)
    assert [host.poll() for _ in range(3)] == ["B0 2A 00 04", "B0 2A 01 24", "90"]
    host.pins(auxi=0xFF)
    host.pause(1_000)
    assert host.ask("28 00") == "90" and host.poll() == "90"


@verifies("P312-CMD-42", "P312-CMD-43", "P312-SER-40")
def test_positions() -> None:
    host = SerialHost("43 12345678", "63 9ABCDEF0")
    assert host.ask("42") == "A0 12 34 56 78" and host.ask("62") == "A0 9A BC DE F0"
    host.pins(epin=1, epdir=0)
    assert host.ask("62") == "A0 9A BC DE F1" and host.ask("42") == "A0 12 34 56 78"


@verifies("P312-CMD-45", "P312-INP-20", "P312-SER-30")
def test_held_operation() -> None:
    host = SerialHost(TS)
    host.pins(run=0)
    assert host.ask("84 00C8 00000003") == "90" and host.poll() == "80" and host.condition == 0x20
    assert host.ask("42") == "A0 00 00 00 00" and host.ask("4E") == STATE
    assert host.ask("45") == "90"
    at_rest(host)
    assert [host.poll() for _ in range(3)] == ["B0 23", "A0 38", "90"] and status(host) == "80 02 00"
    assert host.ask("45") == "90" and host.ask("82") == "90" and host.poll() == "80"
    host.pins(run=1)
    at_rest(host)
    assert [host.poll() for _ in range(3)] == ["B0 23", "A0 38", "90"]


@verifies("P312-CMD-49", "P312-SER-43", "P312-EVT-01", "P312-SER-22")
def test_event_buffers() -> None:
    host = SerialHost(TS)
    for code, delete, pin, buffers in (("49", "69", "evt0_n", "40"), ("59", "79", "evt1_n", "80")):
        assert host.ask(delete) == REGISTRATION
        assert [host.ask(f"{code} {EVENT}") for _ in range(4)] == ["90"] * 4
        assert host.ask(f"{code} {EVENT}") == REGISTRATION
        assert status(host) == f"00 02 {buffers}"
        host.blip(pin)
        assert host.out("exon_n") == 0 and host.poll() == "B0 29" and host.poll() == "90"
        assert host.ask("21") == "90"
        assert [host.ask(delete) for _ in range(5)] == ["90"] * 4 + [REGISTRATION]
        host.blip(pin)
        assert host.poll() == "90" and status(host) == "00 02 00"
    assert host.ask("4E") == "A0 49"


@pytest.mark.parametrize(
    ("data", "answer"),
    [
        ("03 08 83 00 0190 00000003", "90"),
        ("03 01 20 FF FF FF FF FF FF FF", "90"),
        ("03 02 26 15 00 00 00 00 00 00", "90"),
        ("03 00 20 00 00 00 00 00 00 00", PARAMETER),
        ("02 01 20 00 00 00 00 00 00 00", PARAMETER),
        ("23 08 83 00 0190 00000003", PARAMETER),
        ("03 09 83 00 0190 00000003", SIZE),
        ("03 FF 83 00 0190 00000003", SIZE),
        ("00 0E 83 00 0190 00000003", SIZE),
    ],
)
@verifies("P312-SER-43", "P312-SER-47")
def test_lengths_of_events(data: str, answer: str) -> None:
    host = SerialHost(TS)
    for code, pin in (("49", "evt0_n"), ("59", "evt1_n")):
        assert host.ask(f"{code} {data}") == answer
        assert host.ask("4E") == ("A0 00" if answer == "90" else f"A0 {answer[3:]}")
        host.blip(pin, gap=4_000)
        assert (host.poll() == "90") == (answer != "90")


@verifies("P312-SER-43", "P312-STA-01")
def test_events_in_other_states() -> None:
    """The size counts before the state, the state before the header."""
    host = SerialHost()
    for data, answer in (
        (EVENT, STATE),
        ("02 01 20 00 00 00 00 00 00 00", STATE),
        ("03 00 20 00 00 00 00 00 00 00", STATE),
        ("03 09 20 00 00 00 00 00 00 00", SIZE),
    ):
        assert host.ask(f"49 {data}") == answer
    assert host.ask("69") == STATE


@verifies("P312-SER-40", "P312-CMD-82", "P312-CMD-83", "P312-CMD-84", "P312-CMD-85", "P312-CMD-86")
def test_motions() -> None:
    host = SerialHost(TS)
    position = 0
    for code, data, count in (("82", "", 1), ("83", "0000 00000008", 8), ("84", "0190 00000005", 5)):
        for ccw in (0, 1):
            assert host.ask(f"{int(code, 16) + 0x20 * ccw:02X} {data}") == "90"
            at_rest(host)
            assert host.out("dir") == ccw and len(host.pulses()) == count
            assert host.poll() == "A0 38" and host.poll() == "90"
            position += -count if ccw else count
            assert host.ask("42") == "A0 " + position.to_bytes(4, "big", signed=True).hex(" ").upper()
    for code, data, gaps in (("85", "0190", {800}), ("86", "01F4", {1000})):
        for ccw in (0, 1):
            assert host.ask(f"{int(code, 16) + 0x20 * ccw:02X} {data}") == "90"
            assert host.poll() == "80" and host.out("dir") == ccw
            assert set(host.gaps(1)) == gaps
            assert host.ask("80") == "90"
            at_rest(host)
            assert host.poll() == STOPPED
    for bad in ("83 0000 00000000", "84 0063 00000005", "84 01F5 00000005", "85 00C7", "86 01F5", "89 0000"):
        assert host.ask(bad) == (STATE if bad[0:2] == "89" else PARAMETER)


@pytest.mark.parametrize("index", [0, 1])
@pytest.mark.parametrize("ccw", [0, 1])
@verifies("P312-CMD-10", "P312-CMD-11", "P312-SER-40")
def test_origin(index: int, ccw: int) -> None:
    host = SerialHost(TS)
    assert host.ask(f"{0x87 + 0x20 * ccw + 0x10 * index:02X} 0190") == "90"
    host.pulse(5)
    host.pins(org_n=0)
    if index:
        host.pulse(8)
        host.pins(index_n=0)
    at_rest(host)
    assert len(host.pulses()) == (8 if index else 5) and host.out("dir") == ccw
    assert host.poll() == "A0 32" and host.ask("40") == "A0 32"
    host.pins(org_n=1)
    host.pins(index_n=1)
    assert host.ask(f"{0x88 + 0x20 * ccw + 0x10 * index:02X} 0000") == "90"
    pin = "index_n" if index else "org_n"
    host.pins(org_n=0)
    host.pins(**{pin: 0})
    host.pause(2_500)
    host.pins(**{pin: 1})
    while host.out("dir") == ccw:
        assert not host.model.core.operation.at_rest
        host.step()
    assert host.poll() == "80"
    host.pins(**{pin: 0})
    at_rest(host)
    assert host.poll() == "A0 32"


@verifies("P312-CMD-80", "P312-CMD-81", "P312-MOT-30", "P312-SER-30")
def test_stops() -> None:
    host = SerialHost(TS)
    for start, stop, end in (("86 0000", "80", "37"), ("86 0000", "81", "36"), ("85 01F4", "81", "39")):
        assert host.ask(start) == "90"
        host.pulse(40)
        assert host.ask(stop) == "90"
        at_rest(host)
        assert host.poll() == f"A0 {end}" and host.ask("40") == f"A0 {end}"
    for instruction in ("80", "81", "89 00C8", "8A 00C8"):
        assert host.ask(instruction) == STATE


@verifies("P312-CMD-87", "P312-CMD-88", "P312-SER-40")
def test_changes() -> None:
    host = SerialHost(TS)
    assert host.ask("85 01F4") == "90"
    assert host.ask("8A 0190") == "90"
    host.mark = host.t
    assert host.poll() == "80" and host.gaps(1)[-1] == 800
    assert host.ask("89 0188") == "90"
    host.pause(120_000)
    host.mark = host.t
    assert host.poll() == "80" and host.gaps(1)[-1] == 784
    assert host.ask("8A 0000") == PARAMETER and host.ask("89 0063") == PARAMETER
    assert host.ask("80") == "90" and host.settle() == [STOPPED]


@pytest.mark.parametrize(("bits", "pin"), [(0x20, "evt0_n"), (0x30, "evt1_n")])
@verifies("P312-OVR-01", "P312-OVR-02", "P312-SER-40", "P312-SER-22")
def test_overrides_by_pins(bits: int, pin: str) -> None:
    """80, 81, 89 and 8A wait for their pin, one after the other."""
    host = SerialHost(TS)
    for code, data in ((0x8A, "0190"), (0x89, "01F4"), (0x81, ""), (0x80, "")):
        assert host.ask(f"{code + bits:02X} {data}") == "90"
    assert status(host) == f"00 02 {'24' if bits == 0x30 else '14'}"
    assert host.ask("85 01F4") == "90"
    host.blip(pin)
    assert host.poll() == "B0 28"
    host.mark = host.t
    assert host.poll() == "80" and host.gaps(1)[-1] == 800
    host.blip(pin)
    assert host.poll() == "B0 28" and host.ask("80") == "90"
    at_rest(host)
    assert host.poll() == STOPPED
    # 81 and 80 find nothing to stop: the first one fails and takes the other with it.
    host.blip(pin)
    assert host.poll() == "B0 4B" and host.poll() == "90" and status(host) == "00 02 00"


@verifies("P312-OVR-01", "P312-OVR-12", "P312-SER-40")
def test_overrides_at_positions() -> None:
    host = SerialHost(TS)
    for instruction in ("99 0190 00000005", "9A 01F4 00000008", "91 00000014", "90 00000019"):
        assert host.ask(instruction) == "90"
    assert status(host) == "00 02 04"
    assert host.ask("85 01F4") == "90"
    at_rest(host)
    # 91 finds the stop speed reached; 90 waits for the next motion.
    assert host.ask("42") == "A0 00 00 00 14"
    assert [host.poll() for _ in range(3)] == ["B0 28", "A0 39", "90"]
    assert host.ask("85 01F4") == "90"
    at_rest(host)
    assert host.ask("42") == "A0 00 00 00 19" and [host.poll() for _ in range(2)] == ["B0 28", "A0 37"]


@verifies("P312-OVR-01", "P312-SER-47", "P312-CMD-49")
def test_registrations_that_fail() -> None:
    host = SerialHost(TS)
    assert [host.ask("90 00000014") for _ in range(9)] == ["90"] * 8 + [REGISTRATION]
    assert host.ask(TS) == "90"
    assert host.ask("A0") == "90" and host.ask(f"49 {EVENT}") == REGISTRATION
    assert host.ask(f"59 {EVENT}") == "90" and host.ask("B0") == REGISTRATION
    assert host.ask("4E") == "A0 49" and host.ask("4E") == "A0 00"


@verifies("P312-STA-01", "P312-SER-47", "P312-SER-45")
def test_states() -> None:
    """43 wherever the table says so; 4E and 4F in INI and NOR only, 40 always."""
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
    host = SerialHost()
    for instruction in initial:
        assert host.ask(instruction) == STATE, instruction
    for instruction, answer in (*always, ("4E", "A0 43"), ("4F", "A0 00 00 00")):
        assert host.ask(instruction) == answer
    assert host.ask(TS) == "90" and host.ask("85 01F4") == "90"
    for instruction in moving:
        assert host.ask(instruction) == STATE, instruction
    for instruction, answer in always:
        assert host.ask(instruction) == answer
    assert host.ask("62") == "A0 00 00 00 00"
    host.pins(alm_n=0)
    host.pause(3_000)
    for instruction in (*moving[:10], *moving[11:], *initial[1:]):
        assert host.ask(instruction) == STATE, instruction
    assert host.ask("24") == "90" and host.poll() == "B0 46"
    host.pins(alm_n=1)
    host.pause(20)
    assert host.poll() == "A0 31" and host.ask("4E") == "A0 43"
