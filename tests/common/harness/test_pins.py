"""The pins of the devices in the benches: those of the golden models agree with the ports of the RTL."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import F16, PARTS
from cocotb_tests.harness.build import part_design, ports
from openppmc import parts


@pytest.mark.parametrize("name", list(PARTS))
def test_pins_are_the_ports_of_the_rtl(name: str) -> None:
    """The bench has the ports of the top's header with the same direction, width and lowest bit."""
    part, expected = PARTS[name], {"clk": ("input", 0, 0), "rst_n": ("input", 0, 0)}
    for direction, pins in (("input", part.inputs), ("output", part.outputs)):
        for pin in pins:
            lowest = part.lowest.get(pin, 0)
            expected[pin] = (direction, lowest + part.width(pin) - 1, lowest)
    assert ports(part_design(name, F16)) == expected


@pytest.mark.parametrize("name", list(PARTS))
def test_levels_fit_the_ports(name: str) -> None:
    """Idle and reset levels fit into the width of their ports."""
    part = PARTS[name]
    levels = {**part.inputs, **part.reset_levels()}
    assert [pin for pin, level in levels.items() if level >> part.width(pin)] == []


def test_every_part_with_a_folder_has_a_bench() -> None:
    """The harness finds each device of the table of parts by its name."""
    assert {row.name for row in parts.folders()} <= set(PARTS)
    assert all(PARTS[name].name == name and name in parts.PARTS for name in PARTS)
    assert "isa_4axis" not in PARTS and "nonsense" not in PARTS
