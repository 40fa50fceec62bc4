"""The C driver of the PMC006B4 on the Verilated part with its EEPROM; characters pass over the line."""

from __future__ import annotations

from dataclasses import replace

import pytest

from cocotb_tests.harness import F8
from cocotb_tests.harness.build import part_design
from cocotb_tests.harness.paths import ROOT
from tests.common.packages.c_programs import BENCH, DRIVER, Lines, pulses, result, simulate

pytestmark = pytest.mark.xdist_group("cdriver_006")  # one worker builds and runs the programs

OK, TIMEOUT, BAD_ARGUMENT, UNCONFIRMED, UNKNOWN_POSITION, BAD_REPLY = 0, 16, 18, 19, 20, 21
REFUSED, BUSY, EEPROM = 96, 97, 98
TOP = "pmc006_line"


@pytest.fixture(scope="module")
def lines() -> Lines:
    """Return the lines of tb/cdriver/frame_test.c: first words -> its lines, each as name -> value."""
    design = part_design("pmc006", F8)
    models = [ROOT / "tb" / "pmc006" / "eeprom_24c32.sv", BENCH / f"{TOP}.sv"]
    design = replace(design, sources=[*design.sources, *models])
    sources = [DRIVER / "ppmc104.c", DRIVER / "pmc006.c", BENCH / "frame_test.c", BENCH / "frame_bus.cpp"]
    return simulate("cdriver_006", TOP, design, sources)


def end(lines: Lines, name: str) -> dict[str, int]:
    """Return the decoded end of a motion."""
    line = next(line for line in lines[name] if "wait" in line)
    return {key: int(value) for key, value in line.items() if key not in ("at", "text")}


def position(lines: Lines, name: str) -> tuple[int, int]:
    """Return (result, position) of a line."""
    return int(lines[name][0]["result"]), int(lines[name][0]["position"])


@pytest.mark.parametrize(
    ("name", "steps", "at"), [("move", 400, 500), ("back", -50, 450), ("F lost", 60, 137)]
)
def test_move(lines, name, steps, at):
    """A move makes the commanded steps and ends confirmed, even if the reply to the start is lost."""
    got = end(lines, name)
    assert (got["wait"], got["complete"], got["steps"], got["position"]) == (OK, 1, steps, at)
    assert pulses(lines, name)[:2] == (max(steps, 0), max(-steps, 0))


def test_positions(lines):
    """A position is unknown until it is set (P006-CMD-30)."""
    assert position(lines, "unknown")[0] == result(lines, "unknown to")[0] == UNKNOWN_POSITION
    assert position(lines, "after back") == (OK, 450)
    assert result(lines, "there")[0] == BAD_ARGUMENT
    assert result(lines, "move again")[0] == BUSY


def test_speed_mode_and_stops(lines):
    """A run can be stopped with its ramp or immediately, a move only immediately (P006-CMD-06,
    P006-CMD-11).
    """
    for name in ("open", "speed", "zero", "run", "faster", "slowly", "stop"):
        assert result(lines, name)[0] == OK, name
    slowly, stop = end(lines, "slowly"), end(lines, "stop")
    assert (slowly["wait"], slowly["complete"], slowly["stopped"]) == (OK, 0, 1)
    assert slowly["steps"] == pulses(lines, "slowly")[0] >= 400
    assert (stop["wait"], stop["complete"], stop["stopped"]) == (OK, 0, 1)
    assert -stop["steps"] == pulses(lines, "stop")[1]
    assert result(lines, "long slowly")[0] == result(lines, "nothing")[0] == REFUSED


def test_switch_and_home(lines):
    """EXT2 ends a move and rejects the next one; homing finds EXT1, moves off it and sets 0 (P006-EXT-01)."""
    got = end(lines, "ext")
    assert (got["wait"], got["complete"], got["ext1"], got["ext2"]) == (OK, 0, 0, 1)
    assert result(lines, "ext refused")[0] == REFUSED
    assert result(lines, "home")[0] == OK
    assert pulses(lines, "home")[0] == 20 and pulses(lines, "home")[1] in (40, 41)
    assert position(lines, "at home") == (OK, 0)
    assert lines["home"][-1]["ext_on"] == "3"


def test_settings(lines):
    """Each setting accepts its whole range, and a read returns it; a value outside the range is not sent."""
    assert len(lines["setting"]) == 14
    for line in lines["setting"]:
        assert (line["set"], line["get"], line["ok"]) == ("00", "00", "1"), line
        assert (line["below"], line["above"]) == (str(BAD_ARGUMENT),) * 2, line


def test_bad_arguments(lines):
    """A value out of range is an error."""
    named = [name for name in lines if name.startswith("A ")]
    assert len(named) == 15
    assert {result(lines, name)[0] for name in named} == {BAD_ARGUMENT}


def test_outputs_version_release(lines):
    """Outputs have the commanded levels, the version is read, and a motor without current rejects a move."""
    assert lines["version"][0]["value"] == str(0x123)
    assert lines["pins"][0]["gpo"] == "15"
    assert [line["result"] for line in lines["release"]] == ["0", "0"]
    assert result(lines, "released")[0] == REFUSED


def test_memory(lines):
    """After a save, address and current survive a reset; a missing EEPROM is an error (P006-CMD-41)."""
    for name in ("address", "current", "save", "save again", "open", "program", "burn", "run", "halt"):
        assert result(lines, f"M {name}")[0] == OK, name
    assert lines["M kept"][0]["value"] == "1200"
    assert result(lines, "M missing")[0] == EEPROM


def test_program(lines):
    """A loaded program runs; no program can be loaded while it runs; a halt does not end its motion
    (P006-CMD-47).
    """
    assert result(lines, "M while")[0] == REFUSED
    assert sum(pulses(lines, "M run")[:2]) == 200
    assert lines["M pins"][0]["gpo"] == "02"


@pytest.mark.parametrize("name", ["sum", "head", "address"])
def test_damaged_replies(lines, name):
    """If the reply to a read instruction is damaged, the instruction is repeated (P006-FRM-01)."""
    assert position(lines, f"F {name}") == (OK, 77)


def test_lost_reply_to_a_start(lines):
    """If the reply to a start is damaged, the start is not repeated: the motor makes the steps only once."""
    assert result(lines, "F lost")[0] == BAD_REPLY
    assert position(lines, "F where") == (OK, 137)
    assert result(lines, "F absent")[0] == TIMEOUT


def test_reset(lines):
    """If a reset occurs during a motion, its end is unconfirmed; after any reset the position is unknown."""
    assert end(lines, "U move")["wait"] == UNCONFIRMED
    assert position(lines, "U where")[0] == UNKNOWN_POSITION
    assert position(lines, "U set") == (OK, 500)
    assert position(lines, "U rest")[0] == UNKNOWN_POSITION
