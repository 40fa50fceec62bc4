"""Random hosts of the PPMC-312 that use the state of the device, for the bus and for the line."""

from __future__ import annotations

from cocotb_tests.harness.random_host import RandomHost
from openppmc.model.ppmc312.codes import State


class StateAwareHost(RandomHost):
    """Random host that chooses its next action from the state of the device."""

    @property
    def state(self) -> State:
        """State of the device, read from the model, because a read on the bus would disturb the test."""
        state: State = self.model.state
        return state
