"""Master of a serial line with one PPMC-312. Its actions depend on the replies of the station.

The master has a separate UART model: it decodes replies from the levels of txd and checks every edge.
"""

from __future__ import annotations

import re
from fractions import Fraction
from math import ceil
from typing import Any

from cocotb_tests.harness import DutBench, SerialLine, start_bench
from cocotb_tests.harness.bus import clean
from cocotb_tests.harness.line import characters

from .bench import PPMC312
from .directed_host import DirectedHost
from .serial_frames import SPEEDS, T_EXEC, T_INIT, summed

SLACK = 64
"""Maximum number of cycles by which a reply may be late."""
FRAME = re.compile(rb"[\x80-\xFF](?:[0-9a-f]{2})*[\x00-\x7F]", re.DOTALL)


class SerialHost(SerialLine, DirectedHost):
    """Master of the line; create it with `await SerialHost.start(dut)`.

    Instructions are texts of hexadecimal bytes: code and data. Answers are texts: kind without the address,
    then data: "90", "A0 38", "B0 42". `wire` is the last answer as received from the line. `waited` is the
    number of cycles from the end of the master's last stop bit to the rise of snd.
    """

    def __init__(self, bench: DutBench, adr: int = 1, error: float = 0) -> None:
        super().__init__(bench)
        self.adr = adr
        params = {**bench.part.defaults, **bench.part.params(bench.config)}
        self.sum_mode = str(params["SUM_MODE"])
        self.lead, self.wait = int(str(params["SND_LEAD"])), int(str(params["SND_WAIT"]))
        self.wire, self.waited = "", Fraction(0)
        self._behind = self._heard = 0
        self.open_line(Fraction(0), error)

    @classmethod
    async def start(
        cls, dut: Any, *setting: str, mod: int = 7, adr: int = 1, error: float = 0, mode: int = 0
    ) -> SerialHost:
        """Reset a station and wait until it is ready and has acknowledged each instruction of `setting`.

        Args:
            mod: levels of the speed pins MOD.
            adr: number of the station.
            error: relative error of the master's bit time, 0.02 = 2 % too long.
            mode: level of MODE.
        """
        host = cls(await start_bench(dut, PPMC312, settle=8), adr, error)
        host.speed(mod)
        await host.pins(rst_n=0, mode=mode, mod=mod, adr=adr)
        await host.pause(12)
        await host.pins(rst_n=1)
        await host.pause(12)
        await host.bench.level_is("out_oe", 1)
        await host.pause(4)
        for instruction in setting:
            assert await host.ask(instruction) == "90"
        return host

    def speed(self, mod: int) -> None:
        """Set the speed of the master to that of mod; the device changes its speed only at its next reset."""
        config = self.bench.config
        self.bit = config.clk_hz / (SPEEDS.get(mod, SPEEDS[7]) * config.xtal_hz / 16_000_000)

    # ------------------------------------------------------------------ time, pins

    @property
    def t(self) -> int:
        """Next free edge: the next edge of the bench, or the first after the sent characters, whichever is
        later.
        """
        return max(self._behind, self.bench.now)

    @t.setter
    def t(self, edge: int) -> None:
        self._behind = edge

    async def pause(self, clk: int) -> None:
        """Wait for this number of cycles after the sent characters."""
        await self.go(self.t + clk)

    async def pins(self, **levels: int) -> None:
        """Set pin levels from edge `t` on."""
        await self.go(self.t)
        await super().pins(**levels)

    # ------------------------------------------------------------------ to the part

    async def say(self, text: str, adr: int | None = None) -> None:
        """Send an instruction; count pulses from this instruction on."""
        self.mark = self.t
        control = 0x90 + (self.adr if adr is None else adr)
        await self.send(summed(control, bytes.fromhex(text), self.sum_mode))

    async def ask_poll(self, adr: int | None = None) -> None:
        """Send a poll without waiting for its reply."""
        await self.send(summed(0x80 + (self.adr if adr is None else adr), b"", self.sum_mode))

    # ------------------------------------------------------------------ from the part

    def rise(self) -> int | None:
        """Return the edge of the next rise of snd that `hear` has not used yet; None if snd has not risen."""
        return next(iter(self.bench.rises("snd", self._heard)), None)

    async def begin(self, within: int = T_EXEC) -> int:
        """Return the edge of the next rise of snd.

        Raises TimeoutError if the rise is more than `within` cycles after the middle of the last stop bit.
        """
        await self.go(self.t)
        end = ceil(self.middle + max(Fraction(within), self.bit * (1 + self.wait))) + SLACK
        while (rise := self.rise()) is None:
            await self.bench.edge("snd", 1, max(1, end + 1 - self.t))
        assert rise <= end, f"snd rises {rise - end} cycles too late"
        return rise

    async def hear(self, within: int = T_EXEC, timed: bool = True) -> str:
        """Return the next reply, which begins at least SND_WAIT + 0.5 bits after the end of the frame.

        Args:
            timed: True if the last stop bit was the end of the answered frame (P312-SER-18).
        """
        rise = await self.begin(within)
        self.waited = rise - self.middle - self.bit / 2
        late = f"snd rises {float(self.waited):.1f} cycles after the frame"
        assert not timed or self.waited >= self.bit * self.wait + self.bit / 2, late
        while not (falls := self.bench.falls("snd", rise)):
            await self.bench.edge("snd", 0)
        self._heard = falls[0]
        line = self._decode(rise, falls[0])
        self.wire = clean(line.hex())
        return self._meaning(line)

    def _decode(self, rise: int, fall: int) -> bytes:
        """Decode the characters between two edges of snd and check the time of every edge (P312-SER-18)."""
        bit, lead = self.bit, self.lead
        count, rest = divmod(round((fall - rise) / bit) - lead, 10)
        assert not rest and fall == rise + ceil((10 * count + lead) * bit), "snd falls in a character"
        edges = [edge for edge in self.bench.edges("txd", rise) if edge[0] <= fall]
        assert not edges or edges[0][0] >= rise + lead * bit, "too few idle bits before the first character"
        return characters(edges, rise + lead * bit, bit, count)

    def _meaning(self, line: bytes) -> str:
        assert FRAME.fullmatch(line), f"no frame: {self.wire}"
        control, data = line[0], bytes.fromhex(line[1:-1].decode("ascii"))
        assert line == summed(control, data, self.sum_mode), f"wrong checksum: {self.wire}"
        assert control & 0x0F == self.adr, f"not from station {self.adr}: {self.wire}"
        return " ".join([f"{control & 0xF0:02X}", *([clean(data.hex())] if data else [])])

    async def ask(self, text: str, within: int | None = None) -> str:
        """Send an instruction and return its reply."""
        await self.say(text)
        return await self.hear(within or (T_INIT if bytes.fromhex(text)[0] == 0 else T_EXEC))

    async def poll(self, adr: int | None = None) -> str:
        """Send a poll and return its reply."""
        await self.ask_poll(adr)
        return await self.hear()

    async def polls(self, count: int) -> list[str]:
        """Send `count` polls and return their replies."""
        return [await self.poll() for _ in range(count)]

    async def asks(self, *texts: str) -> list[str]:
        """Send instructions one after the other and return their replies."""
        return [await self.ask(text) for text in texts]

    async def status(self) -> str:
        """Return the data of instruction 4D: flags, state, registered instructions."""
        return (await self.ask("4D")).removeprefix("A0 ")

    async def state(self) -> int:
        """Return the state byte of instruction 4D."""
        return int((await self.status()).split()[1], 16)

    def forget(self) -> None:
        """Ignore all replies up to now."""
        self._heard = self.t

    async def quiet(self, clk: int = 2 * T_EXEC) -> bool:
        """Return whether the station sends nothing for this number of cycles."""
        await self.pause(clk)
        return self.rise() is None

    async def settle(self) -> list[str]:
        """Poll until the station is ready; return all other replies except "busy"."""
        others = []
        while (said := await self.poll()) != "90":
            if said != "80":
                others.append(said)
        return others

    async def at_rest(self, after: int = 200, limit: int = 4_000_000) -> None:
        """Wait until the golden model reports the end of the motion, then wait `after` cycles."""
        end = self.t + limit
        while not self.bench.golden.core.operation.at_standstill:
            assert self.t < end, f"the motion does not end\n{self.bench.context()}"
            await self.step()
        await self.pause(after)
