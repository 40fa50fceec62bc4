"""The demo without a simulator: bytes as text, single pins in the waveforms, the choice of the part."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import PARTS
from cocotb_tests.harness.compare import compare_recording, replay
from cocotb_tests.harness.dut_bench import new_model
from cocotb_tests.harness.project import ProjectError
from openppmc.capture.common.mnemonics import exchanges
from openppmc.capture.ppmc104.mnemonics import Ppmc104Decoder
from openppmc.capture.ppmc312.mnemonics import Ppmc312Decoder
from openppmc.capture.ppmc2104.mnemonics import Ppmc2104Decoder
from openppmc.capture.stmc.mnemonics import StmcDecoder
from openppmc.check.records import Access, Change, Recording, steps
from openppmc.parts import having
from scripts.demo import waves
from scripts.demo.__main__ import chosen, hexes
from scripts.demo.demos import Demo
from scripts.demo.ppmc312.demo import VIEW as VIEW_312
from scripts.demo.ppmc2104 import VIEW as VIEW_2104
from scripts.demo.scenes import register_text
from scripts.demo.stmc import VIEW as VIEW_STMC


def accesses(script: str) -> list[Access]:
    """Return accesses from words such as cA0 (code), d01 (data), s04 (status), r83 (data read)."""
    kinds = {"c": ("write", 1), "d": ("write", 0), "s": ("read", 1), "r": ("read", 0)}
    return [Access(t, *kinds[word[0]], int(word[1:], 16)) for t, word in enumerate(script.split())]


@pytest.mark.parametrize(
    ("script", "meaning", "reply"),
    [
        ("c43 d18 d00 d00 s04", "axis 1: accelerate/decelerate, CW, 25 pulses", "BUSY1"),
        (
            "c6C d31 d04 d00 d00 s88",
            "axis 2: constant speed, CCW, rate 49, 5 pulses",
            "BUSY2, ERROR",
        ),
        ("cFB d00 d00 d00 s08", "axis 2: accelerate/decelerate, CCW, 1 pulse", "BUSY2"),
        ("cA0 s01 r95", "axis 2: read end status", "continuous constant speed: ended by the limit"),
        ("c81 r8B", "axis 1: read control inputs", "active: ALM, FHL"),
        ("cA2 r3E", "axis 2: read output signals", "S1 S2 on, HOLD high, CCW"),
        ("c86 r07", "axis 1: read error code", "error 7"),
        ("cD1 s00", "AUXO1 H, AUXO0 L", "ready, nothing pending"),
        ("cC2 r02", "read auxiliary inputs", ""),
        ("cE0 s00", "axis 2: excitation off", "ready, nothing pending"),
        ("c60 s00", "axis 2: immediate stop", "ready, nothing pending"),
        (
            "c36 dFF d4F d64 d00 s20",
            "axis 2: initial setting: 4 phases, half step, internal clock, switched at rest; "
            "RL 255, RH 79, PA 100",
            "CMND2",
        ),
    ],
)
def test_bytes_of_the_2104_in_words(script, meaning, reply):
    """The bytes of a PPMC-2104 host are described as in the manual."""
    (row,) = exchanges(Ppmc2104Decoder(), accesses(script))
    assert (row.meaning, row.reply) == (meaning, reply)


def test_remaining_pulses_know_the_end_of_their_axis():
    """The description of the remaining pulses depends on how the motion of the same axis ended: 0 means one
    pulse if it was stopped, and no pulse if it is complete.
    """
    rows = exchanges(Ppmc2104Decoder(), accesses("c80 rC3 cA0 r83 c83 r00 r00 r00 cA3 r00 r00 r00"))
    assert [row.reply for row in rows[2:]] == ["1 pulse not made", "no pulse left"]


def test_bytes_of_the_104_in_words():
    """For a PPMC-104, the same codes are described without an axis; the error is taken from the status."""
    rows = exchanges(Ppmc104Decoder(), accesses("c43 d18 d00 d00 s04 c42 s94 c80 r83"))
    assert [row.meaning for row in rows] == [
        "accelerate/decelerate, CW, 25 pulses",
        "single step, CW",
        "read finish status",
    ]
    assert rows[1].reply == "BUSY, error 1: not allowed while BUSY"


@pytest.mark.parametrize(
    ("script", "meaning", "reply"),
    [
        ("c43 d18 d00 d00 s04", "accelerate/decelerate, CW, 25 steps", "BUSY"),
        ("c6C d31 d00 d00 d00 s04", "constant speed, CCW, divisor 49, 1 step", "BUSY"),
        ("c4F d19 s04", "constant speed to the reference point, CCW, divisor 25", "BUSY"),
        ("c46 s04", "accelerate to the limit, CW", "BUSY"),
        ("c44 d00 d00 d00 d00 sD0", "constant speed, CW, divisor 0, 1 step", "error 5: divisor 0, or slow"),
        (
            "c80 r9E",
            "read finish status",
            "accelerate to the limit: ended by the limit and the deceleration limit",
        ),
        ("c80 r87", "read finish status", "constant speed to the reference point: found"),
        ("c80 r97", "read finish status", "constant speed to the reference point: ended by the limit"),
        ("c80 rA4", "read finish status", "constant speed: ended by MON low"),
        ("c82 r85", "read inputs", "active: L1, L3, motor off"),
        ("c83 rC6", "read outputs", "S1 S2 high, HOLD high, CCW"),
        ("c84 r01 r00 r00", "read remaining steps", "1 step not made"),
        ("c81 s80", "command 81", "error 0: undefined command, or a stop at rest"),
        (
            "c3A d8D d3B d90 d01 s00",
            "initialise: 4 phases, full step, high = on, external clock, chopped at rest; "
            "slow 141, fast 59, 400 steps of acceleration",
            "ready, nothing pending",
        ),
    ],
)
def test_bytes_of_the_stmc_in_words(script, meaning, reply):
    """The bytes of an STMC host with the read codes of the data sheet are described as in the manual."""
    (row,) = exchanges(StmcDecoder("SHEET"), accesses(script))
    assert row.meaning == meaning
    assert row.reply.startswith(reply)


def registers(script: str) -> list[Access]:
    """Return accesses of a PPMC-312 host.

    `> block` sends and `< block` reads a block in logical order; `p` polls CSR.
    """
    found: list[tuple[str, int, int]] = []
    for line in script.split(";"):
        kind, _, text = line.strip().partition(" ")
        data = bytes.fromhex(text)[::-1]
        if kind == "p":
            found.append(("CSR read", 0, data[0]))
        elif kind == ">":
            found += [("WCR :=", 2, 0x20), ("WAR :=", 3, 0x20 - len(data)), *(("DWR :=", 5, b) for b in data)]
        else:
            found += [("RAR read", 3, 0x40 - len(data)), *(("DRR read", 7, b) for b in data)]
    return [Access(t, *access) for t, access in enumerate(found)]


@pytest.mark.parametrize(
    ("sent", "got", "meaning", "reply"),
    [
        (
            "03 09 00 09 03E8 00C8 0007D0",
            "03 01 00",
            "initial setting: sigmoid, 1 MHz, rates 1000 to 200, 2000 pulses",
            "done",
        ),
        (
            "03 08 82 40 0000 00001388",
            "03 02 82 10",
            "accelerate/decelerate, CCW, high speed, 5000 pulses",
            "triangle",
        ),
        ("03 08 83 00 0064 00000005", "03 02 83 01", "constant speed, CW, rate 100, 5 pulses", "held"),
        ("03 08 87 04 00C8 FFFFFFFE", "03 01 E8", "ramp to rate 200, at position -2", "registered"),
        ("03 02 81 07", "03 02 F7 01", "decelerating stop, on event 1", "not registered 01"),
        ("03 04 11 40 0000", "03 01 F2", "zero return, CCW, high speed", "limit"),
        ("03 01 4D", "03 04 4D 00 10 02", "read status", "state ABN, 2 waiting"),
        ("02 03 01 01 03", "03 03 01 00 03", "free curve: 1 MHz, 3 stages", "3 rates to come"),
        (
            "01 09 000005 000004 000003",
            "03 08 01 0F 00000C 00000C",
            "free curve: data, the last",
            "done: 12 up, 12 down",
        ),
        ("03 02 42 00", "03 06 42 00 FFFFFE3D", "read pulse position", "-451"),
        ("03 01 40", "03 02 40 12", "read version", "version 12"),
    ],
)
def test_blocks_of_the_312_in_words(sent, got, meaning, reply):
    """An instruction of the PPMC-312 and its response are described as in the manual."""
    (row,) = Ppmc312Decoder().exchanges(registers(f"> {sent}; p 14; p 10; < {got}"))
    assert (row.meaning, row.reply) == (meaning, reply)
    assert (row.sent, row.answer) == (list(bytes.fromhex(sent)), list(bytes.fromhex(got)))
    assert row.statuses == [0x14, 0x10]


def test_reports_of_the_312_are_rows_of_their_own():
    """A report after a response has its own row: a stop, the end of an override, an alarm."""
    rows = Ppmc312Decoder().exchanges(
        registers("> 03 02 84 00; < 03 01 84; p 14; < 23 06 E0 40 00000001; < 1B 02 82 00; < 23 02 F4 01")
    )
    assert [row.meaning for row in rows] == ["single pulse, CW", "interrupt", "interrupt", "interrupt"]
    assert [row.reply for row in rows] == [
        "done",
        "stopped at 1: all pulses made",
        "by override: trapezoid",
        "ALARM 01",
    ]


def test_a_report_before_the_answer_has_its_own_row():
    """If a report is read before the response, the response still belongs to its instruction."""
    rows = Ppmc312Decoder().exchanges(registers("> 03 01 40; < 23 02 F4 00; < 03 02 40 12"))
    assert [(row.meaning, row.reply) for row in rows] == [
        ("read version", "version 12"),
        ("interrupt", "ALARM 00"),
    ]


def test_long_blocks_lose_their_end():
    """If a block is too long for its column, only its first bytes are printed."""
    assert hexes([3, 1, 64]) == "03 01 40"
    assert hexes(list(range(20))) == "00 01 02 03 04 05 06 07 08 09 0A …"


def test_waves_name_the_registers(tmp_path):
    """The VCD of a version read contains the pins, and the accesses of the host with register names."""
    recording = Recording("ppmc312", {"CLK_HZ": 16_000_000, "XTAL_HZ": 16_000_000, "TIMING": "FAST"})
    t = 10
    for reg, byte in ((2, 0x20), (3, 0x1D), (5, 0x40), (5, 0x01), (5, 0x03)):
        recording.stimulus += [Change(t, pin, level) for pin, level in
                               (("cs_n", 0), ("we_n", 0), ("rs", reg), ("d_i", byte))]  # fmt: skip
        recording.stimulus += [Change(t + 3, "cs_n", 1), Change(t + 3, "we_n", 1)]
        recording.accesses.append(Access(t + 3, {2: "WCR :=", 3: "WAR :=", 5: "DWR :="}[reg], reg, byte))
        t += 6
    recording.end = t + 200
    recording.edges = replay(recording, new_model(recording.part, recording.params))
    comparison = compare_recording(recording)
    assert comparison.mismatch is None
    target = tmp_path / "waves.vcd"
    waves.write_vcd(comparison, VIEW_312, target)
    text = target.read_text()
    assert all(f" {name} $end" in text for name in ("pout", "auxo3_n", "auxi7", "speed_pps"))
    assert all(f"\nsDWR\\x20:=\\x20{byte} " in text for byte in ("40", "01", "03"))
    assert register_text(Access(0, "DRR read", 7, 0x12)) == "DRR 12"


def test_chopping_is_no_step():
    """A change of the phases counts as a step only if the pattern changes, not if chopping switches it off
    and on.
    """
    changes = [(5, 0b0011), (9, 0), (12, 0b0011), (15, 0), (16, 0b0011), (20, 0b0110), (30, 0), (33, 0b0110)]
    assert steps(changes) == [20]


def test_waves_show_the_steps_of_the_board(tmp_path):
    """The VCD of two steps on the ISA bus contains exactly these steps, although the phases are chopped."""
    recording = Recording("j105_stmc", {"CLK_HZ": 16_000_000, "XTAL_HZ": 16_000_000, "TIMING": "FAST"})
    t = 10
    for reg, byte in ((1, 0x3A), (0, 20), (0, 5), (0, 8), (0, 0), (1, 0x42), (1, 0x42)):
        recording.stimulus += [Change(t, "sa", 0x3B0 + reg), Change(t, "sd_i", byte), Change(t, "iow_n", 0)]
        recording.stimulus += [Change(t + 9, "iow_n", 1)]
        t += 20 if byte in (0x3A, 20, 5, 8) else 40_000
    recording.end = t
    recording.edges = replay(recording, new_model(recording.part, recording.params))
    comparison = compare_recording(recording)
    assert comparison.mismatch is None
    found = waves.motor_pulses(comparison, VIEW_STMC)["motor"]
    assert len(found) == 2
    assert [dict(comparison.actual["s"])[t] for t in found] == [0b00110, 0b01100]
    target = tmp_path / "waves.vcd"
    waves.write_vcd(comparison, VIEW_STMC, target)
    text = target.read_text()
    assert all(f" {name} $end" in text for name in ("drv1", "irq", "sd_oe", "speed_pps"))


def test_waves_show_each_axis(tmp_path):
    """The VCD of a step of axis 2 contains pins, pulse and speed of this axis with its number."""
    recording = Recording("ppmc2104", {"CLK_HZ": 16_000_000, "XTAL_HZ": 16_000_000, "TIMING": "FAST"})
    t = 10
    for reg, byte in ((1, 0x22), (0, 99), (0, 19), (0, 10), (0, 0), (1, 0x62)):
        recording.stimulus += [Change(t, "cs_n", 0), Change(t, "a0", reg), Change(t, "d_i", byte)]
        recording.stimulus += [
            Change(t, "ds_wrs_n", 0),
            Change(t + 3, "cs_n", 1),
            Change(t + 3, "ds_wrs_n", 1),
        ]
        t += 20 if byte else 40_000
    recording.end = t + 2000
    recording.edges = replay(recording, new_model(recording.part, recording.params))
    comparison = compare_recording(recording)
    assert comparison.mismatch is None
    target = tmp_path / "waves.vcd"
    waves.write_vcd(comparison, VIEW_2104, target)
    text = target.read_text()
    for name in ("pout2_n", "run1", "s12_n", "fhl2_n", "ds_wrs_n"):
        assert f" {name} $end" in text
    names = waves.full_names("ppmc2104", VIEW_2104)
    assert names["pins.d_i"] == "pins.d_i[7:0]"
    pins = waves.single_pins(comparison.initial, comparison.actual, VIEW_2104.split)
    assert [level for _, level in pins["pout2_n"][1]] == [0, 1]
    assert not [level for _, level in pins["pout1_n"][1] if level == 0]
    assert pins["s12_n"][0] == 1


def test_every_shown_signal_exists():
    """The saved views name only pins of the part and signals that the demo adds."""
    demos = [row.load("demo") for row in having("demo")]
    for demo in (found for found in demos if isinstance(found, Demo)):
        part = PARTS[demo.part]
        split = {name for names in demo.view.split.values() for name in names}
        pins = split | ({*part.inputs, *part.outputs} - set(demo.view.split))
        for _, group in demo.view.groups:
            for signal in group:
                scope, name = signal.split(".")
                assert scope == "host" or scope in demo.view.motors or name in pins, signal


def test_unknown_part_is_one_line():
    """For a part without a demo, the message lists the parts that have one."""
    assert chosen([]).part == "ppmc104"
    assert chosen(["--part", "ppmc2104"]).part == "ppmc2104"
    assert chosen(["--part", "stmc"]).part == "j105_stmc"
    assert chosen(["--part", "ppmc312"]).part == "ppmc312"
    with pytest.raises(ProjectError, match=r"PART=isa_4axis: .*ppmc104, ppmc2104, stmc, ppmc312"):
        chosen(["--part", "isa_4axis"])
