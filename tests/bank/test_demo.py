"""`make demo PART=bank` without RTL: the host on the golden model, and the report of wrong pulses."""

from __future__ import annotations

from pathlib import Path

import pytest

from openppmc.check.comparison import Comparison
from openppmc.check.records import Recording
from scripts.demo.bank import demo, waves
from scripts.demo.bank.demo import Played
from scripts.demo.bank.moves import AXES, CLK_HZ, ORDERS
from scripts.demo.bank.picture import draw
from scripts.fpga.flow import plain_sim


@pytest.fixture(scope="module")
def played() -> Played:
    return demo.play()


@pytest.fixture
def pulses(played: Played) -> list[list[int]]:
    return [list(played.session.model.pulses(axis)) for axis in range(AXES)]


def test_no_two_axes_have_the_same_ramp() -> None:
    assert len({one.ramp for one in ORDERS}) == len({(one.rl, one.rh) for one in ORDERS}) == AXES


def test_model_makes_what_was_predicted(played: Played, pulses: list[list[int]]) -> None:
    assert {demo.wrong(one, pulses[one.axis], played) for one in ORDERS} == {""}
    assert {train[0] for train in pulses} == {played.first}


def test_what_is_wrong_is_told(played: Played, pulses: list[list[int]]) -> None:
    one = ORDERS[3]
    train = pulses[3]
    assert demo.wrong(one, train[:-1], played) == f"{one.pulses - 1} pulses, not {one.pulses}"
    late = [train[0] + 1, *train[1:]]
    assert demo.wrong(one, late, played) == f"pulse 1 on edge {played.first + 1}, not {played.first}"
    slow = [*train[:7], train[7] + 1, *train[8:]]
    assert "pulse 8 on edge" in demo.wrong(one, slow, played)
    other = Played(played.session, played.go, [(0xC3, 5)] * AXES)
    assert demo.wrong(one, train, other) == "finish status C3, position 5"
    assert demo.wrong(one, [], played).startswith("0 pulses")


def test_picture_and_waves_of_an_axis_without_pulses(
    played: Played, pulses: list[list[int]], tmp_path: Path
) -> None:
    model = played.session.model
    recording = Recording("bank", {"AXES": AXES, "CLK_HZ": CLK_HZ}, end=model.now, stimulus=model.stimulus)
    initial = demo.TABLE.reset_levels()
    levels = {name: list(model.log.of(name)) for name in initial}
    comparison = Comparison(recording, initial, levels, levels, None, demo.TABLE)
    pulses[4] = []
    draw(comparison, pulses, played.first, tmp_path / "profile.png")
    waves.write(comparison, pulses, tmp_path / "bank.vcd")
    waves.views(tmp_path / "bank.vcd", AXES)
    assert (tmp_path / "profile.png").stat().st_size > 50_000
    text = (tmp_path / "bank.vcd").read_text()
    assert "$scope module axis31 $end" in text and "\n#" in text
    assert "axis31.speed_pps" in (tmp_path / "bank.gtkw").read_text()


def test_wide_ports_go_word_by_word() -> None:
    assert plain_sim.parted(0x3_0000_0002_0000_0001, 3) == [1, 2, 3]
    program = plain_sim.main_cpp(demo.TABLE)
    assert "top->s[4]" in program and "top->s[5]" not in program
    assert "top->pout_n;" in program
