"""Random host that misuses the PPMC-312: wrong order, unread answers, invalid blocks, resets, changing pins.

The hosts of `reactive_host` also use its blocks, tables and accesses near interval boundaries.
"""

from __future__ import annotations

import random

from cocotb_tests.harness.bus import CSR, DRR, DWR, MREF, MWEF, RAR, RCR, WAR, WCR
from cocotb_tests.harness.random_host import MovingPins
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import LENGTHS, Code, State

from .host import Host
from .state_aware_host import StateAwareHost

PINS = ("evt0_n", "evt0_n", "evt1_n", "fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "index_n", "end_n", "run")
MOTIONS = (0x82, 0x82, 0x82, 0x83, 0x83, 0x84, 0x85, 0x86, 0x86, 0x10, 0x11, 0x11)
DURING = (0x80, 0x81, 0x81, 0x87, 0x87, 0x88, 0x88, 0x4D, 0x42, 0x25, 0x26, 0x40)
RECOVERY = 3000
"""Maximum number of polls of a host that reads all responses of the device."""


def some_equal(rates: list[int], share: float) -> list[int]:
    """Return the rates; in the fraction `share` of cases, make some neighbouring rates equal.

    The rates themselves are the seed, so the random sequence of the host does not change.
    """
    rng = random.Random(f"equal {rates}")
    return sorted(rng.choices(rates, k=len(rates))) if rng.random() < share else rates


async def reset_by_bus(host: Host) -> None:
    """Check that instruction FF resets the device to INI in any state."""
    await host.put(message(Code.RESET))
    await host.pause(60)
    await host.wait()
    if await host.read(RAR) == 0x40:  # the reset has discarded a response that had just been loaded
        await host.pause(60)
    assert await host.response() == message(Code.RESET) and host.condition == State.INI, "FF does not help"


class MisuseHost(StateAwareHost):
    """One random host. Its actions depend on the data that it reads; it uses the golden model only to decide
    when to act.
    """

    def __init__(self, host: Host, seed: int) -> None:
        super().__init__("p312", seed)
        self.host = host
        self.slow = host.bench.config.datasheet
        self.background = MovingPins(host.bench, ("mode", "mod", "adr"))
        self.reads = self.rng.choice((0.3, 0.9, 0.97, 1.0, 1.0, 1.0))
        self.rates = [100, 200, 400]
        self.end = self.host.t + (900_000 if self.slow else 130_000)

    # ------------------------------------------------------------ top level

    async def play(self) -> None:
        """Play until the time is over, then check that the device recovers."""
        self.disturb_pins()
        await self.setting()
        while self.host.t < self.end:
            acts = ((self.motion, 34), (self.instruction, 20), (self.aligned, 14), (self.bad_block, 3),
                    (self.registers, 4), (self.setting, 3), (self.reset, 1.5), (self.wait, 8),
                    (self.registration, 12))  # fmt: skip
            await self.pick(acts)()
        await self.recover()

    async def recover(self) -> None:
        """Check that the device works after a host has read all responses and reset it (P312-BAD-09)."""
        host = self.host
        await host.pause(1)
        self.background.stop()
        await host.pause(1)
        for _ in range(RECOVERY):
            if not await host.read(CSR) & MREF:
                await host.response()
            elif not await host.read(CSR) & MWEF:
                break
            await host.pause(400)
        await reset_by_bus(host)
        assert await host.ask(message(Code.VERSION)) == message(Code.VERSION, "12")

    # ------------------------------------------------------------ host

    async def send(self, text: str) -> None:
        """Write a block if the device accepts blocks; in some cases, write without reading the status."""
        host, rng = self.host, self.rng
        if not await host.read(CSR) & MWEF or rng.random() < 0.1:
            await host.put(text)
            await host.pause(rng.choice((0, 5, 40, 60, 250)))
        await self.fetch()

    async def fetch(self) -> None:
        """Read the pending responses, unless this host does not read."""
        host, rng = self.host, self.rng
        for _ in range(6):
            if await host.read(CSR) & MREF:
                return
            if rng.random() > self.reads:
                return
            if rng.random() < 0.05:
                for _ in range(rng.randint(1, 3)):
                    await host.read(rng.choice((DRR, DRR, RCR)))
                continue
            # A reset may have discarded the response in the meantime.
            for _ in range(0x40 - await host.read(RAR)):
                await host.read(DRR)
            if rng.random() < 0.1:
                await host.pause(rng.randint(1, 40))

    async def wait(self) -> None:
        rng = self.rng
        await self.host.pause(rng.choice((20, 300, 3_000, 12_000)) * (5 if self.slow else 1))
        await self.fetch()
        if self.state is State.ABN:
            await self.send(message(Code.ALARM_CLEAR))

    async def registers(self) -> None:
        """Access registers in any order."""
        host, rng = self.host, self.rng
        for _ in range(rng.randint(1, 8)):
            if rng.random() < 0.5:
                await host.write(
                    rng.choice((CSR, WCR, WAR, DWR, 1, 4, 6, 7)),
                    rng.choice((0x20, 0x70, 0x1D, 0x03, 0x10, 0)),
                )
            else:
                await host.read(rng.choice((CSR, RCR, RAR, DRR, 1, 5)))
        if rng.random() < 0.3:
            await host.write(CSR, rng.choice((0, 0x10, 0x20, 0x30, 0x70)))

    async def reset(self) -> None:
        """Reset the device at any time, also in the middle of a block."""
        host, rng = self.host, self.rng
        if rng.random() < 0.5:
            await host.write(WCR, 0x20)
            await host.write(WAR, 0x18)
            await host.write(DWR, 0x03)
        if rng.random() < 0.4:
            await host.put(message(Code.RESET))
            await host.pause(rng.choice((0, 25, 30, 60)))
        elif not self.slow:
            await host.pins(rst_n=0)
            await host.pause(rng.randint(1, 12))
            await host.pins(rst_n=1)
            await host.pause(rng.choice((0, 1, 8)))
            await host.pause(4)
        await self.setting()

    # ------------------------------------------------------------ blocks

    async def bad_block(self) -> None:
        rng = self.rng
        data = bytes(rng.choice((0, 1, 2, 3, 3, rng.randrange(256))) for _ in range(rng.randint(1, 32)))
        await self.send(data.hex())

    async def setting(self) -> None:
        """Send a table: mostly a short free curve, sometimes a computed one; often with a new base clock."""
        rng = self.rng
        clk = rng.choice((0, 0, 0, 0, 1, 1, 2, 6, 7))
        if rng.random() < 0.08 and not self.slow:
            # The last two tables have stages of 2 pulses; in a sigmoid curve with such stages, R[1] = R[0].
            self.rates, tail = rng.choice(
                (
                    ([40, 120, 400], "09 00 {} 0190 0028 000480"),
                    ([40, 120, 400], "09 00 {} 0190 0028 000100"),
                    ([40, 120, 400], "09 00 {} 0190 0190 000480"),
                    ([40, 120, 400], "09 00 {} 0FA0 0005 001000"),
                    ([100, 200, 300], "09 00 {} 012C 0064 000200"),
                    ([100, 250, 300], "0E 00 1{} 012C 00FA 0064 000200 000500"),
                )
            )
            flags = rng.choice("08")
            await self.send("03 " + tail.format(flags if "1{}" in tail else f"0{flags}"))
            await self.host.pause(21_000)
            await self.fetch()
            return
        count = rng.choice((2, 3, 3, 3, 4, 7))
        least = rng.choice((2, 4, 12, 40, 40)) if clk == 0 else rng.choice((4, 10))
        self.rates = sorted(rng.randint(least, least * 6 + 40) for _ in range(count))
        self.rates = some_equal(self.rates, 0.2)
        if rng.random() < 0.05:
            rng.shuffle(self.rates)
        separate = rng.random() < 0.5
        down = rng.randint(2, count) if separate else count
        up = count if down < count else rng.randint(2, count)
        up = up if separate else count
        pulses = [[rng.randint(2, 6) for _ in range(n)] for n in ((up, down) if separate else (up,))]
        head = (
            f"02 04 01 {0x10 | clk:02X} {up:02X} {down:02X}" if separate else f"02 03 01 {clk:02X} {up:02X}"
        )
        lists = [(2, self.rates), *((3, values) for values in pulses)]
        blocks = [head]
        for number, (width, values) in enumerate(lists):
            last = number == len(lists) - 1 and rng.random() > 0.02
            data = b"".join(value.to_bytes(width, "big") for value in values)
            blocks.append(f"{int(last):02X} {len(data):02X} {data.hex()}")
        for block in blocks:
            await self.send(block)
            await self.host.pause(60)
            await self.fetch()
        self.background.external(self.host.t + 2, clk >= 6, rng)

    def rate(self) -> int:
        rng = self.rng
        return rng.choice(
            (0, *self.rates, *self.rates, rng.randint(min(self.rates), max(self.rates)), 0xFFFF)
        )

    def block(self, code: int, trigger: int | None = None) -> bytes:
        """Return any instruction with mostly legal parameters.

        Args:
            trigger: TRG bits for an instruction with OV = 1; None for OV = 0.
        """
        rng = self.rng
        flags = rng.choice((0, 0, 0x40)) | (0x10 if code in (0x10, 0x11) and rng.random() < 0.4 else 0)
        flags = flags if trigger is None else flags & 0x40 | 4 | trigger
        position = (self.model.position + rng.randint(-4, 12)) & 0xFFFFFFFF
        with_position = trigger in (0, 2) or rng.random() < 0.1
        if code in (0x80, 0x81):
            data = bytes([flags]) + (position.to_bytes(4, "big") if with_position else b"")
        elif code in (0x87, 0x88):
            data = bytes([flags]) + self.rate().to_bytes(2, "big")
            data += position.to_bytes(4, "big") if with_position else b""
        elif code in (0x82, 0x83):
            data = bytes([flags]) + self.rate().to_bytes(2, "big")
            data += rng.choice((1, 2, 3, 5, 9, 14, 23, 40)).to_bytes(4, "big")
            if code == 0x82 and rng.random() < 0.2:
                data = data[:1] + data[3:]
        elif code in (0x10, 0x11, 0x85, 0x86):
            data = bytes([flags]) + self.rate().to_bytes(2, "big")
        elif code == 0x49:
            inner = self.block(
                rng.choice((0x25, 0x26, 0x27, 0x84, 0x83, 0x82, 0x80, 0x81, 0x87, 0x88, 0x4D, 0x42))
            )
            if len(inner) > 16 or rng.random() < 0.3:
                data = bytes([rng.choice((2, 3))])
            else:
                data = bytes([rng.randrange(2)]) + inner
        elif code in (0x02, 0x03):
            data = bytes([rng.choice((0, 1, 3, 3, 5, 7, 7)), 0, rng.choice((0, 1, 2, 5, 20))])
        elif code == 0x43:
            data = bytes([rng.choice((0, 1, 1, 2))]) + rng.choice((0, 5, 0xFFFFFFFE, 0x7FFFFFFF)).to_bytes(
                4, "big"
            )
        elif code == 0x04:
            data = position.to_bytes(4, "big")
        elif code == 0x05:
            data = self.rate().to_bytes(2, "big")
        else:
            length = rng.choice(LENGTHS.get(code, (1,)))
            data = bytes(rng.choice((0, 0, 1, 2, 0xFF)) for _ in range(min(length, 20) - 1))
        if rng.random() < 0.02:
            data = data[:-1]
        return bytes([3, len(data) + 1, code]) + data

    async def instruction(self) -> None:
        rng = self.rng
        code = rng.choice(
            [code for code in LENGTHS if code not in (0x00, 0x01, 0xFF)] + [0x46, 0x49, 0x02, 0x03]
        )
        if code == 0x41 and rng.random() < 0.7:
            code = 0x44
        await self.send(self.block(code).hex())

    async def registration(self) -> None:
        """Register an instruction that waits for a position or an event."""
        rng = self.rng
        if rng.random() < 0.3:
            await self.send(self.block(0x49).hex())
            return
        trigger = rng.choice((0, 0, 0, 1, 3, 2))
        codes = (0x80, 0x81, 0x87, 0x88) if trigger in (0, 2) else (*MOTIONS[:5], 0x80, 0x81, 0x87, 0x88)
        for _ in range(rng.choice((1, 1, 2, 9))):
            await self.send(self.block(rng.choice(codes), trigger).hex())

    async def motion(self) -> None:
        """Start a motion and send instructions or move pins during it."""
        rng = self.rng
        await self.send(self.block(rng.choice(MOTIONS)).hex())
        for _ in range(rng.choice((0, 0, 1, 1, 2, 3))):
            if rng.random() < 0.5:
                await self.host.pause(rng.choice((30, 300, 1_500, 5_000)))
            if rng.random() < 0.5:
                await self.send(self.block(rng.choice(DURING)).hex())
            else:
                await self.aligned()
        if rng.random() < 0.7:
            await self.wait()

    async def aligned(self) -> None:
        """Apply an instruction or pin edge that takes effect within a few cycles of the end of an
        interval.
        """
        host, rng, motion = self.host, self.rng, self.model.motion
        if not motion.active or motion.sequence.running is None:
            return
        due = motion.next_boundary
        if due is None:
            return
        near = due + rng.randint(-9, 5)
        if rng.random() < 0.5:
            text = self.block(rng.choice((0x80, 0x81, 0x81, 0x87, 0x87, 0x88, 0x88, 0x88)))
            ahead = 29 + 6 * (len(text) + 1)
            if text[2] > 0x81 and self.model.core.table:
                ahead += self.model.core_timing.look_up()
            interval = max(4, due - host.t)
            while near - ahead < host.t:
                near += interval
            if near - ahead < host.t + 60_000 and not await host.read(CSR) & MWEF:
                await host.go(max(host.t, near - ahead))
                await host.put(text.hex())
        elif near - 2 > host.t:
            pin = rng.choice(PINS[:-2])
            await host.go(near - 2)
            await host.pins(**{pin: 0})
            await host.pause(rng.choice((1, 2, 3, 20, 500)))
            await host.pins(**{pin: 1})

    # ------------------------------------------------------------ pins

    def disturb_pins(self) -> None:
        """Change pins independently of the host: switches, events, alarms, encoder, general input."""
        rng = self.rng
        t, scale = self.host.t, (12 if self.slow else 1)
        busy = rng.choice((0.2, 0.5, 1.0, 2.5))
        while t < self.end:
            t += int(rng.expovariate(busy / 9_000) * scale) + 1
            kind = rng.random()
            if kind < 0.5:
                pin = rng.choice(PINS)
                length = rng.choice((1, 2, 4, 30, 400, 3_000)) * (
                    130 if self.slow and "evt" in pin else scale
                )
                self.background.blip(t, pin, 0, length)
            elif kind < 0.53:
                self.background.blip(t, "alm_n", 0, rng.choice((3, 400, 4_000)) * scale)
            elif kind < 0.8:
                for _ in range(rng.choice((1, 4, 15))):
                    self.background.add(t, epdir=rng.choice((0, 0, 1)))
                    self.background.blip(t + 1, "epin", 1, rng.randint(2, 6))
                    t += rng.randint(8, 60)
            else:
                self.background.add(t, auxi=rng.randrange(256))
