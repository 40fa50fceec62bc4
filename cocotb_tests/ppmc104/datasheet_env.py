"""`DatasheetEnv`: an `Env` for the DATASHEET timing model, with the measurements that its tests use."""

from __future__ import annotations

from cocotb_tests.harness import BUSY, IBF

from .env import WRITE_EVENT, Env

TOLERANCE = 16
# A pin may follow the internal event by up to 2 cycles (P104-HSK-03).
PIN = 2
# XTAL cycles of one us at 16 MHz (P104-GEN-02).
US = 16


class DatasheetEnv(Env):
    """`Env` with the measurements that the DATASHEET tests use."""

    def after(self, rule: str, what: str, got: int, xtal_cycles: int, pin: int = PIN) -> None:
        """Check that `got` cycles are CYC(xtal_cycles), with a tolerance of -0/+16 cycles, plus the delay to
        the pin.
        """
        nominal = self.cfg.cyc(xtal_cycles)
        self.window(rule, what, got, nominal, nominal + TOLERANCE + pin)

    async def event(self, code: int, n: int | None = None, rate: int | None = None) -> int:
        """Start an operation; return the write event of its last byte."""
        return await self.go(code, n, rate, poll=False) + WRITE_EVENT

    async def opens(self, rule: str, since: int, xtal_cycles: int, code: int = 0xC1) -> int:
        """Write a command now; check that it is accepted `xtal_cycles` after edge `since`, and not before.

        Return the edge at which the host has read IBF = 0.
        """
        nominal = since + self.cfg.cyc(xtal_cycles)
        await self.host.command(code, poll=False)
        await self.bench.until(max(self.bench.now, nominal - 20))
        while self.bench.now < nominal - 4:
            self.check(rule, "IBF while closed", await self.host.status() & IBF, IBF)
        await self.host.poll(IBF, 0, dense=100)
        self.window(
            rule, "command taken", self.bench.now - since, nominal - since, nominal - since + TOLERANCE + 24
        )
        return self.bench.now

    def full_on_phase(self, rule: str, start: int, off: int, slack: int = 0) -> None:
        """Check that the first OFF phase begins one default ON phase after `start`, to within 1 quantum
        (P104-SW-06).
        """
        nominal, quantum = self.cfg.quanta(260), self.cfg.quanta(1) + 1
        low, high = nominal - quantum, nominal + quantum + PIN + slack
        self.window(rule, "start of chopping to the first OFF phase", off - start, low, high)

    async def rest(self) -> None:
        """Wait until all processing windows have ended, and release the INT of an operation."""
        await self.host.poll(BUSY | IBF, 0)
        await self.finish()
        await self.bench.clocks(self.cfg.us(14) + 40)
