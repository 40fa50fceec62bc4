"""Scenarios of a random host of the PPMC-312: typical operations of a machine, each with interruptions."""

from __future__ import annotations

from cocotb_tests.harness.bus import CSR, DRR, MREF, MWEF, RAR
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import Code, State
from openppmc.model.ppmc312.stages import ramped

from .misuse_host import MisuseHost, some_equal

LIMITS, SLOW_LIMITS = ("fl_n", "bl_n"), ("fhl_n", "bhl_n")
ASKED = (
    message(Code.INPUT),
    message(Code.OUTPUT, "15"),
    message(Code.POSITION_READ, "00"),
    message(Code.POSITION_READ, "01"),
    message(Code.STATUS),
    message(Code.TERMINALS),
    message(Code.VERSION),
)
STOPS = (message(Code.STOP, "00"), message(Code.SLOW_STOP, "00"))
CHANGES = (0x80, 0x81, 0x87, 0x87, 0x87, 0x88, 0x88, 0x88)
POLL = 60
"""Number of cycles between two polls of a host that waits for responses."""


class ScenarioHost(MisuseHost):
    """Host that plays scenarios.

    Attributes:
        follows: probability that the encoder follows a pulse (0: no encoder).
    """

    follows = 0.0

    # ------------------------------------------------------------ host

    async def response(self) -> None:
        """Read the loaded response."""
        host = self.host
        for _ in range(0x40 - await host.read(RAR)):
            await host.read(DRR)

    async def attend(self, clk: int) -> None:
        """Wait `clk` cycles (4 × `clk` in DATASHEET), read responses, and move the encoder."""
        host, rng = self.host, self.rng
        end = host.t + clk * (4 if self.slow else 1)
        while True:
            while not await host.read(CSR) & MREF and rng.random() < self.reads:
                await self.response()
            if self.follows:
                await self.follow()
            if host.t >= end:
                return
            await host.pause(min(POLL, end - host.t))

    async def follow(self) -> None:
        """Move the encoder towards the position, with occasional errors."""
        counters, host = self.model.core.counters, self.host
        behind = counters.pulse - counters.encoder & 0xFFFFFFFF
        if behind and self.rng.random() < self.follows:
            wrong = self.rng.random() < 0.04
            await host.pins(epdir=int(behind >> 31) ^ wrong)
            await host.pins(epin=1)
            await host.pause(self.rng.randint(1, 4))
            await host.pins(epin=0)

    async def send_block(self, text: str) -> None:
        """Write a block as soon as the device accepts it; in most cases read until its answer arrives."""
        host, rng = self.host, self.rng
        for _ in range(40):
            if not await host.read(CSR) & MWEF:
                break
            await self.attend(POLL)
        await host.put(text)
        if rng.random() < 0.06:
            return
        for _ in range(14):
            await self.attend(40)
            if not await host.read(CSR) & MWEF:
                break
        await self.attend(10)

    async def curve(self) -> None:
        """Send a short free curve or a computed table on a fast base clock, so that operations are short."""
        host, rng = self.host, self.rng
        if rng.random() < 0.12 and not self.slow:
            # RS 300, RH 100. Most of these tables begin with stages of 2 pulses, which is the legal minimum.
            self.rates = [100, 200, 300]
            pulses = rng.choice((508, 509, 560, 700, 1200))
            await self.send_block(f"03 09 00 0{rng.choice('08')} 012C 0064 {pulses:06X}")
            self.background.external(host.t + 2, False, rng)
            return
        clk = rng.choice((0, 0, 0, 0, 0, 0, 0, 1, 2, 6, 7)) if not self.slow else rng.choice((0, 1))
        count = rng.choice((2, 3, 3, 4, 4, 5, 7))
        least, most = {0: (22, 130), 1: (12, 60), 2: (8, 30)}.get(clk, (3, 14))
        self.rates = self.order(some_equal(sorted(rng.randint(least, most) for _ in range(count)), 0.3))
        separate = rng.random() < 0.55
        up = down = count
        if separate and rng.random() < 0.6:
            up, down = rng.choice(((count, rng.randint(2, count)), (rng.randint(2, count), count)))
        head = (
            f"02 04 01 {0x10 | clk:02X} {up:02X} {down:02X}" if separate else f"02 03 01 {clk:02X} {up:02X}"
        )
        lists = [(2, self.rates), *((3, [rng.randint(2, 4) for _ in range(n)])
                                    for n in ((up, down) if separate else (up,)))]  # fmt: skip
        await self.send_block(head)
        for number, (width, values) in enumerate(lists):
            data = b"".join(value.to_bytes(width, "big") for value in values)
            await self.send_block(f"{int(number == len(lists) - 1):02X} {len(data):02X} {data.hex()}")
        self.background.external(host.t + 2, clk >= 6, rng)

    def order(self, rates: list[int]) -> list[int]:
        """Return the rates of a free curve in the order of its stages, fastest stage first."""
        return rates

    # ------------------------------------------------------------ numbers

    def speed(self) -> int:
        """Return a rate near those of the table."""
        rng = self.rng
        if rng.random() < 0.03:
            return self.rate()
        if rng.random() < 0.5:
            return rng.choice(self.rates)
        return max(2, rng.randint(min(self.rates) - 1, max(self.rates) + 8))

    def distance(self, rate: int) -> int:
        """Return a number of pulses near the boundaries between the kinds of operations."""
        rng, table = self.rng, self.model.core.table
        if table is None or rng.random() < 0.2:
            return rng.choice((1, 2, 3, 9, 30, 0))
        rate = rate or table.high
        plan = ramped(table, rate, 10_000)
        both = plan.up + plan.down
        near = rng.choice((both, both, both + 12, both // 2, plan.up, plan.down, both * 3 // 4))
        return max(1, near + rng.choice((0, 0, -1, 1, 2, 5)))

    def finite_block(self, more: int = 0) -> bytes:
        """Return a block of instruction 82 or 83 with a plausible number of pulses.

        Args:
            more: number of pulses to add.
        """
        rng = self.rng
        code, rate = rng.choice((0x82, 0x82, 0x82, 0x83)), self.speed()
        rate = 0 if code == 0x82 and rng.random() < 0.3 else rate
        data = bytes([rng.choice((0, 0, 0x40))]) + rate.to_bytes(2, "big")
        data += (self.distance(rate) + more).to_bytes(4, "big")
        return bytes([3, len(data) + 1, code]) + data

    def endless_block(self, codes: tuple[int, ...] = (0x85, 0x85, 0x86)) -> bytes:
        rng = self.rng
        code = rng.choice(codes)
        flags = rng.choice((0, 0, 0x40)) | (0x10 if code in (0x10, 0x11) and rng.random() < 0.3 else 0)
        return bytes([3, 4, code, flags]) + self.speed().to_bytes(2, "big")

    def change_block(
        self, trigger: int | None = None, ahead: int = 0, codes: tuple[int, ...] = CHANGES
    ) -> bytes:
        """Return a block of instruction 80, 81, 87 or 88.

        Args:
            trigger: condition for which the instruction is registered; None: the device executes it
                immediately.
            ahead: number of pulses from the present position to the position that triggers the instruction.
        """
        rng = self.rng
        code = rng.choice(codes)
        flags = 0 if trigger is None else 4 | trigger
        data = bytes([flags]) + (self.speed().to_bytes(2, "big") if code > 0x81 else b"")
        if trigger in (0, 2):
            step = -ahead if self.model.motion.direction else ahead
            data += (self.model.position + step & 0xFFFFFFFF).to_bytes(4, "big")
        return bytes([3, len(data) + 1, code]) + data

    # ------------------------------------------------------------ motions

    async def meanwhile(self, times: int) -> None:
        """Send instructions or move pins during an operation, often near a boundary of intervals."""
        host, rng = self.host, self.rng
        for _ in range(times):
            if self.state not in (State.ACC, State.FIX, State.WRN):
                return
            what = rng.random()
            if what < 0.4:
                await self.aligned()
            elif what < 0.65:
                await self.send_block(self.change_block().hex())
            elif what < 0.8:
                await self.send_block(rng.choice(ASKED))
            elif what < 0.84:
                pin = rng.choice((*LIMITS, "org_n", "end_n", "alm_n", "index_n"))
                self.background.blip(host.t + rng.randint(1, 900), pin, 0, rng.choice((1, 4, 400)))
            await self.attend(rng.choice((0, 30, 300, 900)))

    async def finite(self) -> None:
        """Make a move, with or without disturbances."""
        rng = self.rng
        if rng.random() < 0.35:
            await self.changed()
            return
        await self.send_block(self.finite_block().hex())
        await self.meanwhile(rng.choice((0, 0, 1, 2, 4)))
        await self.attend(4_000)

    async def changed(self) -> None:
        """Make a move with speed changes, for which the device must recompute the deceleration point."""
        rng = self.rng
        await self.send_block(self.finite_block(rng.randint(12, 40)).hex())
        for _ in range(rng.choice((1, 1, 2, 3))):
            if not self.model.motion.active:
                break
            await self.attend(rng.choice((0, 200, 900)))
            if rng.random() < 0.7:
                await self.send_block(self.change_block(codes=(0x87, 0x88)).hex())
            else:
                await self.aligned()
                await self.attend(120)
        await self.attend(6_000)

    async def changes_near_deceleration(self) -> None:
        """Change to a rate with a long ramp (instruction 88), then send instruction 87 twice shortly before
        the deceleration point.
        """
        host, rng, table = self.host, self.rng, self.model.core.table
        if table is None:
            return
        rate = rng.choice(self.rates)
        full = ramped(table, rate, None).up + sum(table.pd[table.sd : table.stage(rate) + 1])
        count = full + rng.randint(16, 24)
        await self.send_block(message(Code.RAMP, f"00 {rate:04X} {count:08X}"))
        before = rng.randint(6, 12)
        while (motion := self.model.motion).active and host.t < self.end:  # the motion may still wait for t0
            if count - motion.sequence.done <= motion.sequence.plan.down + before:
                break
            await self.attend(30)
        await self.send_block(message(Code.CHANGE, f"00 {max(self.rates):04X}"))
        await self.attend(rng.choice((30, 200)))
        await self.send_block(message(Code.RAMP_CHANGE, f"00 {min(self.rates):04X}"))
        motion = self.model.motion
        if motion.active and motion.next_boundary and rng.random() < 0.8:
            await host.go(max(host.t, motion.next_boundary - rng.randint(70, 150)))
        await self.send_block(message(Code.RAMP_CHANGE, f"00 {self.speed():04X}"))
        await self.attend(3_000)

    async def walk_change(self) -> None:
        """Send instruction 88 while the motor decelerates because of instruction 81."""
        await self.send_block(message(Code.FOREVER_RAMP, f"00 {min(self.rates):04X}"))
        await self.attend(self.rng.choice((1_000, 2_500)))
        await self.send_block(message(Code.SLOW_STOP, "00"))
        await self.send_block(message(Code.CHANGE, f"00 {self.speed():04X}"))
        await self.attend(800)
        await self.send_block(message(Code.STOP, "00"))

    async def start_on_a_limit(self) -> None:
        """Start a motion while a limit of its direction or of the other direction is asserted (low)."""
        pin = self.rng.choice((*LIMITS, *SLOW_LIMITS))
        await self.host.pins(**{pin: 0})
        await self.send_block(self.finite_block().hex())
        await self.attend(300)
        await self.host.pins(**{pin: 1})

    async def endless(self) -> None:
        """Run instruction 85 or 86 with changes of speed, then stop the motion."""
        await self.send_block(self.endless_block().hex())
        await self.meanwhile(self.rng.choice((2, 4, 7)))
        if self.model.motion.active:
            await self.send_block(self.rng.choice((STOPS[0], STOPS[1], STOPS[1])))
        await self.attend(1_500)

    async def overrides(self) -> None:
        """Register entries of the command FIFO for positions and events, before or during a motion."""
        rng = self.rng
        before = rng.random() < 0.4
        start = self.endless_block() if rng.random() < 0.6 else self.finite_block()
        if not before:
            await self.send_block(start.hex())
        ahead, pins = 0, []
        for _ in range(rng.choice((1, 2, 3, 3, 5, 9))):
            trigger = rng.choice((0, 0, 0, 0, 2, 1, 3))
            step = rng.choice((0, 1, 3, 4, 6, 9))  # a step of 0 arms the entry for the current position
            ahead += step + (0 if before or not step else 6)
            if trigger in (1, 3):
                pins.append("evt0_n" if trigger == 1 else "evt1_n")
                if rng.random() < 0.3:
                    block = self.finite_block() if rng.random() < 0.6 else self.endless_block()
                    await self.send_block((block[:3] + bytes([block[3] | 4 | trigger]) + block[4:]).hex())
                    continue
            await self.send_block(self.change_block(trigger, ahead).hex())
        if before:
            await self.send_block(start.hex())
        for pin in (*pins, *pins):
            await self.attend(rng.choice((100, 500, 1_200)))
            await self.press(pin)
        await self.attend(3_000)

    async def press(self, pin: str) -> None:
        """Trigger an event, in some cases with a limit that prevents the motion that it would start."""
        if self.rng.random() < 0.06:
            for limit in LIMITS:
                self.background.blip(self.host.t + 1, limit, 0, 400)
        low = self.rng.choice((2, 6, 60)) if not self.slow else 420_000
        if self.slow and self.rng.random() < 0.5:
            low = 30
        self.background.blip(self.host.t + 2, pin, 0, low)
        await self.host.pause(3 if not self.slow else low + 8)
        await self.attend(250)

    async def register(self, number: int, count: int) -> None:
        """Fill an event buffer."""
        rng = self.rng
        for _ in range(count):
            kind = rng.random()
            if kind < 0.06:
                block = bytes.fromhex(message(Code.STEP, "00"))
            elif kind < 0.3:
                block = self.finite_block()
            elif kind < 0.4:
                block = self.endless_block()
            elif kind < 0.7:
                block = self.change_block()
            else:
                block = bytes.fromhex(rng.choice(ASKED))
            await self.send_block(message(Code.EVENT_SET, f"{number:02X} {block.hex()}"))

    async def events(self) -> None:
        """Fill an event buffer and trigger its entries."""
        rng = self.rng
        numbers = rng.choice(((0,), (1,), (0, 1)))
        for number in numbers:
            await self.register(number, rng.randint(1, 3))
        if rng.random() < 0.5:
            await self.send_block(self.endless_block().hex())
        for _ in range(rng.randint(2, 7 if not self.slow else 2)):
            await self.press(f"evt{rng.choice(numbers)}_n")
            await self.attend(rng.choice((0, 200, 700)))
        for number in numbers:
            if rng.random() < 0.4:
                await self.send_block(message(Code.EVENT_SET, f"{2 | number:02X}"))

    async def coincident_events(self) -> None:
        """Apply events and a host block at nearly the same time."""
        host, rng = self.host, self.rng
        for number in (0, 1):
            if rng.random() < 0.7:
                await self.register(number, 1)
        if rng.random() < 0.7:
            await self.send_block(self.endless_block().hex())
            await self.send_block(self.change_block(rng.choice((0, 1, 3)), rng.randint(8, 16)).hex())
        for _ in range(rng.randint(1, 4)):
            await self.attend(200)
            block = bytes.fromhex(rng.choice((*ASKED, *STOPS))) \
                if rng.random() < 0.6 else self.change_block()  # fmt: skip
            header = host.t + 3 * (len(block) + 2)
            for pin in ("evt0_n", "evt1_n"):
                if rng.random() < 0.7:
                    self.background.blip(max(host.t + 1, header + rng.randint(-50, 40)), pin, 0, 20)
            if not await host.read(CSR) & MWEF:
                await host.put(block.hex())
            await self.attend(500)

    # ------------------------------------------------------------ inputs

    async def origin(self) -> None:
        """Run instruction 10 or 11 with an origin input that is asserted and deasserted."""
        host, rng = self.host, self.rng
        await self.send_block(self.endless_block((0x10, 0x11, 0x11)).hex())
        for _ in range(rng.randint(1, 3)):
            await self.attend(rng.choice((300, 900, 2_000)))
            if rng.random() < 0.4:
                await self.meanwhile(1)
            due = self.model.motion.next_boundary
            at = max(host.t + 1, (due or host.t) + rng.randint(-9, 5))
            self.background.blip(at, "org_n", 0, rng.choice((1, 5, 700, 3_000)))
            self.background.blip(at + rng.choice((0, 2, 300)), "index_n", 0, rng.choice((1, 30, 900)))
        await self.attend(2_500)

    async def slow_limit(self) -> None:
        """Assert high-speed limits and limits while a motion is running."""
        host, rng = self.host, self.rng
        if rng.random() < 0.85:
            await self.send_block(
                message(Code.SPEED_LIMIT, f"{rng.choice((max(self.rates), self.speed())):04X}")
            )
        block = self.endless_block() if rng.random() < 0.6 else self.finite_block()
        await self.send_block(block.hex())
        pins = SLOW_LIMITS if rng.random() < 0.8 else LIMITS
        for _ in range(rng.randint(1, 3)):
            due = self.model.motion.next_boundary
            at = max(host.t + 1, (due or host.t) + rng.randint(-9, 5))
            pin = pins[self.model.motion.direction ^ (rng.random() < 0.1)]
            self.background.blip(at, pin, 0, rng.choice((1, 3, 100, 1_000, 3_000)))
            if rng.random() < 0.3:
                await self.meanwhile(1)
            await self.attend(rng.choice((300, 900, 2_000)))

    async def inputs(self) -> None:
        """Send instruction 28 and change the general input, with a host that reads slowly."""
        host, rng = self.host, self.rng
        await self.send_block(
            message(Code.MASK, f"{rng.choice((1, 1, 1, 0)):02X} {rng.choice((0xFF, 0x0F, 0x5A, 1)):02X}")
        )
        if rng.random() < 0.5:
            await self.send_block(self.finite_block().hex())
        for _ in range(rng.randint(2, 6)):
            await host.pins(auxi=rng.randrange(256))
            await host.pause(self.model.timebase.cyc(rng.choice((30, 500, 810, 1_000))))
            if rng.random() < 0.35:
                await self.attend(50)

    async def encoder(self) -> None:
        """Enable monitors and make moves that the encoder follows."""
        rng = self.rng
        self.follows = rng.choice((1.0, 0.9, 0.6, 0.2))
        await self.send_block(
            message(
                Code.POSITION_SET, f"01 {self.model.position + rng.choice((0, 0, 1, -3)) & 0xFFFFFFFF:08X}"
            )
        )
        for code in rng.choice(((2,), (3,), (2, 3))):
            flags, distance = rng.choice((1, 3, 3, 5, 7, 7)), rng.choice((1, 2, 2, 4))
            await self.send_block(message(code, f"{flags:02X} 00 {distance:02X}"))
        for _ in range(rng.randint(1, 3)):
            await self.send_block(self.finite_block().hex())
            await self.meanwhile(rng.choice((0, 1)))
            await self.attend(rng.choice((1_500, 4_000)))
        if rng.random() < 0.7:
            self.follows = 0.0

    async def interlock(self) -> None:
        """Enable the interlock control and move past its position."""
        rng = self.rng
        step = rng.choice((1, 3, 9, -2, -5))
        await self.send_block(
            message(Code.INTERLOCK_POSITION, f"{self.model.position + step & 0xFFFFFFFF:08X}")
        )
        await self.send_block(message(Code.INTERLOCK))
        await self.finite()

    async def start_while_run_is_low(self) -> None:
        """Start a motion while RUN is low, so that the motion waits."""
        host, rng = self.host, self.rng
        await host.pins(run=0)
        await self.send_block((self.finite_block() if rng.random() < 0.6 else self.endless_block()).hex())
        for _ in range(rng.randint(0, 2)):
            await self.send_block(rng.choice((*ASKED, message(Code.ALARM_CLEAR), message(Code.STOP, "00"))))
        if rng.random() < 0.2:
            await self.send_block(message(Code.RUN_MONITOR))
        if rng.random() < 0.1:
            self.background.blip(host.t + 2, "alm_n", 0, 50)
        await self.attend(300)
        await host.pins(run=1)
        await self.attend(2_000)

    async def end_wait(self) -> None:
        """Enable the END terminal, make a move, and assert END after it in most cases."""
        host, rng = self.host, self.rng
        await self.send_block(message(Code.END_TERMINAL, "01"))
        await self.send_block(self.finite_block().hex())
        await self.meanwhile(rng.choice((0, 1)))
        await self.attend(4_000)
        for _ in range(rng.randint(0, 2)):
            await self.send_block(self.change_block().hex())
        if rng.random() < 0.7:
            self.background.blip(host.t + 3, "end_n", 0, 60)
            await self.attend(200)
        await self.send_block(message(Code.END_TERMINAL, "00"))

    async def alarm(self) -> None:
        """Assert alm_n during an operation, then clear the alarm, in some cases while the pin is still
        low.
        """
        host, rng = self.host, self.rng
        if rng.random() < 0.8:
            await self.send_block((self.finite_block() if rng.random() < 0.6 else self.endless_block()).hex())
        self.background.blip(host.t + rng.randint(1, 600), "alm_n", 0, rng.choice((3, 200, 1_500)))
        await self.attend(rng.choice((300, 700)))
        await self.send_block(message(Code.ALARM_CLEAR))

    async def unread(self) -> None:
        """Leave reports unread until their class has more reports than it can store (P312-RSP-20)."""
        host, rng = self.host, self.rng
        start_while_run_is_low = rng.random() < 0.4
        for _ in range(rng.randint(2, 3)):
            if start_while_run_is_low:
                await host.pins(run=0)
            for _ in range(12):
                if not await host.read(CSR) & MWEF:
                    break
                await host.pause(100)
            # Read an answer as soon as possible, so that the device executes the next instruction.
            if self.model.core.responses.answer:
                await self.response()
            await host.put(message(Code.STEP, "00"))
            await host.pause(400)
            await host.pins(run=1)
            await host.pause(rng.choice((600, 3_000)))
            if not await host.read(CSR) & MREF and rng.random() < 0.9:
                await self.response()
