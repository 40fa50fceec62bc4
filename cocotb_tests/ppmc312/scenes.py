"""Scenes of a random host of the PPMC-312: what a machine does, each with what may come in between."""

from __future__ import annotations

from cocotb_tests.ppmc312.words import message
from openppmc.model.ppmc312.codes import Code, State
from openppmc.model.ppmc312.stages.plan import ramped

from .host import CSR, DRR, MREF, MWEF, RAR
from .rough_host import Player, some_equal

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
"""clk between two polls of a host that attends to the part."""


class Scenes(Player):
    """Scenes; `follows`: chance that an encoder pulse answers a pulse, 0 without an encoder."""

    follows = 0.0

    # ------------------------------------------------------------ the host's side

    def response(self) -> None:
        """Read what is loaded."""
        host = self.host
        for _ in range(0x40 - host.read(RAR)):
            host.read(DRR)
        host.sync()

    def attend(self, clk: int) -> None:
        """Let time pass; read what comes, and let the encoder follow."""
        host, rng = self.host, self.rng
        end = host.t + clk * (4 if self.slow else 1)
        while True:
            while not host.read(CSR) & MREF and rng.random() < self.reads:
                self.response()
            if self.follows:
                self.follow()
            if host.t >= end:
                return
            host.pause(min(POLL, end - host.t))

    def follow(self) -> None:
        """The encoder goes after the position, with slips."""
        counters, host = self.model.core.counters, self.host
        behind = counters.pulse - counters.encoder & 0xFFFFFFFF
        if behind and self.rng.random() < self.follows:
            wrong = self.rng.random() < 0.04
            host.pins(epdir=int(behind >> 31) ^ wrong)
            host.pins(epin=1)
            host.pause(self.rng.randint(1, 4))
            host.pins(epin=0)

    def tell(self, text: str) -> None:
        """Write a block as soon as it is taken, and read until its answer has come (or nearly so)."""
        host, rng = self.host, self.rng
        for _ in range(40):
            if not host.read(CSR) & MWEF:
                break
            self.attend(POLL)
        host.put(text)
        if rng.random() < 0.06:
            return
        for _ in range(14):
            self.attend(40)
            if not host.read(CSR) & MWEF:
                break
        self.attend(10)

    def curve(self) -> None:
        """A short free curve on a fast base clock, so that whole operations are short."""
        host, rng = self.host, self.rng
        clk = rng.choice((0, 0, 0, 0, 0, 0, 0, 1, 2, 6, 7)) if not self.slow else rng.choice((0, 1))
        count = rng.choice((2, 3, 3, 4, 4, 5, 7))
        least, most = {0: (22, 130), 1: (12, 60), 2: (8, 30)}.get(clk, (3, 14))
        self.rates = sorted(rng.randint(least, most) for _ in range(count))
        self.rates = some_equal(self.rates, 0.3)
        separate = rng.random() < 0.55
        up = down = count
        if separate and rng.random() < 0.6:
            up, down = rng.choice(((count, rng.randint(2, count)), (rng.randint(2, count), count)))
        head = (
            f"02 04 01 {0x10 | clk:02X} {up:02X} {down:02X}" if separate else f"02 03 01 {clk:02X} {up:02X}"
        )
        lists = [(2, self.rates), *((3, [rng.randint(2, 4) for _ in range(n)])
                                    for n in ((up, down) if separate else (up,)))]  # fmt: skip
        self.tell(head)
        for number, (width, values) in enumerate(lists):
            data = b"".join(value.to_bytes(width, "big") for value in values)
            self.tell(f"{int(number == len(lists) - 1):02X} {len(data):02X} {data.hex()}")
        self.background.external(host.t + 2, clk >= 6, rng)

    # ------------------------------------------------------------ numbers

    def speed(self) -> int:
        """A rate near those of the table."""
        rng = self.rng
        if rng.random() < 0.03:
            return self.rate()
        if rng.random() < 0.5:
            return rng.choice(self.rates)
        return max(2, rng.randint(min(self.rates) - 1, max(self.rates) + 8))

    def distance(self, rate: int) -> int:
        """N near the limits between the kinds of operations."""
        rng, table = self.rng, self.model.core.table
        if table is None or rng.random() < 0.2:
            return rng.choice((1, 2, 3, 9, 30, 0))
        rate = rate or table.high
        plan = ramped(table, rate, 10_000)
        both = plan.up + plan.down
        near = rng.choice((both, both, both + 12, both // 2, plan.up, plan.down, both * 3 // 4))
        return max(1, near + rng.choice((0, 0, -1, 1, 2, 5)))

    def finite_block(self, more: int = 0) -> bytes:
        """82 or 83 with a sensible end; more: pulses beyond it."""
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
        """80, 81, 87 or 88; registered for a trigger, or for a position so far ahead."""
        rng = self.rng
        code = rng.choice(codes)
        flags = 0 if trigger is None else 4 | trigger
        data = bytes([flags]) + (self.speed().to_bytes(2, "big") if code > 0x81 else b"")
        if trigger in (0, 2):
            step = -ahead if self.model.motion.direction else ahead
            data += (self.model.position + step & 0xFFFFFFFF).to_bytes(4, "big")
        return bytes([3, len(data) + 1, code]) + data

    # ------------------------------------------------------------ motions

    def meanwhile(self, times: int) -> None:
        """What comes in the middle of an operation, often at a boundary."""
        host, rng, model = self.host, self.rng, self.model
        for _ in range(times):
            if model.state not in (State.ACC, State.FIX, State.WRN):
                return
            what = rng.random()
            if what < 0.4:
                self.aligned()
            elif what < 0.65:
                self.tell(self.change_block().hex())
            elif what < 0.8:
                self.tell(rng.choice(ASKED))
            elif what < 0.84:
                pin = rng.choice((*LIMITS, "org_n", "end_n", "alm_n", "index_n"))
                self.background.blip(host.t + rng.randint(1, 900), pin, 0, rng.choice((1, 4, 400)))
            self.attend(rng.choice((0, 30, 300, 900)))

    def finite(self) -> None:
        """A move, with or without disturbance."""
        rng = self.rng
        if rng.random() < 0.35:
            self.changed()
            return
        self.tell(self.finite_block().hex())
        self.meanwhile(rng.choice((0, 0, 1, 2, 4)))
        self.attend(4_000)

    def changed(self) -> None:
        """A move with changes of speed, which has to find its deceleration point again."""
        rng, motion = self.rng, self.model.motion
        self.tell(self.finite_block(rng.randint(12, 40)).hex())
        for _ in range(rng.choice((1, 1, 2, 3))):
            if not motion.active:
                break
            self.attend(rng.choice((0, 200, 900)))
            if rng.random() < 0.7:
                self.tell(self.change_block(codes=(0x87, 0x88)).hex())
            else:
                self.aligned()
                self.attend(120)
        self.attend(6_000)

    def meeting_point(self) -> None:
        """Two 87 shortly before the deceleration point, after an 88 to where a ramp has many stages."""
        host, rng, motion, table = self.host, self.rng, self.model.motion, self.model.core.table
        if table is None:
            return
        rate = rng.choice(self.rates)
        full = ramped(table, rate, None).up + sum(table.pd[table.sd : table.stage(rate) + 1])
        count = full + rng.randint(16, 24)
        self.tell(message(Code.RAMP, f"00 {rate:04X} {count:08X}"))
        before = rng.randint(6, 12)
        while motion.active and count - motion.sequence.done > motion.sequence.plan.down + before:
            self.attend(30)
        self.tell(message(Code.CHANGE, f"00 {max(self.rates):04X}"))
        self.attend(rng.choice((30, 200)))
        self.tell(message(Code.RAMP_CHANGE, f"00 {min(self.rates):04X}"))
        if motion.active and motion.due and rng.random() < 0.8:
            host.go(max(host.t, motion.due - rng.randint(70, 150)))
        self.tell(message(Code.RAMP_CHANGE, f"00 {self.speed():04X}"))
        self.attend(3_000)

    def walk_change(self) -> None:
        """88 in the walk of an 81."""
        self.tell(message(Code.FOREVER_RAMP, f"00 {min(self.rates):04X}"))
        self.attend(self.rng.choice((1_000, 2_500)))
        self.tell(message(Code.SLOW_STOP, "00"))
        self.tell(message(Code.CHANGE, f"00 {self.speed():04X}"))
        self.attend(800)
        self.tell(message(Code.STOP, "00"))

    def start_on_a_limit(self) -> None:
        """A limit of the same or the other direction is low when a motion starts."""
        pin = self.rng.choice((*LIMITS, *SLOW_LIMITS))
        self.host.pins(**{pin: 0})
        self.tell(self.finite_block().hex())
        self.attend(300)
        self.host.pins(**{pin: 1})

    def endless(self) -> None:
        """85 or 86 with changes, then a stop."""
        self.tell(self.endless_block().hex())
        self.meanwhile(self.rng.choice((2, 4, 7)))
        if self.model.motion.active:
            self.tell(self.rng.choice((STOPS[0], STOPS[1], STOPS[1])))
        self.attend(1_500)

    def overrides(self) -> None:
        """Entries of the command FIFO for positions and events, before or during a motion."""
        rng = self.rng
        before = rng.random() < 0.4
        start = self.endless_block() if rng.random() < 0.6 else self.finite_block()
        if not before:
            self.tell(start.hex())
        ahead, pins = 0, []
        for _ in range(rng.choice((1, 2, 3, 3, 5, 9))):
            trigger = rng.choice((0, 0, 0, 0, 2, 1, 3))
            step = rng.choice((0, 1, 3, 4, 6, 9))  # 0: armed where the position is already
            ahead += step + (0 if before or not step else 6)
            if trigger in (1, 3):
                pins.append("evt0_n" if trigger == 1 else "evt1_n")
                if rng.random() < 0.3:
                    block = self.finite_block() if rng.random() < 0.6 else self.endless_block()
                    self.tell((block[:3] + bytes([block[3] | 4 | trigger]) + block[4:]).hex())
                    continue
            self.tell(self.change_block(trigger, ahead).hex())
        if before:
            self.tell(start.hex())
        for pin in (*pins, *pins):
            self.attend(rng.choice((100, 500, 1_200)))
            self.press(pin)
        self.attend(3_000)

    def press(self, pin: str) -> None:
        """An event, now and then with a limit that forbids what it starts."""
        if self.rng.random() < 0.06:
            for limit in LIMITS:
                self.background.blip(self.host.t + 1, limit, 0, 400)
        low = self.rng.choice((2, 6, 60)) if not self.slow else 420_000
        if self.slow and self.rng.random() < 0.5:
            low = 30
        self.background.blip(self.host.t + 2, pin, 0, low)
        self.host.pause(3 if not self.slow else low + 8)
        self.attend(250)

    def register(self, number: int, count: int) -> None:
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
            self.tell(message(Code.EVENT_SET, f"{number:02X} {block.hex()}"))

    def events(self) -> None:
        """An event buffer filled and worked off."""
        rng = self.rng
        numbers = rng.choice(((0,), (1,), (0, 1)))
        for number in numbers:
            self.register(number, rng.randint(1, 3))
        if rng.random() < 0.5:
            self.tell(self.endless_block().hex())
        for _ in range(rng.randint(2, 7 if not self.slow else 2)):
            self.press(f"evt{rng.choice(numbers)}_n")
            self.attend(rng.choice((0, 200, 700)))
        for number in numbers:
            if rng.random() < 0.4:
                self.tell(message(Code.EVENT_SET, f"{2 | number:02X}"))

    def meeting(self) -> None:
        """Events and a host block at nearly the same time."""
        host, rng = self.host, self.rng
        for number in (0, 1):
            if rng.random() < 0.7:
                self.register(number, 1)
        if rng.random() < 0.7:
            self.tell(self.endless_block().hex())
            self.tell(self.change_block(rng.choice((0, 1, 3)), rng.randint(8, 16)).hex())
        for _ in range(rng.randint(1, 4)):
            self.attend(200)
            block = bytes.fromhex(rng.choice((*ASKED, *STOPS))) \
                if rng.random() < 0.6 else self.change_block()  # fmt: skip
            header = host.t + 3 * (len(block) + 2)
            for pin in ("evt0_n", "evt1_n"):
                if rng.random() < 0.7:
                    self.background.blip(max(host.t + 1, header + rng.randint(-50, 40)), pin, 0, 20)
            if not host.read(CSR) & MWEF:
                host.put(block.hex())
            self.attend(500)

    # ------------------------------------------------------------ what is around the motor

    def origin(self) -> None:
        """10 or 11 with an origin that comes, and goes."""
        host, rng = self.host, self.rng
        self.tell(self.endless_block((0x10, 0x11, 0x11)).hex())
        for _ in range(rng.randint(1, 3)):
            self.attend(rng.choice((300, 900, 2_000)))
            if rng.random() < 0.4:
                self.meanwhile(1)
            due = self.model.motion.due
            at = max(host.t + 1, (due or host.t) + rng.randint(-9, 5))
            self.background.blip(at, "org_n", 0, rng.choice((1, 5, 700, 3_000)))
            self.background.blip(at + rng.choice((0, 2, 300)), "index_n", 0, rng.choice((1, 30, 900)))
        self.attend(2_500)

    def slow_limit(self) -> None:
        """High-speed limits and limits met while running."""
        host, rng = self.host, self.rng
        if rng.random() < 0.85:
            self.tell(message(Code.SPEED_LIMIT, f"{rng.choice((max(self.rates), self.speed())):04X}"))
        block = self.endless_block() if rng.random() < 0.6 else self.finite_block()
        self.tell(block.hex())
        pins = SLOW_LIMITS if rng.random() < 0.8 else LIMITS
        for _ in range(rng.randint(1, 3)):
            due = self.model.motion.due
            at = max(host.t + 1, (due or host.t) + rng.randint(-9, 5))
            pin = pins[self.model.motion.direction ^ (rng.random() < 0.1)]
            self.background.blip(at, pin, 0, rng.choice((1, 3, 100, 1_000, 3_000)))
            if rng.random() < 0.3:
                self.meanwhile(1)
            self.attend(rng.choice((300, 900, 2_000)))

    def inputs(self) -> None:
        """28 and a general input that changes, with a host that is slow to read."""
        host, rng = self.host, self.rng
        self.tell(
            message(Code.MASK, f"{rng.choice((1, 1, 1, 0)):02X} {rng.choice((0xFF, 0x0F, 0x5A, 1)):02X}")
        )
        if rng.random() < 0.5:
            self.tell(self.finite_block().hex())
        for _ in range(rng.randint(2, 6)):
            host.pins(auxi=rng.randrange(256))
            host.pause(self.model.timebase.cyc(rng.choice((30, 500, 810, 1_000))))
            if rng.random() < 0.35:
                self.attend(50)

    def encoder(self) -> None:
        """Monitors on, an encoder that follows."""
        rng = self.rng
        self.follows = rng.choice((1.0, 0.9, 0.6, 0.2))
        self.tell(
            message(
                Code.POSITION_SET, f"01 {self.model.position + rng.choice((0, 0, 1, -3)) & 0xFFFFFFFF:08X}"
            )
        )
        for code in rng.choice(((2,), (3,), (2, 3))):
            flags, distance = rng.choice((1, 3, 3, 5, 7, 7)), rng.choice((1, 2, 2, 4))
            self.tell(message(code, f"{flags:02X} 00 {distance:02X}"))
        for _ in range(rng.randint(1, 3)):
            self.tell(self.finite_block().hex())
            self.meanwhile(rng.choice((0, 1)))
            self.attend(rng.choice((1_500, 4_000)))
        if rng.random() < 0.7:
            self.follows = 0.0

    def interlock(self) -> None:
        """The control, and a motion over its position."""
        rng = self.rng
        step = rng.choice((1, 3, 9, -2, -5))
        self.tell(message(Code.INTERLOCK_POSITION, f"{self.model.position + step & 0xFFFFFFFF:08X}"))
        self.tell(message(Code.INTERLOCK))
        self.finite()

    def held(self) -> None:
        """RUN low: a motion that waits."""
        host, rng = self.host, self.rng
        host.pins(run=0)
        self.tell((self.finite_block() if rng.random() < 0.6 else self.endless_block()).hex())
        for _ in range(rng.randint(0, 2)):
            self.tell(rng.choice((*ASKED, message(Code.ALARM_CLEAR), message(Code.STOP, "00"))))
        if rng.random() < 0.2:
            self.tell(message(Code.RUN_MONITOR))
        if rng.random() < 0.1:
            self.background.blip(host.t + 2, "alm_n", 0, 50)
        self.attend(300)
        host.pins(run=1)
        self.attend(2_000)

    def end_wait(self) -> None:
        """The positioning end monitored."""
        host, rng = self.host, self.rng
        self.tell(message(Code.END_TERMINAL, "01"))
        self.tell(self.finite_block().hex())
        self.meanwhile(rng.choice((0, 1)))
        self.attend(4_000)
        for _ in range(rng.randint(0, 2)):
            self.tell(self.change_block().hex())
        if rng.random() < 0.7:
            self.background.blip(host.t + 3, "end_n", 0, 60)
            self.attend(200)
        self.tell(message(Code.END_TERMINAL, "00"))

    def alarm(self) -> None:
        """alm_n in the middle of something; cleared at once or with the pin still low."""
        host, rng = self.host, self.rng
        if rng.random() < 0.8:
            self.tell((self.finite_block() if rng.random() < 0.6 else self.endless_block()).hex())
        self.background.blip(host.t + rng.randint(1, 600), "alm_n", 0, rng.choice((3, 200, 1_500)))
        self.attend(rng.choice((300, 700)))
        self.tell(message(Code.ALARM_CLEAR))

    def unread(self) -> None:
        """Reports that stay unread until there are more of their class than places (P312-RSP-20)."""
        host, rng = self.host, self.rng
        held = rng.random() < 0.4
        for _ in range(rng.randint(2, 3)):
            if held:
                host.pins(run=0)
            for _ in range(12):
                if not host.read(CSR) & MWEF:
                    break
                host.pause(100)
            # An answer is read with the first chance, so that the next instruction is executed.
            if self.model.core.responses.answer:
                self.response()
            host.put(message(Code.STEP, "00"))
            host.pause(400)
            host.pins(run=1)
            host.pause(rng.choice((600, 3_000)))
            if not host.read(CSR) & MREF and rng.random() < 0.9:
                self.response()
