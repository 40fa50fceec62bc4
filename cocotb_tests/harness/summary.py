"""Last lines of a run: which directed tests were compared with the golden model, and where waves are."""

from __future__ import annotations

from typing import Any

import pytest

from .collect import Item

WAVES_IN = "waves in "
"""Begins the line that a simulation with waves prints."""


def notes(item: Item | None) -> list[tuple[str, Any]]:
    """What the summary has to know of a test, as user properties of its report."""
    if item is None or item.uncompared is None:
        return []
    return [("directed", item.test), ("uncompared", item.uncompared)]


class Summary:
    """Counts in the controlling process, to which xdist forwards every report."""

    def __init__(self) -> None:
        self._seen: dict[str, dict[str, Any]] = {}
        self._waves: list[str] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep what the report of a test that ran says."""
        known = dict(report.user_properties)
        if report.when == "call" and report.outcome != "skipped" and "directed" in known:
            self._seen[report.nodeid] = known
        if report.when == "call":
            self._waves += [line for line in report.capstdout.splitlines() if line.startswith(WAVES_IN)]

    def pytest_terminal_summary(self, terminalreporter: Any) -> None:
        """Write the counts, each reason once, and the waves."""
        if self._waves:
            terminalreporter.section("waves")
            for line in sorted(self._waves):
                terminalreporter.line(line.removeprefix(WAVES_IN))
        if not self._seen:
            return
        reasons: dict[str, set[str]] = {}
        for known in self._seen.values():
            if known["uncompared"]:
                reasons.setdefault(known["uncompared"], set()).add(known["directed"])
        without = sum(bool(known["uncompared"]) for known in self._seen.values())
        compared = len(self._seen) - without
        terminalreporter.section("directed tests")
        terminalreporter.line(f"{compared} compared with the golden model edge by edge, {without} not")
        for reason, tests in sorted(reasons.items()):
            terminalreporter.line(f"  {', '.join(sorted(tests))}: {reason}")
