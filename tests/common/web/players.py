"""Hosts of parts with a register window, with blocks, or with frames; their base class is in `script`."""

from __future__ import annotations

from fractions import Fraction
from math import ceil

from cocotb_tests.bank.env import WindowBus
from cocotb_tests.harness.bus import CSR, DRR, DWR, MREF, MWEF, RAR, WAR, WCR, HostBus
from cocotb_tests.harness.line import SerialLine
from openppmc.model.pmc006.line import command
from scripts.site.webparts import WebPart
from tests.common.web.script import PATIENCE, BytePlayer, Pauses, Player, ScriptError


class WindowPlayer(BytePlayer):
    """Host of the bank: `axis 3` selects an axis; `put 9 01`, `get 4 00` access its other registers.

    The other registers are all except 0 (data) and 1 (status and command).
    """

    def __init__(self, part: WebPart, **pins: int) -> None:
        super().__init__(part, **pins)
        self.host = WindowBus(self.bench)
        self.words |= {"axis": self.axis, "put": self.put, "get": self.get}

    async def axis(self, words: list[str]) -> list[str]:
        """Select an axis; axes count from 0, as in the window."""
        self.host.base = int(words[0]) << 4
        return words[1:]

    async def put(self, words: list[str]) -> list[str]:
        """Write a register of the axis."""
        await self.host.write(int(words[0]), int(words[1], 16))
        return words[2:]

    async def get(self, words: list[str]) -> list[str]:
        """Read a register."""
        return self.check("register", await self.host.read(int(words[0])), words[1:])


class BlockPlayer(Player):
    """Host of the PPMC-312: `w 3 15`, `r 3 3D` access a register.

    `> 03 01 40` sends a block, `< 03 02 40 12` checks a block that is received, and `count 30` checks the
    number of pulses.
    """

    def __init__(self, part: WebPart, **pins: int) -> None:
        super().__init__(part, **pins)
        self.host = HostBus(self.bench, 3, 5, 3)
        self.words |= {
            "w": self.write,
            "r": self.read,
            ">": self.block,
            "<": self.response,
            "count": self.count,
        }

    async def write(self, words: list[str]) -> list[str]:
        """Write a register."""
        await self.host.write(int(words[0]), int(words[1], 16))
        return words[2:]

    async def read(self, words: list[str]) -> list[str]:
        """Read a register."""
        return self.check("register", await self.host.read(int(words[0])), words[1:])

    async def _ready(self, bit: int) -> None:
        pauses = Pauses(self.bench)
        while await self.host.read(CSR) & bit:
            await pauses.next()

    async def block(self, words: list[str]) -> list[str]:
        """Write a block when the mailbox is free; return the remaining words of the statement."""
        content = bytes.fromhex("".join(words))[::-1]
        await self._ready(MWEF)
        await self.host.write(WCR, 0x20)
        await self.host.write(WAR, 0x20 - len(content))
        for byte in content:
            await self.host.write(DWR, byte)
        return []

    async def response(self, words: list[str]) -> list[str]:
        """Wait for a block and read it."""
        await self._ready(MREF)
        count = 0x40 - await self.host.read(RAR)
        got = bytes([await self.host.read(DRR) for _ in range(count)])[::-1]
        if words and got != bytes.fromhex("".join(words)):
            raise ScriptError(f"the block is {got.hex(' ').upper()}")
        return []

    async def count(self, words: list[str]) -> list[str]:
        """Check the number of pulses since the beginning or since the last `count`."""
        found = self.pulses(self.part.motors[0])
        self.mark = self.bench.now
        if found != int(words[0]):
            raise ScriptError(f"{found} pulses")
        return words[1:]


class FramePlayer(Player):
    """Host of the PMC006B4: `f v 2000` sends a frame; `f j = 0` also checks the data of the reply.

    `idle` waits until the motor is stopped.
    """

    ADDRESS = 0xFF

    def __init__(self, part: WebPart, **pins: int) -> None:
        super().__init__(part, **pins)
        self.bit = Fraction(part.config.clk_hz, int(str(part.params["BAUD"])))
        self.line = SerialLine()
        self.line.bench = self.bench
        self.line.open_line(self.bit)
        self.words |= {"f": self.frame, "idle": self.idle}

    async def _ask(self, letter: str, data: int) -> int:
        bench = self.bench
        self.line.back_to(bench.now)
        await self.line.send(command(self.ADDRESS, letter, data))
        await bench.until(max(bench.now, self.line.t))
        got = []
        for _ in range(8):
            if bench.level("txd"):
                await bench.edge("txd", 0, timeout=PATIENCE)
            start, byte = bench.now, 0
            for place in range(1, 10):
                await bench.until(start + ceil((place + Fraction(1, 2)) * self.bit))
                byte |= bench.level("txd") << place - 1
            got.append(byte & 0xFF)
        if sum(got[:7]) & 0xFF != got[7]:
            raise ScriptError(f"{bytes(got).hex(' ')}: not a valid reply")
        return int.from_bytes(bytes(got[3:7]), "little")

    async def frame(self, words: list[str]) -> list[str]:
        """Send a frame and check the data of its reply."""
        letter, rest = words[0], words[1:]
        data = 0
        if rest and rest[0] != "=":
            data, rest = int(rest[0], 0), rest[1:]
        if letter in "sz":
            self.mark = self.bench.now
        got = await self._ask(letter, data)
        if rest[:1] == ["="]:
            if got != int(rest[1], 0) & 0xFFFFFFFF:
                raise ScriptError(f"the reply has {got}")
            rest = rest[2:]
        return rest

    async def idle(self, words: list[str]) -> list[str]:
        """Read status 1 every millisecond until the motor is stopped."""
        while await self._ask("j", 0) & 1:
            await self.bench.clocks(self.part.config.clk_hz // 1000)
        return words


PLAYERS: dict[str, type[Player]] = {
    "byte": BytePlayer,
    "window": WindowPlayer,
    "block": BlockPlayer,
    "frame": FramePlayer,
}


def player(part: WebPart, **pins: int) -> Player:
    """Return the host for a part's bus, with the part after power-up."""
    return PLAYERS[part.bus](part, **pins)
