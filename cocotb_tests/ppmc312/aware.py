"""What random hosts of the PPMC-312 know of the part's state, on the bus and on the line."""

from __future__ import annotations

from cocotb_tests.harness.random_host import RandomHost
from openppmc.model.ppmc312.codes import State


class Aware(RandomHost):
    """A random host that knows what would make sense."""

    @property
    def state(self) -> State:
        """What the part is doing, to choose what to do next; to ask for it would disturb."""
        state: State = self.model.state
        return state
