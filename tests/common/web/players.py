"""Hosts of parts with a register window, with blocks, or with frames; their base class is in `script`."""

from __future__ import annotations

import re
from fractions import Fraction
from math import ceil

from cocotb_tests.bank.env import WindowBus
from cocotb_tests.harness.bus import CSR, DRR, DWR, MREF, MWEF, RAR, WAR, WCR, HostBus, clean
from cocotb_tests.ppmc312.line.wave import wave
from openppmc.model.pmc006.line import command
from openppmc.model.ppmc312.front.serial import BUSY, INSTRUCTION, POLL, frame
from scripts.site.webparts import Motor, WebPart
from tests.common.web.script import PATIENCE, BytePlayer, Pauses, Player, ScriptError

REPLY_S, POLL_S = 0.025, 0.005
"""Limit for the begin of a reply, and pause between the polls of `idle`, in seconds."""


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


class CharacterPlayer(Player):
    """Host of a serial line with the pins rxd and txd of the part."""

    def __init__(self, part: WebPart, **pins: int) -> None:
        super().__init__(part, **pins)
        self.bit = Fraction(part.bit or Fraction(part.config.clk_hz, int(str(part.params["BAUD"]))))

    def drive(self, level: int) -> None:
        """Set the level of the line to the part."""
        self.bench.set(rxd=level)

    def heard(self) -> int:
        """Return the level of the line from the part."""
        return self.bench.level("txd")

    async def fall(self, limit: int) -> bool:
        """Wait until the line from the part is low; return False if this takes more than `limit` cycles."""
        try:
            await self.bench.edge("txd", 0, timeout=limit)
        except TimeoutError:
            return False
        return True

    async def say(self, data: bytes) -> None:
        """Send characters back to back; return when the line is free again."""
        for byte in data:
            start = self.bench.now
            for t, level in wave(bytes([byte]), start, self.bit):
                await self.bench.until(t)
                self.drive(level)
            await self.bench.until(ceil(start + 10 * self.bit))

    async def hear(self, limit: int) -> int | None:
        """Receive a character; return None if it does not begin within `limit` cycles."""
        if self.heard() and not await self.fall(limit):
            return None
        start, byte = self.bench.now, 0
        for place in range(1, 10):
            await self.bench.until(start + ceil((place + Fraction(1, 2)) * self.bit))
            byte |= self.heard() << place - 1
        return byte & 0xFF


class FramePlayer(CharacterPlayer):
    """Host of the PMC006B4: `f v 2000` sends a frame; `f j = 0` also checks the data of the reply.

    `idle` waits until the motor is stopped.
    """

    ADDRESS = 0xFF

    def __init__(self, part: WebPart, **pins: int) -> None:
        super().__init__(part, **pins)
        self.words |= {"f": self.frame, "idle": self.idle}

    async def _ask(self, letter: str, data: int) -> int:
        await self.say(command(self.ADDRESS, letter, data))
        got = [await self.hear(PATIENCE) or 0 for _ in range(8)]
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


class LinePlayer(CharacterPlayer):
    """Host of PPMC-312 stations: `axis 3` selects a station; `unplug 3`, `plug 3` change its connection.

    `> 42` sends an instruction, `< A0 00000000` checks its reply, `? 90` polls; `m` and `s` are the raw
    characters. `idle` polls until the station is not busy, and `count` checks its pulses.
    """

    def __init__(self, part: WebPart, **pins: int) -> None:
        super().__init__(part, **pins)
        self.station, self.unplugged = 1, 0
        self.everywhere = (1 << len(part.motors)) - 1
        self.marks = dict.fromkeys(range(len(part.motors)), self.bench.now)
        self.words |= {
            "axis": self.axis,
            "unplug": self.unplug,
            "plug": self.plug,
            ">": self.instruction,
            "<": self.form,
            "?": self.poll,
            "m": self.raw,
            "s": self.characters,
            "idle": self.idle,
            "count": self.count,
        }

    def drive(self, level: int) -> None:
        """Set the level that all connected stations receive."""
        self.bench.set(rxd=self.everywhere if level else self.unplugged)

    def heard(self) -> int:
        """Return the level of the line to the master."""
        return int(not self.bench.level("snd") & ~self.bench.level("txd") & ~self.unplugged)

    async def fall(self, limit: int) -> bool:
        """Wait until a station makes the line low; return False if this takes more than `limit` cycles."""
        end = self.bench.now + limit
        while self.heard():
            try:
                await self.bench.edge("txd", timeout=end - self.bench.now)
            except TimeoutError:
                return False
        return True

    async def axis(self, words: list[str]) -> list[str]:
        """Select a station."""
        self.station = int(words[0])
        return words[1:]

    async def unplug(self, words: list[str]) -> list[str]:
        """Disconnect a station from the line."""
        self.unplugged |= 1 << int(words[0])
        self.drive(1)
        return words[1:]

    async def plug(self, words: list[str]) -> list[str]:
        """Connect a station to the line."""
        self.unplugged &= ~(1 << int(words[0]))
        self.drive(1)
        return words[1:]

    async def instruction(self, words: list[str]) -> list[str]:
        """Send an instruction to the station."""
        await self.say(frame(INSTRUCTION | self.station, bytes.fromhex("".join(words))))
        return []

    async def raw(self, words: list[str]) -> list[str]:
        """Send characters."""
        await self.say(bytes.fromhex("".join(words)))
        return []

    async def reply(self) -> bytes:
        """Return the characters of a reply; b"" if there is no reply."""
        got, limit = bytearray(), round(REPLY_S * self.part.config.clk_hz)
        while (byte := await self.hear(limit)) is not None:
            got.append(byte)
            limit = round(1.5 * self.bit)
        return bytes(got)

    def compare(self, words: list[str], got: str) -> list[str]:
        """Compare a reply with the text, if the text has one; `-` is no reply."""
        self.got += bytes.fromhex(got)
        if words and words != ["-"] * (not got) and clean("".join(words)) != clean(got):
            raise ScriptError(f"the reply is {got or '-'}")
        return []

    async def characters(self, words: list[str]) -> list[str]:
        """Receive a reply, and compare its characters."""
        return self.compare(words, (await self.reply()).hex(" "))

    async def form(self, words: list[str]) -> list[str]:
        """Receive a reply, and compare its kind and data."""
        return self.compare(words, self.shown(await self.reply()))

    @staticmethod
    def shown(reply: bytes) -> str:
        """Return the kind and the data of a reply; only the kind if its data are not digits."""
        text = reply[1:-1].decode("latin-1")
        data = text if re.fullmatch("([0-9a-f]{2})*", text) else ""
        return bytes([reply[0] & 0xF0, *bytes.fromhex(data)]).hex(" ") if reply else ""

    async def poll(self, words: list[str]) -> list[str]:
        """Poll the station, and compare the reply."""
        await self.say(frame(POLL | self.station))
        return await self.form(words)

    async def idle(self, words: list[str]) -> list[str]:
        """Poll the station until it is not busy."""
        while True:
            await self.say(frame(POLL | self.station))
            reply = await self.reply()
            if not reply:
                raise ScriptError("no reply")
            if reply[0] & 0xF0 != BUSY:
                return words
            await self.bench.clocks(round(POLL_S * self.part.config.clk_hz))

    def pulses(self, motor: Motor) -> int:
        """Return the number of steps of a motor since the beginning or the last `count` of its station."""
        since = self.marks[self.part.motors.index(motor)]
        return sum(level for _, level in self.bench.edges(motor.step, since))

    async def pulse(self, words: list[str]) -> list[str]:
        """Wait for pulses of the station, unless the statement names another one."""
        named = len(words) > 1 and words[1].isdigit()
        return await super().pulse(words if named else [words[0], str(self.station), *words[1:]])

    async def reset(self, words: list[str]) -> list[str]:
        """Reset all stations, and count the pulses from then on."""
        rest = await super().reset(words)
        self.marks = dict.fromkeys(self.marks, self.mark)
        return rest

    async def count(self, words: list[str]) -> list[str]:
        """Check the pulses of the station since the beginning or since its last `count`."""
        found = self.pulses(self.part.motors[self.station])
        self.marks[self.station] = self.bench.now
        if found != int(words[0]):
            raise ScriptError(f"{found} pulses")
        return words[1:]


PLAYERS: dict[str, type[Player]] = {
    "byte": BytePlayer,
    "window": WindowPlayer,
    "block": BlockPlayer,
    "frame": FramePlayer,
    "line": LinePlayer,
}


def player(part: WebPart, **pins: int) -> Player:
    """Return the host for a part's bus, with the part after power-up."""
    return PLAYERS[part.bus](part, **pins)
