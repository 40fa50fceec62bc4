"""Each table of the RTL is among those whose words `make lint` compares with the netlist's."""

from __future__ import annotations

from cocotb_tests.harness import project
from scripts.flow.tables import CLEARED, MEMORIES


def test_every_table_is_known() -> None:
    here = {path.stem for path in project.RTL.rglob("*.sv") if "\n  initial" in path.read_text("utf-8")}
    assert here == set(MEMORIES) | CLEARED
