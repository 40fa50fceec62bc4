"""The pages must not give wiring advice that would damage hardware."""

from __future__ import annotations

import re

import pytest

from cocotb_tests.harness import project
from scripts.fpga.boards.__main__ import fitted_parts
from scripts.fpga.boards.description import load_all
from scripts.fpga.boards.pads import Fitted
from scripts.pages.wiring.circuits import uses

PAGES = sorted(
    [*project.DOCS.glob("*/replace.md"), *(project.DOCS / name for name in ("boards.md", "ppmc2104/isa.md"))]
)
NAMES = [page.name for page in PAGES]


def sentences(text: str) -> list[str]:
    """Return the sentences, list items and table cells of a page."""
    return re.split(r"(?<=[.;:])\s+(?=[A-Z*`0-9])|\n(?=[-|#]|\n)|\|", text)


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_transceiver(page: object) -> None:
    """The pages name the 74LVC4245 only in a warning, because its A side has 5 V and its DIR is inverted."""
    text = page.read_text()  # type: ignore[attr-defined]
    wrong = [part for part in sentences(text) if "4245" in part and "Do not use the 74LVC4245" not in part]
    assert not wrong
    assert "74LVC8T245" in text
    assert "VCCA" in text


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_resistors_before_configuration(page: object) -> None:
    """Pull resistors have 2.2 kΩ or 1 kΩ, and a pull-up of an FPGA pin is connected to 3.3 V."""
    text = page.read_text()  # type: ignore[attr-defined]
    assert not re.findall(r"^.*(?:4\.7 kΩ|4\.7 … 10 kΩ) to.*$", text, re.MULTILINE)
    assert not re.findall(r"^.*kΩ to the supply.*$", text, re.MULTILINE)
    held = [
        part for part in sentences(text) if re.search(r"pull-(?:down|up) at (?:its|the|each) (?:d|D)", part)
    ]
    assert not [part for part in held if "kΩ" not in part]
    assert "2.2 kΩ" in text


def test_drivers_that_do_not_fit() -> None:
    """The page mentions the bootstrap of an IR2104; its tables do not list the ULN2004, which needs 5 V
    inputs.
    """
    page = (project.DOCS / "boards.md").read_text()
    assert not [row for row in page.splitlines() if row.startswith("|") and "ULN2004" in row]
    assert [part for part in page.split("\n\n") if "IR2104" in part and "bootstrap" in part]
    assert not [part for part in page.split("\n\n") if "IR2104" in part and "bootstrap" not in part]


def test_optocoupler_of_a_limit_is_fail_safe() -> None:
    """A dark photo-interrupter gives low, which is the active level. Its collector is connected to 3.3 V, its
    emitter to the pin and through a resistor to GND.
    """
    page = (project.DOCS / "boards.md").read_text()
    row = next(line for line in page.splitlines() if line.startswith("|") and "PC817" in line)
    for words in (
        "collector to 3.3 V",
        "emitter to the pin",
        "1 kΩ from the pin to GND",
        "dark = L = active",
    ):
        assert words in row


@pytest.mark.parametrize("family", ["iCE40", "ECP5", "GW1NR", "GW2AR", "Artix-7", "Cyclone V"])
def test_state_before_configuration_is_documented(family: str) -> None:
    page = (project.DOCS / "boards.md").read_text()
    table = page.split("pins before configuration")[1].split("\n\n")[0]
    assert family in table


@pytest.mark.parametrize("line", ["exon_n", "int_n", "irq_n", "rs485_de", "d_oe", "sd_oe"])
def test_lines_active_before_configuration(line: str) -> None:
    """For each signal line, section 4 of boards.md states how the line is held at its idle level."""
    section = (project.DOCS / "boards.md").read_text().split("\n## 4 ")[1].split("\n## 5 ")[0]
    assert f"`{line}`" in section


def test_readme_states_what_was_not_done() -> None:
    """Below the table that says "complete", README.md states what was not tested and what was done
    instead.
    """
    parts = (project.ROOT / "README.md").read_text().split("\n## Parts\n")[1].split("\n## ")[0]
    text = " ".join(parts.split("|")[-1].split())
    for words in (
        "No board has been driven",
        "no motor has turned",
        "no working original chip",
        "What was done:",
    ):
        assert words in text


@pytest.mark.parametrize("one", fitted_parts(load_all()), ids=lambda one: f"{one.board.name}-{one.on.name}")
def test_levels_of_header_pins(one: Fitted) -> None:
    """Outputs have the level of the board's buffers, and no resistor there; every other pin has 3.3 V."""
    level = one.board.buffers.get("level", "3.3 V")
    for use in uses(one):
        for pad in use.pads:
            output = pad.way == "out"
            assert use.level(pad) == (level if output else "3.3 V"), pad.bit
            assert not (output and one.board.buffers and use.pull(pad)), pad.bit


def test_buffered_inputs_are_documented() -> None:
    """The page of a board with buffers states that no limit switch works before the change of the board."""
    (name,) = (board.name for board in load_all() if board.buffers)
    page = (project.DOCS / "boards" / f"{name}.md").read_text()
    assert "The inputs work only after a change of the board" in page
    assert "No limit switch stops the motor then." in page
