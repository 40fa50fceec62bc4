"""`make lint` compares the tables of the RTL with the netlist; its list of tables is complete."""

from __future__ import annotations

import re

from cocotb_tests.harness import project
from scripts.measure.tables import CLEARED, MEMORIES


def test_every_table_is_known() -> None:
    filled = re.compile(r"^ +initial\b", re.M)
    here = {path.stem for path in project.RTL.rglob("*.sv") if filled.search(path.read_text("utf-8"))}
    assert here == set(MEMORIES) | CLEARED
