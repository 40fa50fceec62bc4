"""Well-behaved random host of the PPMC-312, which keeps the device active with one scenario after the other.

Most hosts read all answers; a minority reads only some of them. The host clears alarms, and uses short tables
so that complete operations fit into a run. In some cases it misuses the device.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from cocotb_tests.harness.bus import CSR, MREF, MWEF
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import Code, State

from .host import Host
from .scenario_host import ScenarioHost

Scenes = tuple[tuple[Callable[[], Any], int], ...]


class ReactiveHost(ScenarioHost):
    """One well-behaved random host."""

    def __init__(self, host: Host, seed: int) -> None:
        super().__init__(host, seed)
        self.reads = self.rng.choice((1.0, 1.0, 1.0, 1.0, 1.0, 0.97, 0.8))
        self.end = self.host.t + (900_000 if self.slow else 120_000)

    async def play(self) -> None:
        """Play scenarios until the time is over."""
        rng, host = self.rng, self.host
        await host.write(CSR, rng.choice((0, 0, 0x10, 0x20, 0x30, 0x40, 0x70)))
        if rng.random() < 0.25:
            self.disturb_pins()
        await self.curve()
        scenes = self.scenes()
        while host.t < self.end:
            await self.pick(scenes)()
            await self.settle()
        await self.recover()

    def scenes(self) -> Scenes:
        """Return the scenarios with their relative frequency."""
        return (
            (self.finite, 26),
            (self.endless, 14),
            (self.changes_near_deceleration, 6),
            (self.walk_change, 3),
            (self.start_on_a_limit, 3),
            (self.overrides, 16),
            (self.events, 12),
            (self.coincident_events, 8),
            (self.origin, 6),
            (self.slow_limit, 7),
            (self.inputs, 5),
            (self.encoder, 8),
            (self.interlock, 4),
            (self.start_while_run_is_low, 4),
            (self.end_wait, 5),
            (self.alarm, 3),
            (self.several, 8),
            (self.unread, 4),
            (self.misuse, 5),
            (self.curve, 4),
        )

    async def misuse(self) -> None:
        """Perform one action that misuses the device."""
        await self.rng.choices(
            (self.bad_block, self.registers, self.reset, self.setting, self.motion, self.registration),
            (3, 2, 1, 1, 1, 1),
        )[0]()

    async def several(self) -> None:
        """Send any instructions, one after the other."""
        for _ in range(self.rng.randint(1, 5)):
            if self.rng.random() < 0.5:
                await self.send_block(
                    self.block(self.rng.choice((0x26, 0x42, 0x4D, 0x25, 0x27, 0x47, 0x84, 0x43))).hex()
                )
            else:
                await self.instruction()
                await self.attend(100)

    async def settle(self) -> None:
        """Bring the device to standstill, mostly in state NOR, after all responses were read."""
        host, rng = self.host, self.rng
        for pin in ("run", "end_n", "fl_n", "bl_n", "fhl_n", "bhl_n", "alm_n", "org_n"):
            if not host.bench.pin(pin) and rng.random() < 0.95:
                await host.pins(**{pin: 1})
        for attempt in range(8):
            if self.state in (State.ACC, State.FIX):
                await self.attend(2_500 if self.model.motion.active and attempt < 3 else 400)
            if self.state in (State.ACC, State.FIX) and attempt in (2, 4, 6):
                await self.send_block(
                    rng.choice(
                        (
                            message(Code.STOP, "00"),
                            message(Code.SLOW_STOP, "00"),
                            message(Code.SLOW_STOP, "00"),
                        )
                    )
                )
            elif self.state is State.ABN:
                await self.attend(60)
                await self.send_block(message(Code.ALARM_CLEAR))
            elif self.state is State.INI:
                await self.curve()
            elif self.state is State.WRN:
                await self.send_block(message(Code.RUN_MONITOR))
            elif self.state is State.NOR:
                break
        await self.attend(rng.choice((0, 60, 600)))
        while not await host.read(CSR) & MREF and not await host.read(CSR) & MWEF:
            if rng.random() > self.reads:
                break
            await self.response()


class UnsortedHost(ReactiveHost):
    """Host with tables whose rates are not monotonic (P312-BAD-15), which often changes the speed."""

    def order(self, rates: list[int]) -> list[int]:
        """Return the rates with the fastest first, the slowest last, and the others in any order."""
        return [rates[0], *self.rng.sample(rates[1:-1], len(rates) - 2), rates[-1]]

    def scenes(self) -> Scenes:
        return (
            (self.changes_at_pulses, 60),
            (self.changes_near_deceleration, 5),
            (self.endless, 10),
            (self.overrides, 5),
            (self.origin, 5),
            (self.slow_limit, 5),
            (self.curve, 10),
        )

    async def changes_at_pulses(self) -> None:
        """Make a move; change the speed after certain pulses, most of them near the deceleration point."""
        rng, host = self.rng, self.host
        await self.send_block(self.finite_block(rng.choice((0, 0, 3, 12, 30))).hex())
        for _ in range(rng.randint(1, 5)):
            motion = self.model.motion
            if not motion.active or motion.sequence.plan.n is None:
                return
            sequence = motion.sequence
            left = sequence.plan.n - sequence.plan.down - sequence.done
            goal = sequence.done + rng.choice((rng.randint(0, 5), left + rng.randint(-8, 2)))
            while self.model.motion.active and sequence.done < goal and host.t < self.end:
                await self.attend(8)
            await self.send_block(self.change_block(codes=(0x81, *[0x87] * 6, *[0x88] * 4)).hex())
        await self.attend(2_000)
