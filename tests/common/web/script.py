"""Plays sessions of the playground (site/src/engine) on the golden model, for the expected result of each
session.

A line contains statements; `;` ends a statement, `#` begins a comment. docs/playground.md has the list. A
session on the part and the same session here apply the same levels to the pins in the same cycle.
"""

from __future__ import annotations

import re
from collections.abc import Awaitable, Callable, Iterator
from typing import Any

from cocotb_tests.harness.bus import COMMAND, DATA, IBF, OBF, HostBus
from cocotb_tests.harness.model_bench import ModelBench, OnModel, on_model
from openppmc.check.records import Recording, steps
from scripts.site.webparts import Motor, WebPart
from tests.common.web.stations import StationModels

DENSE, FIRST, LONGEST = 16, 4, 8_000
"""Polls: number of polls without a pause (DENSE), first pause (FIRST) and longest pause (LONGEST) in cycles.
Each pause is a quarter longer than the previous one.
"""
PATIENCE = 400_000_000
"""Maximum wait of a statement in cycles."""
RESET = 16
"""Length of a reset in cycles."""
UNITS = {"clk": 0, "us": 1_000_000, "ms": 1_000}
LENGTH = re.compile(r"(\d+(?:\.\d+)?)(clk|us|ms)?")


class ScriptError(ValueError):
    """Raised for a line that is not a statement, or for an answer that differs from the one in the line."""


def statements(text: str) -> Iterator[tuple[int, list[str]]]:
    """Yield (line number, words) of each statement; the words are a keyword and its arguments."""
    for number, line in enumerate(text.splitlines(), 1):
        for part in line.partition("#")[0].split(";"):
            if words := part.split():
                yield number, words


class Pauses:
    """Growing pauses between polls; raises ScriptError if their sum exceeds PATIENCE."""

    def __init__(self, bench: ModelBench) -> None:
        self.bench, self.end, self.count, self.pause = bench, bench.now + PATIENCE, 0, FIRST

    async def next(self) -> None:
        """Wait for one pause."""
        if self.bench.now > self.end:
            raise ScriptError("the polled status does not occur before the time limit")
        self.count += 1
        if self.count >= DENSE:
            self.pause = min(LONGEST, self.pause * 5 // 4 + 1)
            await self.bench.clocks(self.pause)


class Player:
    """Interpreter of a session's text.

    Attributes:
        got: bytes that were read, in order.
    """

    def __init__(self, part: WebPart, **pins: int) -> None:
        self.part = part
        model = StationModels(part) if part.stations else None
        self.bench = ModelBench(part.part, OnModel(part.config), part.settle, model, **{**part.idle, **pins})
        self.got: list[int] = []
        self.mark = self.bench.now
        self.clocks: dict[str, Any] = {}
        self.words: dict[str, Callable[[list[str]], Awaitable[list[str]]]] = {
            "set": self.set_pins,
            "wait": self.wait,
            "pulse": self.pulse,
            "until": self.until,
            "reset": self.reset,
            "clock": self.clock,
        }

    def play(self, text: str) -> Recording:
        """Run the whole text; raise ScriptError with the line of an error."""
        on_model(self._play(text))
        return self.bench.recording()

    async def _play(self, text: str) -> None:
        for number, words in statements(text):
            rest = words
            while rest:
                if rest[0] not in self.words:
                    raise ScriptError(f"line {number}: no such statement: {rest[0]}")
                try:
                    rest = await self.words[rest[0]](rest[1:])
                except (ScriptError, IndexError, ValueError, KeyError, TimeoutError) as error:
                    raise ScriptError(f"line {number}: {' '.join(words)}: {error}") from None

    def check(self, what: str, got: int, words: list[str]) -> list[str]:
        """Store a byte that was read; compare it with that of the text, if any; return the remaining words of
        the statement.
        """
        self.got.append(got)
        if words and re.fullmatch("[0-9A-Fa-f]{2}", words[0]):
            if got != int(words[0], 16):
                raise ScriptError(f"{what} is {got:02X}")
            return words[1:]
        return words

    # ------------------------------------------------------------------ common statements

    async def set_pins(self, words: list[str]) -> list[str]:
        """Set levels of input pins: `set l1_n=0 csel=1`."""
        levels = dict(word.split("=") for word in words)
        self.bench.set(**{pin: int(level, 0) for pin, level in levels.items()})
        return []

    async def wait(self, words: list[str]) -> list[str]:
        """Wait for a time: `wait 400`, `wait 5us`, `wait 2ms`."""
        await self.bench.clocks(self.length(words[0]))
        return words[1:]

    def length(self, text: str) -> int:
        """Return a time in cycles."""
        found = LENGTH.fullmatch(text)
        if not found:
            raise ScriptError(f"{text}: not a time; write 400, 5us or 2ms")
        unit = UNITS[found[2] or "clk"]
        return round(float(found[1]) * self.part.config.clk_hz / unit) if unit else int(float(found[1]))

    async def pulse(self, words: list[str]) -> list[str]:
        """Wait until an axis has made a number of pulses since the last command: `pulse 10`, `pulse 10 2`."""
        first = self.part.first
        axis = int(words[1]) if len(words) > 1 and words[1].isdigit() else first
        motor = self.part.motors[axis - first]
        while self.pulses(motor) < int(words[0]):
            await self.bench.edge(self.output(motor), None if motor.phases else motor.edge, timeout=PATIENCE)
        return words[2 if len(words) > 1 and words[1].isdigit() else 1 :]

    @staticmethod
    def output(motor: Motor) -> str:
        """Return the name of the output with a motor's steps."""
        return motor.step.partition("[")[0] if motor.phases else motor.step

    def pulses(self, motor: Motor) -> int:
        """Return the number of steps that a motor has made since the last command."""
        output = self.output(motor)
        edges = self.bench.edges(output, self.mark)
        if not motor.phases:
            return sum(level == motor.edge for _, level in edges)
        before = [(t, level) for t, level in self.bench.edges(output, 0) if t < self.mark and level]
        return len(steps([*before[-1:], *edges]))

    async def until(self, words: list[str]) -> list[str]:
        """Wait until an output has a level: `until int_n 0`."""
        if self.bench.level(words[0]) != int(words[1]):
            await self.bench.edge(words[0], int(words[1]), timeout=PATIENCE)
        return words[2:]

    async def reset(self, words: list[str]) -> list[str]:
        """Set rst_n low for RESET cycles."""
        self.bench.set(rst_n=0)
        await self.bench.clocks(RESET)
        self.bench.set(rst_n=1)
        await self.bench.clocks(RESET)
        self.mark = self.bench.now
        return words

    async def clock(self, words: list[str]) -> list[str]:
        """Start a square wave with a period in cycles: `clock ext_clk 329`; 0 ends it."""
        pin, period, now = words[0], int(words[1]), self.bench.now

        def changes() -> Iterator[tuple[int, dict[str, int]]]:
            t = now
            while period:
                t += period - period // 2
                yield t, {pin: 1}
                t += period // 2
                yield t, {pin: 0}

        if pin in self.clocks:
            self.clocks.pop(pin).cancel()
        self.bench.set(**{pin: 0})
        if period:
            self.clocks[pin] = self.bench.drive(changes())
        return words[2:]


class BytePlayer(Player):
    """Host for parts with a data register and a register for commands and status."""

    def __init__(self, part: WebPart, **pins: int) -> None:
        super().__init__(part, **pins)
        self.host = HostBus(self.bench)
        self.words |= {
            "c": self.command,
            "d": self.data,
            "w": self.blind,
            "r": self.read,
            "st": self.status,
            "p": self.poll_status,
            "idle": self.idle,
        }

    async def poll(self, mask: int, value: int) -> int:
        """Read the status until the bits of `mask` have this value; return the status."""
        pauses = Pauses(self.bench)
        while (status := await self.host.status()) & mask != value:
            await pauses.next()
        return status

    async def command(self, words: list[str]) -> list[str]:
        self.mark = self.bench.now
        await self.host.write(COMMAND, int(words[0], 16))
        await self.poll(IBF, 0)
        return words[1:]

    async def data(self, words: list[str]) -> list[str]:
        await self.host.write(DATA, int(words[0], 16))
        await self.poll(IBF, 0)
        return words[1:]

    async def blind(self, words: list[str]) -> list[str]:
        self.mark = self.bench.now
        await self.host.write(COMMAND, int(words[0], 16))
        return words[1:]

    async def read(self, words: list[str]) -> list[str]:
        await self.poll(OBF, OBF)
        return self.check("data", await self.host.read(DATA), words)

    async def status(self, words: list[str]) -> list[str]:
        return self.check("status", await self.host.status(), words)

    async def poll_status(self, words: list[str]) -> list[str]:
        await self.poll(0xFF, int(words[0], 16))
        return words[1:]

    async def idle(self, words: list[str]) -> list[str]:
        await self.poll(self.part.busy, 0)
        return words
