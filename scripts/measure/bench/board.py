"""Speed of the virtual board of the PPMC-104: accesses over its UART, board time and wall time."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from openppmc import sim
from openppmc.host import Ppmc104
from openppmc.host.script import Script

BLOCK = 255
CLK_HZ = 8_000_000
BAUD = 1_000_000
SECONDS = 3.0
HEADS = ["figure", ""]


@dataclass(frozen=True)
class Figures:
    """Figures of one virtual board.

    Attributes:
        accesses: register reads per second in blocks of 255, at the line rate BAUD.
        commands: number of commands with their responses per second.
        initialise: wall time of an initialisation with its ramp table in ms.
        factor: board time divided by wall time during a move.
        clk: cycles per second of processor time, at full speed with the motor in motion.
    """

    accesses: float
    commands: float
    initialise: float
    factor: float
    clk: float

    def rows(self) -> list[list[str]]:
        """Return a table row for each figure; HEADS has the headings."""
        return [
            [f"register accesses/s, blocks of {BLOCK}", f"{self.accesses:,.0f}"],
            ["commands with their response/s", f"{self.commands:,.0f}"],
            ["initialise with a table, ms", f"{self.initialise:,.1f}"],
            ["board time / wall time, motor in motion", f"{self.factor:.2f}"],
            ["million cycles / s of processor time", f"{self.clk / 1e6:.2f}"],
        ]


def rate(work: Callable[[], object], count: int) -> float:
    """Return how often per second `work` can be called; each call counts `count` times."""
    begin, done = time.perf_counter(), 0
    while (passed := time.perf_counter() - begin) < SECONDS:
        work()
        done += count
    return done / passed


def full_speed() -> float:
    """Return the cycles per second of processor time, with the motor in motion."""
    with sim.start("speed=max,cw=2000000000,slow_cw=2000000000") as board, Ppmc104.open(board.port) as axis:
        axis.initialise()
        axis.jog(0, high=True)
        stat = Path(f"/proc/{board.process.pid}/stat")

        def now() -> tuple[int, float]:
            words = stat.read_text().rsplit(")", 1)[1].split()
            return board.status().clk, (int(words[11]) + int(words[12])) / 100

        before = now()
        time.sleep(SECONDS)
        after = now()
        axis.stop()
    return (after[0] - before[0]) / max(0.01, after[1] - before[1])


def measure() -> Figures:
    """Start a virtual board and measure all figures; raise SimError or PpmcError if this fails."""
    with sim.start("cw=2000000000,slow_cw=2000000000") as board, Ppmc104.open(board.port, BAUD) as axis:
        initialise = 1e3 / rate(axis.initialise, 1)
        block = Script().read_many(1, BLOCK)
        accesses = rate(lambda: axis.link.execute(block), BLOCK)
        outputs = Script().call(0x82).get(1)
        commands = rate(lambda: axis.link.execute(outputs), 1)
        axis.jog(0, high=True)
        first, begin = board.status().clk, time.perf_counter()
        time.sleep(SECONDS)
        factor = (board.status().clk - first) / CLK_HZ / (time.perf_counter() - begin)
        axis.stop()
    return Figures(accesses, commands, initialise, factor, full_speed())
