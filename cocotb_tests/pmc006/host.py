"""Host on the link of a PMC006; its actions depend on the replies of the part.

The host has a separate UART model: it decodes replies from the levels of txd and de, and checks every edge
(docs/pmc006/README.md, 3).
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import ceil
from typing import Any, TypeVar

from cocotb_tests.harness import DutBench, SerialLine, start_bench
from cocotb_tests.harness.line import characters
from openppmc.check.records import Access

from .bench import PMC006, WITH_EEPROM
from .chip import Chip, Eeprom, plug_in
from .frames import command, number, of_reply
from .view import View

H = TypeVar("H", bound="Host")

SYNC = 2
"""Cycles from a change of an input pin to its effect in the part."""
STARTS = tuple(b"szN")
NEAR = 8
"""Tolerance of the edges of de and txd in cycles."""
ACT = 4
"""Cycles from e (the stop-bit sample of a frame) to the effect of the frame, if no other instruction is
executed.
"""
EXECUTE = 64
"""Maximum number of cycles from the end of a frame to its effect."""
START = 1024
"""Maximum number of cycles from the end of a frame to t = 0 of a motion, in addition to 1 us."""


class Host(View, SerialLine):
    """Host of one part; create it with `await Host.start(dut)`.

    `t` is the next free edge; every method advances it. Instruction codes are letters or numbers. Data and
    answers are numbers; an answer is the 32-bit reply data, unsigned. `wire` contains the bytes of the last
    reply as received from the line, `frame_start` the edge at which the last frame from the host began.

    Attributes:
        params: parameters of the part.
    """

    def __init__(self, bench: DutBench, address: int = 0xFF, error: float = 0) -> None:
        self.bench = bench
        self.params: Mapping[str, Any] = {**bench.part.defaults, **bench.part.params(bench.config)}
        self.clk_hz, self.baud = int(self.params["CLK_HZ"]), int(self.params["BAUD"])
        self.echo = self.params["STEP_ACK"] == "ECHO"
        self.address = address
        self.t = bench.now
        self.mark = self.frame_start = self._reply_end = 0
        self.wire = b""
        self.plugged: Eeprom | None = None
        self.open_line(Fraction(self.clk_hz, self.baud), error)

    @classmethod
    async def start(
        cls: type[H],
        dut: Any,
        address: int = 0xFF,
        levels: Mapping[str, int] | None = None,
        boot: bool = True,
        error: float = 0,
        chip: Chip | None = None,
    ) -> H:
        """Return a host with a part just out of reset, which has booted unless `boot` is false.

        Args:
            address: node address to which the host sends.
            levels: levels of input pins from edge 0 on.
            error: relative error of the bit time of the host.
            chip: the EEPROM, for tests whose bench has one (test_memory.py). Without `chip`, SDA is held low,
                so that the part boots immediately; sda_i=1 in `levels` overrides this.
        """
        idle = {} if chip else {"sda_i": 0}
        bench = await start_bench(
            dut, WITH_EEPROM if chip else PMC006, settle=0, **{**idle, **(levels or {})}
        )
        host = cls(bench, address, error)
        if chip:
            host.plugged = plug_in(bench, chip, host.clk_hz, int(host.params["EE_DEV"]))
        host.t = 1 if idle or levels else 0
        if boot:
            await host.boot()
        return host

    # ------------------------------------------------------------------ time

    def pick(self, literal: int, short: int) -> int:
        """Return `literal` if the test runs on the golden model, `short` if it runs on the RTL."""
        return literal if self.literal else short

    @property
    def eeprom(self) -> Eeprom:
        """EEPROM that `start` has connected."""
        assert self.plugged is not None, "there is no EEPROM"
        return self.plugged

    @property
    def literal(self) -> bool:
        """Whether the test uses the long times and counts of the manual, as it does on the golden model."""
        return not self.bench.simulated

    async def sync(self) -> None:
        """Run the part to the present edge."""
        await self._to(max(self.bench.now, self.t))

    async def _to(self, edge: int) -> None:
        """Run the part to just before an edge."""
        await self.bench.until(edge)

    async def go(self, t: int) -> None:
        """Run to just before edge t, at which the next access or pin change occurs."""
        self.t = t
        await self.sync()

    async def pause(self, clk: int) -> None:
        """Wait for this number of cycles."""
        await self.go(self.t + clk)

    async def wait_us(self, micros: float) -> None:
        """Wait for this time in microseconds."""
        await self.pause(self.us(micros))

    async def ms(self, millis: float) -> None:
        """Wait for this time in milliseconds."""
        await self.pause(self.us(Fraction(millis) * 1000))

    async def boot(self) -> int:
        """Run to the end of BOOT; return the edge of this end."""
        return await self.until("bridge_a_en", 1)

    async def reset(self, clk: int = 12, **levels: int) -> None:
        """Apply a pulse on rst_n, and set pins to `levels` at its end. Return before BOOT ends."""
        await self.pins(rst_n=0)
        await self.pause(clk)
        await self.pins(rst_n=1, **levels)
        self._reply_end = self.t
        self.mark = self.t

    # ------------------------------------------------------------------ pins

    async def pins(self, **levels: int) -> None:
        """Set pin levels from edge t on."""
        await self.sync()
        self.bench.set(**levels)
        self.t += 1

    async def at(self, t: int, **levels: int) -> None:
        """Set pin levels from edge t on, which may be before the end of the last stop bit; `t` does not
        change.
        """
        await self._to(t)
        self.bench.set(**levels)

    async def strobe(self, **levels: int) -> None:
        """Apply adc_data or bemf_level, with its valid signal high for one cycle, then the inverted level."""
        valid = "adc_valid" if "adc_data" in levels else "bemf_valid"
        await self.pins(**levels, **{valid: 1})
        await self.pins(**{name: level ^ 0x3FF for name, level in levels.items()}, **{valid: 0})

    # ------------------------------------------------------------------ frames

    async def send_frame(self, code: str | int, data: int = 0, address: int | None = None) -> None:
        """Send a valid frame. Instructions s, N 1 and z also restart the count of steps."""
        self._begin(number(code), data)
        address = self.address if address is None else address
        self.bench.accesses.append(Access(self.t, f"{code!r} to {address:02X}, data", 0, data & 0xFFFFFFFF))
        await self.send(command(address, code, data))

    def _begin(self, code: int, data: int) -> None:
        self.frame_start = self.t
        if code in STARTS and (data == 1 or code != STARTS[-1]):
            self.mark = self.t

    @property
    def e(self) -> int:
        """Edge at which the part samples the stop bit of the last byte sent, to the nearest cycle."""
        return round(self.middle) + SYNC

    async def next_de_rise(self) -> int | None:
        """Return the edge of the first rise of de after the last received reply; None if de has not risen."""
        await self.sync()
        return next((t for t, level in self.edges("de", self._reply_end) if level), None)

    async def receive_reply(self) -> int:
        """Receive the reply to the frame that was just sent, check each of its edges, and return its data."""
        e, bit = self.e, self.bit
        await self.go(max(self.t, e + ceil(bit) + NEAR + 1))
        rise = await self.next_de_rise()
        assert rise is not None, "no reply"
        assert abs(rise - e - bit) <= NEAR, f"de rises {rise - e} cycles after the frame"
        await self.go(max(self.t, e + ceil(82 * bit) + NEAR + 1))
        fall = next((t for t, level in self.edges("de", rise) if not level), None)
        assert fall is not None and abs(fall - e - 82 * bit) <= NEAR, f"de falls {fall}, the frame ended {e}"
        edges = [edge for edge in self.edges("txd", rise) if edge[0] <= fall]
        assert edges and abs(edges[0][0] - e - 2 * bit) <= NEAR, "the start bit is not where it belongs"
        self._reply_end = fall + 1
        self.wire = characters(edges, Fraction(edges[0][0]), bit, 8, within=1)
        address, data = of_reply(self.wire)
        self.bench.accesses.append(Access(rise, f"reply of {address:02X}, data", 0, data))
        self.replied = address
        return data

    async def ask(self, code: str | int, data: int = 0) -> int:
        """Send a frame to this part and return its reply data."""
        await self.send_frame(code, data)
        answer = await self.receive_reply()
        if code in ("w", 0x77):
            self.address = self.replied
        assert self.replied == self.address, f"{self.replied} answers for {self.address}"
        return answer

    async def exchange(self, text: str) -> str:
        """Send a complete frame and return the complete reply, both as texts of hexadecimal bytes."""
        frame = bytes.fromhex(text)
        self._begin(frame[2], frame[3])
        await self.send(frame)
        await self.receive_reply()
        return self.wire.hex(" ").upper()

    async def is_silent(self, clk: int) -> bool:
        """Return whether the part sends nothing for this number of cycles: de = 0 and txd = 1."""
        await self.pause(clk)
        return await self.next_de_rise() is None and not await self.out("de") and bool(await self.out("txd"))

    async def ignore_replies(self) -> None:
        """Ignore all replies up to now; if a reply is in progress, wait for its end."""
        await self.sync()
        self.t = max(self.t, await self.bench.level_is("de", 0))
        self._reply_end = self.t

    def accepted(self, count: int) -> int:
        """Return the reply data of an accepted instruction s."""
        return count if self.echo else 3
