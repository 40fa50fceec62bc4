"""Random hosts on the line of a PPMC-312: valid and invalid frames, noise, events, moves, resets.

`build(seed)` returns the build of a seed, and `play(dut, seed)` plays the seed.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from cocotb_tests.harness import D16, F16
from cocotb_tests.harness.random_host import Builds, MovingPins
from openppmc.model.ppmc312.codes import State
from openppmc.model.ppmc312.front.serial import LENGTHS

from .builds import CHARS, F8V, F27X12
from .serial_frames import SILENCE, summed
from .serial_host import SerialHost
from .state_aware_host import StateAwareHost

build = Builds("p312 serial", ((F8V, 69), (F16, 14), (F27X12, 6), (CHARS, 7), (D16, 4)))
PINS = ("evt0_n", "evt0_n", "evt1_n", "fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "index_n", "end_n", "run")
RATES = (500, 450, 400, 300, 250, 200, 199, 501, 0)
COUNTS = (1, 2, 3, 6, 12, 25, 0)
STARTS = (0x82, 0x83, 0x83, 0x84, 0x84, 0x85, 0x86, 0x86, 0x87, 0x88)
DURING = (0x80, 0x81, 0x89, 0x8A, 0x8A, 0x42, 0x4D, 0x40, 0x25, 0x26, 0x41)
SETTINGS = (0x02, 0x03, 0x04, 0x05, 0x06, 0x20, 0x21, 0x22, 0x23, 0x24, 0x28, 0x43, 0x44, 0x45, 0x63)
BLOCKS = ("0120", "0121", "022615", "022600", "028000", "028100", "028400", "0125", "0146", "0486000190")
BLOCKS += ("08830001900000000A", "048800012C", "0487000190", "01FF", "0144", "022A00", "0404000000")
TABLE = "00 00 01F4 00C8 0001BD"
"""A table with the minimum number of pulses, so that some stages have 2 pulses: F = 8 MHz, linear, rates 500
to 200, 445 pulses.
"""


async def play(dut: Any, seed: int) -> None:
    """Play one seed; raise AssertionError if the station hangs or returns an invalid answer."""
    await (await RandomSerialHost.on(dut, seed)).play()


class RandomSerialHost(StateAwareHost):
    """One random host. Its actions depend on the data that it receives; it uses the golden model only to
    decide when to act.
    """

    host: SerialHost
    background: MovingPins

    def __init__(self, seed: int) -> None:
        super().__init__("p312 serial", seed)
        self.frames = 0
        self.noisy = False

    @classmethod
    async def on(cls, dut: Any, seed: int) -> RandomSerialHost:
        """Return the host of a seed, whose station is ready."""
        talker = cls(seed)
        rng = talker.rng
        talker.host = host = await SerialHost.start(
            dut,
            mod=rng.choice((7, 7, 7, 7, 7, 7, 7, 6)),
            adr=rng.randrange(16),
            error=rng.choice((0, 0, 0, 0.02, -0.02, rng.uniform(-0.03, 0.03))),
        )
        talker.background = MovingPins(host.bench, ("mode", "mod", "adr"))
        talker.frames = rng.randint(20, 30)
        talker.noisy = rng.random() < 0.3
        return talker

    # ------------------------------------------------------------ top level

    async def play(self) -> None:
        """Send frames of all kinds; after each of them one poll must recover the station."""
        rng = self.rng
        if rng.random() < 0.93:
            await self.instruct(TABLE)
        actions = (
            (self.poll, 24),
            (self.start, 14),
            (self.during, 12),
            (self.setting, 8),
            (self.register, 13),
            (self.reports, 9),
            (self.bad_frame, 9),
            (self.talk_out_of_turn, 5),
            (self.noise, 4),
            (self.event, 12),
            (self.silence, 0.9),
            (self.table, 1),
            (self.alarm, 2.5),
            (self.reset, 0.7),
        )
        for _ in range(self.frames):
            await self.pick(actions)()
            if rng.random() < 0.4:
                self.disturb()
            if self.state is State.ABN and rng.random() < 0.7:
                await self.instruct("24")
            if self.state is State.INI and rng.random() < 0.5:
                await self.instruct(TABLE)
        await self.recover()

    async def recover(self) -> None:
        """Check that at most one poll recovers the station."""
        host = self.host
        await host.pause(1)
        self.background.stop()
        host.error = Fraction(0)
        await host.pause(1)
        await host.pause(int(14 * host.bit))
        await self.swallow()
        await host.poll()
        await host.say("FF")
        await host.pause(200)
        await self.swallow()
        assert await host.poll() == "90" and self.state is State.INI, "FF does not help"

    # ------------------------------------------------------------ line

    async def swallow(self) -> None:
        """Discard all earlier replies, and the reply that is being sent."""
        host = self.host
        await host.go(host.t)
        await host.bench.level_is("snd", 0)
        host.forget()

    async def listen(self) -> None:
        """Wait for the reply, if there is one; in a few cases do not wait."""
        host, rng = self.host, self.rng
        if rng.random() < 0.04:
            await host.pause(rng.choice((20, 200, 2_000)))
            return
        await host.pause(rng.choice((120, 120, 400)))
        for _ in range(60):
            if host.rise() is not None or not self.model.station.busy:
                break
            await host.pause(2_000)
        await self.swallow()
        if rng.random() < 0.3:
            await host.pause(rng.choice((5, 100, 1_500, 12_000)))

    async def put(self, line: bytes) -> None:
        """Send characters; if the host is noisy, disturb some of them with short wrong levels."""
        rng, host = self.rng, self.host
        if not (self.noisy and rng.random() < 0.25):
            await host.send(line, rng.choice((0, 0, 0, 0, 0.4, 3)) if len(line) < 12 else 0)
            return
        for byte in line:
            spikes = []
            if rng.random() < 0.3:
                spikes = [(rng.uniform(0, 9.4), rng.randint(1, int(host.bit * 0.9)))]
            await host.character(byte, spikes=spikes)

    async def instruct(self, text: str) -> None:
        """Send a valid frame and wait for its reply."""
        host = self.host
        await self.put(summed(0x90 + host.adr, bytes.fromhex(text), host.sum_mode))
        await self.listen()

    async def poll(self) -> None:
        """Send one to three valid polls."""
        for _ in range(self.rng.choice((1, 1, 2, 3))):
            await self.put(summed(0x80 + self.host.adr, b"", self.host.sum_mode))
            await self.listen()

    # ------------------------------------------------------------ instructions

    def data(self, code: int, near: bool = True) -> str:
        """Return the code, followed by plausible data."""
        rng, n = self.rng, LENGTHS[code]
        rate = rng.choice(RATES if rng.random() < 0.3 else RATES[:6]).to_bytes(2, "big")
        count = rng.choice(COUNTS if rng.random() < 0.3 else COUNTS[:6]).to_bytes(4, "big")
        position = (self.model.position + rng.choice((-8, -3, -1, 1, 2, 5, 9)) & 0xFFFFFFFF).to_bytes(
            4, "big"
        )
        data = {0: b"", 1: bytes([rng.randrange(256)]), 2: rate, 4: position}.get(n)
        if code == 0x06:
            data = rng.choice((b"\0", b"\0", b"\1", b"\2"))
        elif code in (0x02, 0x03):
            data = bytes([rng.randrange(8), 0, rng.choice((0, 1, 2, 4))])
        elif n == 6:
            data = rate + (position if code & 0x0F in (0x09, 0x0A) else count)
        elif n == 10:
            inner = bytes.fromhex(rng.choice(BLOCKS))
            data = (
                b"\x03" + inner if rng.random() < 0.9 else bytes([rng.choice((2, 3, 3)), rng.randrange(12)])
            )
            data = data[:10].ljust(10, bytes([rng.randrange(256)]))
        elif data is None:
            data = rng.randbytes(n)
        return bytes([code, *data]).hex()

    async def start(self) -> None:
        """Start a motion, if the state allows it."""
        rng = self.rng
        if self.state not in (State.NOR, State.INI) and rng.random() < 0.9:
            await self.during()
            return
        code = rng.choice(STARTS) + rng.choice((0, 0x20))
        if code & 0x0F in (7, 8) and rng.random() < 0.5:
            code += 0x10
        await self.instruct(self.data(code))
        if rng.random() < 0.4:
            await self.host.pause(rng.choice((500, 4_000, 9_000)))

    async def during(self) -> None:
        """Send an instruction that is useful during a motion."""
        moving = self.state in (State.ACC, State.FIX)
        await self.instruct(self.data(self.rng.choice(DURING if moving else SETTINGS)))

    async def setting(self) -> None:
        """Send settings and terminal instructions, mostly at standstill."""
        if self.state in (State.ACC, State.FIX) and self.rng.random() < 0.7:
            await self.instruct(self.rng.choice(("80", "81", "80")))
        await self.instruct(self.data(self.rng.choice(SETTINGS)))

    async def table(self) -> None:
        """Send instruction 00 with a valid or an invalid table."""
        bad = self.rng.choice(("00 00 01F4 00C8 0001BC", "00 00 01F4 0001 000320", "00 06 01F4 00C8 000320"))
        await self.instruct(bad if self.rng.random() < 0.4 else TABLE)
        if self.state is State.INI:
            await self.instruct(TABLE)

    async def register(self) -> None:
        """Register overrides and events, and start a motion that triggers them."""
        rng = self.rng
        if self.state in (State.ACC, State.FIX) and rng.random() < 0.5:
            await self.instruct("80")
        if rng.random() < 0.5:
            await self.instruct(self.data(rng.choice((0x49, 0x49, 0x49, 0x59, 0x59, 0x59, 0x69, 0x79))))
            await self.event()
            return
        for _ in range(rng.randint(1, 2)):
            await self.instruct(
                self.data(rng.choice((0x80, 0x81, 0x89, 0x8A)) + rng.choice((0x10, 0x10, 0x20, 0x30)))
            )
        if rng.random() < 0.7:
            await self.start()

    async def reports(self) -> None:
        """Create the conditions of a report: monitors, interlock, a motion that waits, a limit."""
        rng, host = self.rng, self.host
        if self.state in (State.ACC, State.FIX):
            await self.instruct("80")
        kind = rng.randrange(5)
        if kind == 0:
            await self.instruct(f"{rng.choice(('02', '03'))} {rng.choice(('01', '05'))} 0001")
        elif kind == 1:
            await self.instruct(f"04 {self.model.position + rng.choice((1, 2)) & 0xFFFFFFFF:08X}")
            if not self.model.core.interlock.on:
                await self.instruct("44")
        elif kind == 2:
            await host.pins(run=0)
        elif kind == 3:
            await self.instruct("28 FF")
            for k in range(rng.randint(1, 4)):
                self.background.add(host.t + 900 * (k + 1), auxi=rng.randrange(256))
        else:
            self.background.blip(
                host.t + rng.randrange(15_000), rng.choice(("fl_n", "bl_n", "fhl_n")), 0, 9_000
            )
        await self.start()
        await host.pins(run=1)
        await self.poll()
        if kind == 0:
            await self.instruct("80")
            await self.poll()
            for code in ("43", "63"):
                await self.instruct(f"{code} 00000000")
            await self.poll()

    async def event(self) -> None:
        """Apply edges of the event pins near the end of a frame."""
        rng, host = self.rng, self.host
        frame = rng.choice(
            (summed(0x80 + host.adr, b"", host.sum_mode), summed(0x90 + host.adr, b"\x26\x2a", host.sum_mode))
        )
        pin = rng.choice(("evt0_n", "evt1_n"))
        end = host.t + int((10 * len(frame) - 0.5) * host.bit)
        self.background.blip(end + rng.randint(-70, 30), pin, 0, rng.choice((3, 40, 900)))
        await self.put(frame)
        await self.listen()

    # ------------------------------------------------------------ disturbances

    async def bad_frame(self) -> None:
        """Send an invalid frame: wrong checksum or digits, wrong length, other station, unknown code, random
        bytes.
        """
        rng, host = self.rng, self.host
        code = rng.choice(list(LENGTHS))
        good = summed(
            0x90 + host.adr, bytes.fromhex(self.data(code if code != 0xFF else 0x25)), host.sum_mode
        )
        kind = rng.randrange(7)
        if kind == 0:
            line = good[:-1] + bytes([good[-1] ^ 1 << rng.randrange(7)])
        elif kind == 1:
            place = rng.randrange(1, len(good))
            line = good[:place] + bytes([rng.choice(b"ABCDEF:/`g\x00\x7f ")]) + good[place + 1 :]
        elif kind == 2:
            line = good[: rng.randrange(1, len(good))]
        elif kind == 3:
            line = good + rng.randbytes(rng.randint(1, 3))
        elif kind == 4:
            line = bytes([rng.randrange(0x80, 0x100)]) + good[1:]
        elif kind == 5:
            line = summed(0x90 + host.adr, rng.randbytes(rng.randint(1, 4)), host.sum_mode)
        else:
            line = rng.randbytes(rng.randint(1, 6))
        await self.put(line)
        await self.listen()

    async def talk_out_of_turn(self) -> None:
        """Send more frames while the reply to a frame is pending or is being sent."""
        rng, host = self.rng, self.host
        first = rng.choice(("25", "42", "4d", "20", "4f"))
        await self.put(summed(0x90 + host.adr, bytes.fromhex(first), host.sum_mode))
        host.back_to(host.t + rng.choice((0, 1, 50, 300, 900)))
        for _ in range(rng.randint(1, 3)):
            await self.put(
                summed(rng.choice((0x80, 0x90)) + host.adr, rng.choice((b"", b"\x25")), host.sum_mode)
            )
        await self.listen()

    async def noise(self) -> None:
        """Apply short low levels on an idle line."""
        rng, host = self.rng, self.host
        for _ in range(rng.randint(1, 6)):
            await host.low(rng.choice((0.01, 0.1, 0.49, 0.5, 0.51, 1, 3, 9.3, 9.6, 12, 30)))
            host.t += rng.choice((0, 3, 50, 1_000))
        await self.listen()

    async def silence(self) -> None:
        """Leave the line idle for about 20 ms after an incomplete or unknown frame."""
        rng, host = self.rng, self.host
        await self.put(
            bytes([0x90 + host.adr]) + rng.choice((b"", b"2", b"26", b"2A", b"33", b"G0", b"4704"))
        )
        timebase = self.model.timebase
        await host.pause(timebase.cyc(SILENCE) + rng.choice((-9_000, -3, 0, 2, 3_000)))
        await self.poll()

    def disturb(self) -> None:
        """Change pins independently of the frames."""
        rng, t = self.rng, self.host.t
        pin = rng.choice(PINS)
        if rng.random() < 0.5:
            self.background.blip(t + rng.randrange(12_000), pin, 0, rng.choice((1, 30, 3_000)))
        elif rng.random() < 0.5:
            self.background.add(t + rng.randrange(12_000), auxi=rng.randrange(256))
        else:
            for k in range(rng.randint(1, 4)):
                self.background.blip(t + 200 * k + rng.randrange(90), "epin", 1, 40)

    async def alarm(self) -> None:
        """Assert alm_n (low) for a time."""
        self.background.blip(
            self.host.t + self.rng.randrange(4_000), "alm_n", 0, self.rng.choice((30, 9_000))
        )

    async def reset(self) -> None:
        """Reset the device with the pin or with instruction FF."""
        rng, host = self.rng, self.host
        if rng.random() < 0.5:
            await self.instruct("FF")
        else:
            await host.pins(rst_n=0)
            await host.pause(12)
            await host.pins(rst_n=1)
            await host.pause(30)
            await host.bench.level_is("out_oe", 1)
        host.forget()
        await self.instruct(TABLE)
