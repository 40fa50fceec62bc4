"""The pin changes from two sources: changes that a golden model has already received keep their places in the
list.
"""

from __future__ import annotations

from cocotb_tests.harness.dut_bench import StimulusLog
from openppmc.check.records import Change


def test_later_changes_follow_earlier_ones() -> None:
    """A change by a test is added after all changes in the list, even if these are at the same edge.

    A model counts the changes that it has received, so it would miss a change that is inserted before them.
    """
    log, driven = StimulusLog(), [Change(3, "rxd", 0)]
    made = {"sda_i": [(4, 0), (7, 1)], "scl_i": [(6, 0)]}
    fed = list(log.add(driven, made))
    assert fed == [Change(3, "rxd", 0), Change(5, "sda_i", 0), Change(7, "scl_i", 0), Change(8, "sda_i", 1)]
    driven.append(Change(8, "rxd", 1))
    made["scl_i"].append((9, 1))
    assert log.add(driven, made) == [*fed, Change(8, "rxd", 1), Change(10, "scl_i", 1)]
    assert log.add(driven, made) == log.changes and len(log.changes) == 6


def test_a_level_that_has_changed_within_its_edge() -> None:
    """If a pin changes twice at one edge, the second level is added after the first one."""
    log = StimulusLog()
    log.add([], {"sda_i": [(4, 0)]})
    assert log.add([], {"sda_i": [(4, 1)]}) == [Change(5, "sda_i", 0), Change(5, "sda_i", 1)]
    assert log.add([], {"sda_i": [(4, 1), (6, 0)]})[2:] == [Change(7, "sda_i", 0)]
