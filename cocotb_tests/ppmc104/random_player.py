"""Player for the action lists of `random_host` on a test bench."""

from __future__ import annotations

from cocotb_tests.harness import DutBench
from cocotb_tests.harness.player import SinglePlayer
from cocotb_tests.ppmc104.random_host import Scenario


class HostPlayer(SinglePlayer):
    """Plays one scenario: `await HostPlayer(bench, scenario).run()`."""

    def __init__(self, bench: DutBench, scenario: Scenario) -> None:
        super().__init__(bench, scenario, "P104-BAD-23")
