"""The master of a serial line with one PPMC-312: scripts for the golden model, taped for the RTL.

Its UART is its own: what the part sends is read from the levels of txd, and every edge is checked.
"""

from __future__ import annotations

from fractions import Fraction
from math import ceil

from cocotb_tests.harness.block_host import clean
from cocotb_tests.harness.serial_line import ScriptLine, characters

from .script_host import Script
from .serial_frames import SPEEDS, T_EXEC, T_INIT, summed

SLACK = 64
"""clk that a reply may be later."""


class SerialHost(ScriptLine, Script):
    """mod: speed. adr: station. error: of the master's bit time, 0.02 = 2 % too long. mode: level of MODE.

    Instructions are texts of hexadecimal bytes: code and data. Answers are texts of kind without the
    address, and data: "90", "A0 38", "B0 42"; `wire` is the last one as it was on the line,
    `waited` how many clk after the end of the master's last stop bit snd has risen.
    """

    def __init__(
        self, *setting: str, mod: int = 7, adr: int = 1, error: float = 0, mode: int = 0, **parameters: object
    ) -> None:
        super().__init__(**parameters)
        model, self.adr = self.model, adr
        self.sum_mode = str(parameters.get("sum_mode", "BINARY"))
        self.pins(rst_n=0, mode=mode, mod=mod, adr=adr)
        self.pause(12)
        self.open_line(Fraction(0), error)
        self.speed(mod)
        self.wire, self.waited = "", Fraction(0)
        self._heard = 0
        self.pins(rst_n=1)
        self.pause(12)
        while not model.outputs["out_oe"]:
            self.step()
        self.pause(4)
        for instruction in setting:
            assert self.ask(instruction) == "90"

    def speed(self, mod: int) -> None:
        """The master takes the speed of mod; that of the part changes with its next reset only."""
        timebase = self.model.timebase
        rate = SPEEDS.get(mod, SPEEDS[7]) * timebase.xtal_hz / 16_000_000
        self.bit = timebase.clk_hz / rate

    # ------------------------------------------------------------------ to the part

    def say(self, text: str, adr: int | None = None) -> None:
        """An instruction; pulses count from here."""
        self.mark = self.t
        control = 0x90 + (self.adr if adr is None else adr)
        self.send(summed(control, bytes.fromhex(text), self.sum_mode))

    # ------------------------------------------------------------------ from the part

    def rise(self) -> int | None:
        """Edge of the next rise of snd that no `hear` has had, if there is one."""
        self.sync()
        return next((t for t, level in self.model.log.of("snd", self._heard) if level), None)

    def begin(self, within: int = T_EXEC) -> int:
        """Edge of the next rise of snd, at most `within` clk after the middle of the last stop bit."""
        end = ceil(self.middle + max(Fraction(within), self.bit)) + SLACK
        while (rise := self.rise()) is None:
            assert self.model.next_event is not None and self.model.next_event <= end, (
                "no reply comes any more"
            )
            self.step()
        assert rise <= end, f"snd rises {rise - end} clk too late"
        return rise

    def hear(self, within: int = T_EXEC, timed: bool = True) -> str:
        """The next reply, which starts as `begin` says, but not before half a bit after the end of the frame.

        timed: the last stop bit was the end of the frame that is answered (P312-SER-18).
        """
        rise = self.begin(within)
        self.waited = rise - self.middle - self.bit / 2
        assert not timed or self.waited >= self.bit / 2, f"snd rises {self.waited} clk after the frame"
        while (fall := next((t for t, level in self.model.log.of("snd", rise) if not level), None)) is None:
            self.step()
        self._heard = fall
        self.go(max(self.t, fall + 1))
        line = self._decode(rise, fall)
        self.wire = clean(line.hex())
        return self._meaning(line)

    def _decode(self, rise: int, fall: int) -> bytes:
        """The characters between two edges of snd; every edge is where it belongs (P312-SER-18)."""
        bit = self.bit
        count, rest = divmod(round((fall - rise) / bit) - 1, 10)
        assert not rest and fall == rise + ceil((10 * count + 1) * bit), "snd falls in a character"
        edges = [edge for edge in self.model.log.of("txd", rise) if edge[0] <= fall]
        assert not edges or edges[0][0] >= rise + bit, "no idle bit before the first character"
        return characters(edges, rise + bit, bit, count)

    def _meaning(self, line: bytes) -> str:
        control, data = line[0], bytes.fromhex(line[1:-1].decode("ascii"))
        assert line == summed(control, data, self.sum_mode)
        assert control & 0x0F == self.adr
        return " ".join([f"{control & 0xF0:02X}", *([clean(data.hex())] if data else [])])

    def ask(self, text: str, within: int | None = None) -> str:
        """An instruction and its reply."""
        self.say(text)
        return self.hear(within or (T_INIT if bytes.fromhex(text)[0] == 0 else T_EXEC))

    def poll(self, adr: int | None = None) -> str:
        """A poll and its reply."""
        self.ask_poll(adr)
        return self.hear()

    def ask_poll(self, adr: int | None = None) -> None:
        """A poll without waiting."""
        self.send(summed(0x80 + (self.adr if adr is None else adr), b"", self.sum_mode))

    def forget(self) -> None:
        """Nobody has listened so far."""
        self._heard = self.t

    def quiet(self, clk: int = 2 * T_EXEC) -> bool:
        """Whether nothing is sent for so long."""
        self.pause(clk)
        return self.rise() is None

    def until(self, answer: str, limit: int = 2_000_000) -> list[str]:
        """Polls until this answer comes; all others but busy and ready that came before it."""
        end, others = self.t + limit, []
        while (said := self.poll()) != answer:
            assert self.t < end, f"{answer} does not come"
            if said not in ("80", "90"):
                others.append(said)
        return others

    def settle(self) -> list[str]:
        """Polls until the station is ready; everything else that it has said."""
        others = []
        while (said := self.poll()) != "90":
            if said != "80":
                others.append(said)
        return others
