"""A host on the link of a PMC006: scripts for the golden model, taped for the RTL.

Its UART is its own: replies are read from the levels of txd and de, and every edge is checked (chapter 2.4).
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import ceil

from cocotb_tests.harness.script import Script
from cocotb_tests.harness.scripts import parameters, simulating
from cocotb_tests.harness.serial_line import ScriptLine, characters
from cocotb_tests.harness.stimulus import Access
from openppmc.model.carrier.eeprom import Eeprom24C32
from openppmc.model.pmc006.part import Pmc006

from .bench import PMC006
from .frames import command, number, of_reply
from .i2c_bus import I2cBus
from .watch import Watch

SYNC = 2
"""clk from a level of a pin to what the part makes of it."""
STARTS = tuple(b"szN")
NEAR = 8
"""Tolerance of chapter 2.4 in clk."""
ACT = 4
"""clk from e to the effect of a frame that finds nobody at work."""
EXECUTE = 64
"""clk from the end of a frame to the effect."""
START = 1024
"""clk from the end of a frame to t = 0 of a motion, beside 1 us."""


class Host(Watch, ScriptLine, Script):
    """The host of one part, just booted.

    address: of the part, as the host knows it. levels: of input pins from edge 0 on. eeprom: the device on
    the bus; without one SDA is held low and the part boots at once, unless levels say sda_i=1. error: of the
    host's bit time. Further arguments are parameters of the part in lower case; those not given are those of
    the build that is simulated, or the part's defaults.

    Codes are given as letters or numbers. Data and answers are numbers; an answer is the 32-bit reply data,
    unsigned. `wire` is the last reply as it was on the line, `said` the edge on which the last frame began.
    """

    model: Pmc006

    def __init__(
        self,
        address: int = 0xFF,
        levels: Mapping[str, int] | None = None,
        eeprom: Eeprom24C32 | None = None,
        boot: bool = True,
        error: float = 0,
        **given: object,
    ) -> None:
        values = parameters(PMC006, given)
        super().__init__("pmc006", Pmc006(**values), values)  # type: ignore[arg-type]
        self.address, self.eeprom = address, eeprom
        self.clk_hz, self.baud = int(str(values["clk_hz"])), int(str(values["baud"]))
        self.echo = values["step_ack"] == "ECHO"
        self.open_line(Fraction(self.clk_hz, self.baud), error)
        self.wire = b""
        self.literal = not simulating()
        self.watch(self.model)
        self._heard = self.said = 0
        self.bus = I2cBus(self.model, eeprom) if eeprom else None
        wanted = dict(levels or {})
        if not eeprom:
            wanted.setdefault("sda_i", 0)
        if wanted:
            self.pins(**wanted)
        if boot:
            self.boot()

    # ------------------------------------------------------------------ time

    def pick(self, literal: int, short: int) -> int:
        """A count or time for the model alone, or the short one for a tape that will be played."""
        return literal if self.literal else short

    def us(self, micros: float) -> int:
        """clk of so many us, rounded up."""
        return ceil(Fraction(micros) * self.clk_hz / 1_000_000)

    def wait_us(self, micros: float) -> None:
        """Let time pass."""
        self.pause(self.us(micros))

    def ms(self, millis: float) -> None:
        """Let time pass."""
        self.pause(self.us(Fraction(millis) * 1000))

    def until(self, signal: str, level: int, limit_us: float = 1_000_000) -> int:
        """Run until an output has this level; returns the edge on which it took it, the last one."""
        end = self.t + self.us(limit_us)
        self.sync()
        while self.model.outputs[signal] != level:
            edge = self.model.next_event
            assert edge is not None and edge <= end, f"{signal} does not become {level}"
            self.go(max(self.t, edge + 1))
        return max((t for t, _ in self.edges(signal)[-1:]), default=0)

    def boot(self) -> int:
        """Run to the end of BOOT; returns its edge."""
        return self.until("bridge_a_en", 1)

    def reset(self, clk: int = 12, **levels: int) -> None:
        """A pulse on rst_n, with whose end levels come; then BOOT, for which nobody waits here."""
        self.pins(rst_n=0)
        self.pause(clk)
        self.pins(rst_n=1, **levels)
        self._heard = self.t
        self.mark = self.t

    # ------------------------------------------------------------------ frames

    def say(self, code: str | int, data: int = 0, address: int | None = None) -> None:
        """A good frame. Steps count from an s, N 1 or z on."""
        self._begin(number(code), data)
        address = self.address if address is None else address
        frame = command(address, code, data)
        self.tape.accesses.append(Access(self.t, f"{code!r} to {address:02X}, data", 0, data & 0xFFFFFFFF))
        self.send(frame)

    def _begin(self, code: int, data: int) -> None:
        self.said = self.t
        if code in STARTS and (data == 1 or code != STARTS[-1]):
            self.mark = self.t

    @property
    def e(self) -> int:
        """Edge of the stop-bit sample of the last byte sent (chapter 2.4), to the nearest clk."""
        return round(self.middle) + SYNC

    def rise(self) -> int | None:
        """Edge of the next rise of de that no `hear` has had, if there is one."""
        self.sync()
        return next((t for t, level in self.edges("de", self._heard) if level), None)

    def hear(self) -> int:
        """The reply to the frame that has just been sent; returns its data. Every edge is checked."""
        e, bit = self.e, self.bit
        self.go(max(self.t, e + ceil(bit) + NEAR + 1))
        rise = self.rise()
        assert rise is not None, "no reply"
        assert abs(rise - e - bit) <= NEAR, f"de rises {rise - e} clk after the frame"
        self.go(max(self.t, e + ceil(82 * bit) + NEAR + 1))
        fall = next((t for t, level in self.edges("de", rise) if not level), None)
        assert fall is not None and abs(fall - e - 82 * bit) <= NEAR, f"de falls {fall}, the frame ended {e}"
        edges = [edge for edge in self.edges("txd", rise) if edge[0] <= fall]
        assert edges and abs(edges[0][0] - e - 2 * bit) <= NEAR, "the start bit is not where it belongs"
        self._heard = fall + 1
        self.wire = characters(edges, Fraction(edges[0][0]), bit, 8, within=1)
        address, data = of_reply(self.wire)
        self.tape.accesses.append(Access(rise, f"reply of {address:02X}, data", 0, data))
        self.replied = address
        return data

    def ask(self, code: str | int, data: int = 0) -> int:
        """A frame to this part and its reply data."""
        self.say(code, data)
        answer = self.hear()
        if code in ("w", 0x77):
            self.address = self.replied
        assert self.replied == self.address, f"{self.replied} answers for {self.address}"
        return answer

    def swap(self, text: str) -> str:
        """A whole frame and the whole reply, as texts of hexadecimal bytes."""
        frame = bytes.fromhex(text)
        self._begin(frame[2], frame[3])
        self.send(frame)
        self.hear()
        return self.wire.hex(" ").upper()

    def silent(self, clk: int) -> bool:
        """Whether nothing is sent for so long: de = 0 and txd = 1."""
        self.pause(clk)
        return self.rise() is None and not self.out("de") and bool(self.out("txd"))

    def forget(self) -> None:
        """Nobody has listened so far; what is being sent is waited for."""
        self.sync()
        while self.model.outputs["de"]:
            self.step()
        self._heard = self.t

    def accepted(self, count: int) -> int:
        """Reply data of an accepted s."""
        return count if self.echo else 3

    # ------------------------------------------------------------------ pins

    def strobe(self, **levels: int) -> None:
        """adc_data or bemf_level with its valid for one clk."""
        valid = {("adc_valid" if "adc_data" in levels else "bemf_valid"): 1}
        self.pins(**levels, **valid)
        self.pins(**dict.fromkeys(valid, 0))
