"""The demo: bytes in words, single pins of the waves, and the choice of the part. No simulator."""

from __future__ import annotations

import pytest

from cocotb_tests.common.compare import compare_recording, new_model, replay
from cocotb_tests.common.part import PPMC2104
from cocotb_tests.common.stimulus import Access, Change, Recording
from scripts.demo import waves
from scripts.demo.__main__ import chosen
from scripts.demo.demos import DEMOS, VIEW_2104
from scripts.demo.words import exchanges
from scripts.demo.words104 import Words104
from scripts.demo.words2104 import Words2104
from scripts.project import ProjectError


def accesses(script: str) -> list[Access]:
    """Accesses from words such as cA0 (code), d01 (data), s04 (status), r83 (data read)."""
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
    """Given one exchange of a host, then it reads as the manual says."""
    (row,) = exchanges(Words2104(), accesses(script))
    assert (row.meaning, row.reply) == (meaning, reply)


def test_remaining_pulses_know_the_end_of_their_axis():
    """Given axis 1 stopped early and axis 2 complete, then 0 remaining means one pulse and none."""
    rows = exchanges(Words2104(), accesses("c80 rC3 cA0 r83 c83 r00 r00 r00 cA3 r00 r00 r00"))
    assert [row.reply for row in rows[2:]] == ["1 pulse not made", "no pulse left"]


def test_bytes_of_the_104_in_words():
    """Given the same codes for a PPMC-104, then no axis is named and the error is in the status."""
    rows = exchanges(Words104(), accesses("c43 d18 d00 d00 s04 c42 s94 c80 r83"))
    assert [row.meaning for row in rows] == [
        "accelerate/decelerate, CW, 25 pulses",
        "single step, CW",
        "read finish status",
    ]
    assert rows[1].reply == "BUSY, error 1: not allowed while BUSY"


def test_waves_show_each_axis(tmp_path):
    """Given a step of axis 2 in a recording, then the VCD has its pins, its pulse and its speed by name."""
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
    recording.edges = replay(recording, new_model(recording))
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
    """Given the saved views, then each names a pin of its part or one of the signals beside them."""
    for demo in DEMOS.values():
        part = PPMC2104 if demo.part == "ppmc2104" else None
        split = {name for names in demo.view.split.values() for name in names}
        for _, group in demo.view.groups:
            for signal in group:
                scope, name = signal.split(".")
                known = scope == "host" or scope in demo.view.motors or name in split
                assert known or part is None or name in (*part.inputs, *part.outputs), signal


def test_unknown_part_is_one_line():
    """Given a part without a demo, then the message names those that have one."""
    assert chosen([]).part == "ppmc104"
    assert chosen(["--part", "ppmc2104"]).part == "ppmc2104"
    with pytest.raises(ProjectError, match=r"PART=stmc: .*ppmc104, ppmc2104"):
        chosen(["--part", "stmc"])
