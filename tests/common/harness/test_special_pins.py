"""Constraint files against special_pins.py: they use no pin unsafely, and each other function is
documented.
"""

from __future__ import annotations

import re

import pytest

from cocotb_tests.harness import project
from cocotb_tests.harness.paths import ROOT
from tests.common.harness.special_pins import SPECIAL, Kind, Special
from tests.common.harness.test_boards import ALL, CONSTRAINTS, pins, ports

USED = [entry[1] for entry in ALL]
TOPS = {entry[1]: entry[0] for entry in ALL}
STOPS = re.compile(r"(l[1-4]|fh?l|bh?l|alm)_n(\[\d\])?|mon")
"""Ports that stop a motor: limits, alarm, MON. They must always read the correct level; any other input may
read a wrong level until a plug is removed.
"""


def board(file: str) -> str:
    """Return the board's name: the folder of its constraint files."""
    return file.split("/")[0]


def uses(file: str) -> list[tuple[str, str, Special]]:
    """Return (port, pin, its other function) for a constraint file."""
    pairs = pins((CONSTRAINTS / file).read_text(), (CONSTRAINTS / file).suffix)
    return [
        (port, pin, special) for port, pin in pairs for special in SPECIAL[board(file)] if pin in special.pins
    ]


def describe(name: str) -> dict[str, set[str]]:
    """Return other function -> pins, from the table of a board in docs/boards.md."""
    page = (project.DOCS / "boards.md").read_text()
    found = re.search(rf"<!-- special {name} -->(.*?)<!-- /special {name} -->", page, re.DOTALL)
    rows = re.findall(r"^\| ([^|]+) \| ([^|]+) \| [^|]+ \|$", found[1] if found else "", re.MULTILINE)
    return {job: set(re.findall(r"`(\w+)`", names)) for names, job in rows}


@pytest.mark.parametrize("name", sorted({board(file) for file in USED}))
def test_second_functions_are_documented(name: str) -> None:
    """Every used pin with another function is in the board's table, in the row of that function."""
    used = {(special.job, pin) for file in USED if board(file) == name for _, pin, special in uses(file)}
    page = {(job, pin) for job, names in describe(name).items() for pin in names}
    assert used <= page, f"not told: {sorted(used - page)}"


@pytest.mark.parametrize("file", USED)
def test_no_use_of_configuration_and_control_pins(file: str) -> None:
    never = [
        f"{port} at {pin}: {special.job}" for port, pin, special in uses(file) if special.kind is Kind.NEVER
    ]
    assert not never


@pytest.mark.parametrize("file", USED)
def test_nothing_drives_against_an_output_or_holds_a_limit(file: str) -> None:
    outputs = {bit for port in ports(TOPS[file]).values() if port.direction != "input" for bit in port.bits}
    unsafe = [
        f"{port} at {pin}: {special.job}"
        for port, pin, special in uses(file)
        if special.kind is Kind.DRIVEN and (port in outputs or STOPS.fullmatch(port))
    ]
    assert not unsafe


def test_sources_are_named() -> None:
    for name, specials in SPECIAL.items():
        each = [pin for special in specials for pin in special.pins]
        assert len(each) == len(set(each)), name
        assert all(special.source for special in specials)


@pytest.mark.parametrize("port", ["l1_n", "fl_n", "fl_n[2]", "bl_n", "fhl_n", "bhl_n[1]", "alm_n", "mon"])
def test_stops_are_known(port: str) -> None:
    assert STOPS.fullmatch(port)


def test_boot_pin_of_the_esp32_follows_the_revision():
    """`wifi_gpio0` is pin F1 on the ULX3S v3.1.6 and newer, pin L2 before; no file uses both pins."""
    for board, pin, other in (("ulx3s", "L2", "F1"), ("ulx3s_v31", "F1", "L2")):
        for path in sorted((ROOT / "constraints" / board).rglob("*.lpf")):
            text = path.read_text(encoding="utf-8")
            assert f'LOCATE COMP "wifi_gpio0" SITE "{pin}"' in text, path
            assert f'SITE "{other}"' not in text, path
