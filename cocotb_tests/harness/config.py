"""The configurations of the RTL under test, and the seeds that one simulation plays one after the other."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

import cocotb

F = TypeVar("F")


@dataclass(frozen=True)
class Config:
    """Parameters of one build. `name` is a part of the test IDs; no name may be a prefix of another name.

    clk_hz and xtal_hz are in Hz; `extra` contains further top-level parameters as (name, value) pairs.
    """

    name: str
    clk_hz: int = 16_000_000
    xtal_hz: int = 16_000_000
    timing: str = "FAST"
    phase_idle: int = 1
    extra: tuple[tuple[str, Any], ...] = field(default=())

    @property
    def datasheet(self) -> bool:
        """Whether the build has the DATASHEET timing model."""
        return self.timing == "DATASHEET"

    @property
    def params(self) -> dict[str, Any]:
        """Parameters of the top module.

        If a device lacks some of these parameters, `Part.params` selects those that it has.
        """
        return {
            "CLK_HZ": self.clk_hz,
            "XTAL_HZ": self.xtal_hz,
            "TIMING": self.timing,
            "PHASE_IDLE": self.phase_idle,
            **dict(self.extra),
        }

    def cyc(self, xtal_cycles: int) -> int:
        """Return CYC(n): the number of cycles for n XTAL cycles, rounded up (P104-GEN-03)."""
        return -(-xtal_cycles * self.clk_hz // self.xtal_hz)

    @property
    def w(self) -> int:
        """W = CYC(80), the pulse and set-up time of 5 µs, in cycles (P104-GEN-03)."""
        return self.cyc(80)

    def quanta(self, n: int) -> int:
        """Return the edge of `clk` at which quantum tick n after its restart occurs (P104-BCK-03)."""
        return self.cyc(4 * n)

    def us(self, micros: float) -> int:
        """Return CYC of a time in µs with a 16 MHz crystal (P104-GEN-02)."""
        return self.cyc(round(micros * 16))

    @property
    def period_ps(self) -> int:
        """Period of `clk` in ps, rounded to an even number so that both halves are whole time steps."""
        return max(2, 2 * round(5e11 / self.clk_hz))

    def to_json(self) -> str:
        """Return the configuration as text for the simulator process."""
        return json.dumps({**self.__dict__, "extra": list(map(list, self.extra))})

    @classmethod
    def from_json(cls, text: str) -> Config:
        """Return the configuration from a text of `to_json`."""
        fields = json.loads(text)
        fields["extra"] = tuple((name, value) for name, value in fields["extra"])
        return cls(**fields)


# Configurations that all parts share. Each configuration costs a build of about 10 s, so add one only if none
# of these is suitable.
F16 = Config("f16")
F8 = Config("f8m", clk_hz=8_000_000)
F11 = Config("f11m", clk_hz=11_059_200)
F25 = Config("f25m", clk_hz=25_000_000)
F48 = Config("f48m", clk_hz=48_000_000)
F50 = Config("f50m", clk_hz=50_000_000, phase_idle=0)
F100 = Config("f100m", clk_hz=100_000_000)
F16X1 = Config("f16x1", xtal_hz=1_000_000, phase_idle=0)
F16X8 = Config("f16x8", xtal_hz=8_000_000)
D16 = Config("d16", timing="DATASHEET")
D11 = Config("d11m", clk_hz=11_059_200, timing="DATASHEET")
D25X8 = Config("d25x8", clk_hz=25_000_000, xtal_hz=8_000_000, timing="DATASHEET", phase_idle=0)

ALL_CONFIGS: tuple[Config, ...] = (F16, F8, F11, F25, F48, F50, F100, F16X1, F16X8, D16, D11, D25X8)
CONFIGS: dict[str, Config] = {config.name: config for config in ALL_CONFIGS}


def configs(*builds: Config) -> Callable[[F], F]:
    """Return a decorator that sets the build configurations of a cocotb test (default: only `F16`)."""
    if not builds:
        raise ValueError("configs() needs at least one Config")

    def mark(test: F) -> F:
        getattr(test, "func", test)._openppmc_configs = builds  # type: ignore[attr-defined]
        return test

    return mark


SEEDS = "OPENPPMC_SEEDS"
_ALONE = re.compile(r"seed -?\d+ alone: make .*")


async def each_seed(test: str, play: Callable[[int], Awaitable[Any]]) -> None:
    """Play the seeds of the batch or the seed of the run; log the command that repeats each seed alone."""
    seeds = os.environ.get(SEEDS, os.environ.get("OPENPPMC_SEED", "1")).split()
    for seed in map(int, seeds):
        if len(seeds) > 1:
            cocotb.log.info("seed %d alone: make test T=%s SEED=%d", seed, test, seed)
        await play(seed)


def last_seed(log: str) -> list[str]:
    """Return the line about the last seed in the log of a batch; an empty list if there is no batch."""
    return _ALONE.findall(log)[-1:]
