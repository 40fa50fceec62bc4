"""Random hosts of the PMC006: frames good and bad, motions, stops, programs, pins that move by themselves.

A seed decides all of it, `plan` the build. The host plays on the golden model; the tape goes to the RTL.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable
from math import ceil

from cocotb_tests.common.background import Background
from cocotb_tests.common.config import Config
from cocotb_tests.common.scripts import building

from .frames import checked, command, reply
from .modules import D8E, F8B, ODD
from .random_program import SPEEDS, some_op, some_program
from .scenes import device, image, page, words
from .script_host import Host006

BUILDS: tuple[tuple[Config, int], ...] = ((F8B, 80), (ODD, 12), (D8E, 8))
EDGES = (-1, 0x100, 0x10000, 0x7FFFFFFF, -0x80000000)
DATA: dict[str, tuple[int, ...]] = {
    "F": (0, 0, 1, 2),
    "J": (0, 1, 2, 3, 4),
    "L": (3000, 3000, 2500, 65, 64, 3001, 0),
    "M": (100, 300, 1200, 1201, 0),
    "P": (300, 1250, 2000, 0),
    "Q": (1, 2, 3, 4, 0, 5),
    "S": (3000, 3000, 2000, 65, 0),
    "T": (0, 1, 2, 5, 63, 64),
    "Y": (1, 3, 5, 7, 0, 8),
    "Z": (200, 511, 100, 0, 512),
    "a": (0, 1, 1),
    "d": (0, 1, 2),
    "e": (400, 800, 1075, 2000, 4000, 4001),
    "f": (3, 3, 1, 2, 0, 4),
    "g": (0, 0, 0, 1),
    "i": (0, 5, -5, 0x7FFFFFFF, -0x80000000),
    "m": (0, 2, 4, 8, 16, 32, 64, 128, 3),
    "o": (5, 5, 4, 0, 6),
    "u": (5, 5, 4, 0, 6),
    "v": SPEEDS,
    "y": (0x08, 0xF8, 0x50, 0, 7),
}
READS = "cjOxXKRknqrhU"
COUNTS = (1, 2, 3, 5, 12, 60, 255, 256, 260, 300, 1000, 0x7FFFFFFF, 0, -1)


def plan(seed: int) -> Config:
    """Build of a seed (any int)."""
    builds, weights = zip(*BUILDS, strict=True)
    return random.Random(f"p006 build {seed}").choices(builds, weights)[0]


def play(seed: int, config: Config) -> Talker:
    """Play one seed on the model; AssertionError if the part hangs or answers nonsense."""
    with building(config):
        return Talker(seed).play()


class Talker:
    """One random host. `seen` counts what it has done and found."""

    def __init__(self, seed: int) -> None:
        self.rng = rng = random.Random(f"p006 {seed}")
        memory = None
        if rng.random() < 0.08:
            memory = device(self._content(), write_us=rng.choice((300, 2_000, 12_000)))
        elif rng.random() < 0.03:
            memory = device(missing=True)
        levels = {} if memory else {"sda_i": 0}
        if rng.random() < 0.2:
            levels |= {"ext1": rng.getrandbits(1), "ext2": rng.getrandbits(1), "gpi": rng.randrange(32)}
        self.host = Host006(
            eeprom=memory, levels=levels, boot=False, error=rng.choice((0, 0, 0, 0.02, -0.02))
        )
        self.model = self.host.model
        self.background = Background(self.model, ("sda_i", "scl_i", "fset_n"))
        self.host.boot()
        self.seen: Counter[str] = Counter()
        self.left: float = rng.randint(12, 19) if not memory else 12
        self.noisy = rng.random() < 0.25

    def _content(self) -> bytes:
        """What an EEPROM may hold: programs that start, damaged pages."""
        rng = self.rng
        params = page(a0B=rng.getrandbits(1), a04=rng.choice((4, 16, 3)), a0A=rng.randrange(4), a06=5, a07=5)
        content = bytearray(image(params, some_program(rng), mark=rng.choice((0x5A, 0x5A, 0x5A, 0))))
        if rng.random() < 0.2:
            content[rng.randrange(len(content))] ^= 1 << rng.randrange(8)
        return bytes(content)

    # ------------------------------------------------------------ top level

    def play(self) -> Talker:
        """Actions of all kinds; then a good frame is answered, whatever has been."""
        rng = self.rng
        for code, value in (("L", 3000), ("S", 3000), ("v", 3000), ("u", 5), ("o", 5)):
            if rng.random() < 0.9:
                self.frame(code, value)
        self.frame("f", rng.choice((3, 3, 2, 0)))
        for code, data in (("m", (0, 2, 4, 8)), ("d", (0,)), ("J", (1, 2, 3))):
            if rng.random() < 0.45:
                self.frame(code, rng.choice(data))
        actions: tuple[tuple[Callable[[], None], float], ...] = (
            (self.setting, 12),
            (self.start, 22),
            (self.meddle, 14),
            (self.read, 6),
            (self.ext, 8),
            (self.stall, 4),
            (self.analog, 4),
            (self.keys, 2),
            (self.chopper, 8),
            (self.single, 4),
            (self.program, 6),
            (self.outputs, 7),
            (self.bad_frame, 6),
            (self.foreign, 4),
            (self.talk_out_of_turn, 3),
            (self.noise, 3),
            (self.unknown, 2),
            (self.save, 1),
            (self.pause, 4),
            (self.reset, 0.7),
        )
        while self.left > 0:
            act = rng.choices([act for act, _ in actions], [weight for _, weight in actions])[0]
            self.seen[act.__name__] += 1
            act()
        return self.recover()

    def recover(self) -> Talker:
        """A host that keeps silent for a while is understood again."""
        host = self.host
        self.background.stop(host.t + 1)
        host.error *= 0
        host.t += 2
        host.pause(ceil(215 * host.bit))
        host.forget()
        for code in "FI":
            host.say(code)
            self.await_reply()
            host.forget()
        assert host.ask("R") == 0x123 and not host.busy
        self.seen["steps"] += host.made(0)
        self.seen["halts"] += sum(not level for _, level in host.edges("mon_busy"))
        for pin in ("gpo", "bridge_a_en", "mon_dir", "m11", "ext1_pu", "phase_a_sign"):
            self.seen[pin] += len(host.edges(pin))
        return self

    # ------------------------------------------------------------ frames

    def frame(self, code: str | int, data: int = 0) -> None:
        """A good frame, in a noisy place with wrong levels somewhere; then its reply."""
        rng, host = self.rng, self.host
        self.left -= 1
        if rng.random() < 0.5:
            host.pause(rng.choice((1, 3, 20, 100, 700, 3_000)))
        host.say(code, data) if not self.noisy else self.put(command(host.address, code, data))
        self.seen[f"code {code}"] += 1
        self.await_reply()

    def put(self, line: bytes) -> None:
        """Bytes, sometimes with spikes or gaps."""
        rng, host = self.rng, self.host
        for byte in line:
            spikes = []
            if self.noisy and rng.random() < 0.1:
                spikes = [(rng.uniform(0, 9.4), rng.randint(1, int(host.bit * 0.9)))]
            host.character(byte, spikes=spikes, stop=int(not self.noisy or rng.random() > 0.01))
            if rng.random() < 0.04:
                host.pause(rng.choice((5, 70, 900)))

    def await_reply(self) -> None:
        """Wait for the reply if one comes; now and then do not, but then know nothing of the line."""
        host = self.host
        host.go(max(host.t, host.e + ceil(host.bit) + 9))
        if host.out("de"):
            self.seen["reply"] += 1
        if self.rng.random() < 0.97:
            host.forget()
        host.address = self.model.desk.settings.addr

    def setting(self) -> None:
        """A register, mostly with legal data."""
        code = self.rng.choice(list(DATA))
        data = self.rng.choice(DATA[code]) if self.rng.random() < 0.93 else self.rng.choice(EDGES)
        self.frame(code, data)

    def read(self) -> None:
        """Something that has no effect."""
        self.frame(self.rng.choice(READS), self.rng.choice((0, 0, -1)))

    def unknown(self) -> None:
        """Any code."""
        self.frame(self.rng.choice((0, 0x40, 0x48, 0x5B, 0x7B, 0xA5, 0xFF, self.rng.randrange(256))), 1)

    def outputs(self) -> None:
        """GPO."""
        self.frame("y", self.rng.choice((0x08, 0xF8, 0x50, 0x87, 0, -1)))

    def save(self) -> None:
        """t or B."""
        self.frame(self.rng.choice("ttB"))

    def start(self) -> None:
        """A motion, if there can be one."""
        rng = self.rng
        if rng.random() < 0.3:
            self.frame("N", rng.choice((1, 1, 1, 0, 2)))
        else:
            self.frame("s", rng.choice(COUNTS))
        if rng.random() < 0.4:
            self.host.pause(rng.choice((500, 4_000, 12_000)))

    def meddle(self) -> None:
        """What hosts do while something moves."""
        rng = self.rng
        code = rng.choice("vvvvINNNgissecbbllpmdu")
        data = rng.choice(DATA.get(code, (0, 1, 1))) if code != "s" else rng.choice(COUNTS)
        self.frame(code, data)
        if code == "g" and data:
            self.frame("g", 0)

    def single(self) -> None:
        """One instruction by E."""
        rng = self.rng
        place = rng.randrange(100)
        self.frame("A", 2 * place)
        for word in some_op(rng, 100).words:
            self.frame("W", word)
        self.frame("A", 2 * place)
        for _ in range(rng.randint(1, 2)):
            self.frame("E")
        self.left += 3

    def program(self) -> None:
        """A program, from the host or, quicker, from one that is already there; then life goes on."""
        rng = self.rng
        program = some_program(rng)[: rng.choice((3, 5))]
        self.frame("A", 0)
        for word in words(program):
            self.frame("W", word)
        self.frame("A", rng.choice((0, 0, 0, 2)))
        self.frame("z")
        self.left += len(program)
        if rng.random() < 0.5:
            self.host.pause(rng.choice((2_000, 9_000)))

    # ------------------------------------------------------------ pins

    def ext(self) -> None:
        """Emergency switches: a press, chatter, an edge near the end of a frame; often cleared afterwards."""
        rng, t = self.rng, self.host.t
        pin = rng.choice(("ext1", "ext2"))
        level = self.model.inputs[pin]
        near = ceil(79.5 * self.host.bit) + rng.randint(-12, 40)
        first = t + rng.choice((near, near, rng.randrange(1, 12_000)))
        for number in range(rng.choice((1, 1, 2, 5))):
            level ^= 1
            self.background.add(first + number * rng.choice((1, 2, 50)), **{pin: level})
        self.frame(rng.choice("jjsNfb"), rng.choice((0, 1, 3)))
        if rng.random() < 0.7:
            self.frame("b")
            self.frame("l")

    def stall(self) -> None:
        """Samples of the back EMF while, perhaps, something moves."""
        rng = self.rng
        if rng.random() < 0.6:
            self.frame("Y", rng.choice((1, 3, 5, 7)))
            self.frame("Z", rng.choice((511, 200)))
            self.frame("T", rng.choice((1, 2, 4)))
        if rng.random() < 0.7:
            self.frame("N", 1)
        t = self.host.t + rng.randrange(1, 2_000)
        for _ in range(rng.randint(1, 8)):
            self.background.add(t, bemf_level=rng.choice((0, 100, 199, 200, 600)), bemf_valid=1)
            t += rng.choice((1, 1, 3))
            self.background.add(t, bemf_valid=0)
            t += rng.choice((5, 100, 3_000))
        self.frame(rng.choice("jXpI"))

    def analog(self) -> None:
        """A voltage on GPI1; a motion that follows it is started by E."""
        rng = self.rng
        t = self.host.t + 1
        self.background.add(t, adc_data=rng.choice((0, 1, 300, 512, 1023)), adc_valid=1)
        self.background.add(t + 1, adc_valid=0)
        if rng.random() < 0.5:
            self.frame("A", 198)
            for word in (0x08 | 0x100, rng.choice((8000, 3000, 16_000))):
                self.frame("W", word)
            self.frame("A", 198)
            self.frame("E")
            self.left += 3
        self.start()

    def keys(self) -> None:
        """GPI pins: short and long presses."""
        rng, t = self.rng, self.host.t + 1
        for number in range(rng.randint(1, 3)):
            low = rng.choice((0b11110, 0b11101, 0b11100, rng.randrange(32)))
            self.background.add(t + number * 40, gpi=low)
        self.host.pause(self.host.us(rng.choice((300, 1_010, 1_100))))
        self.background.add(self.host.t + 1, gpi=0x1F)
        self.host.pause(self.host.us(rng.choice((10, 990, 1_050))))
        self.frame("x")

    def chopper(self) -> None:
        """Comparators for a while."""
        rng, t = self.rng, self.host.t + 1
        for _ in range(rng.randint(5, 60)):
            self.background.add(t, **{rng.choice(("cmp_a", "cmp_b")): rng.getrandbits(1)})
            t += rng.choice((1, 2, 9, 60, 170, 400))
        self.frame(rng.choice("jeg"), rng.choice((0, 4000)))

    # ------------------------------------------------------------ bad things

    def bad_frame(self) -> None:
        """Wrong check, too short, too long, a byte of noise, wrong head."""
        rng, host = self.rng, self.host
        self.left -= 1
        good = command(host.address, rng.choice("ysivI"), rng.choice((0xF8, 3, 0xA5A5A5A5)))
        kind = rng.randrange(5)
        if kind == 0:
            place = rng.randrange(8)
            line = good[:place] + bytes([good[place] ^ 1 << rng.randrange(8)]) + good[place + 1 :]
        elif kind == 1:
            line = good[: rng.randrange(1, 8)]
        elif kind == 2:
            line = good + rng.randbytes(rng.randint(1, 3))
        elif kind == 3:
            line = rng.randbytes(rng.randint(1, 9))
        else:
            line = checked(0xA5, host.address, rng.randrange(256), *rng.randbytes(4))
        self.put(line)
        if kind == 1 and rng.random() < 0.5:
            host.pause(ceil(192 * host.bit) + rng.choice((-40, -36, -35, -34, -33, -3, 0, 40)))
        self.await_reply()

    def foreign(self) -> None:
        """Traffic of other nodes."""
        rng = self.rng
        self.left -= 1
        other = rng.choice((1, 5, 0x78, 0, 0x7A))
        data = rng.choice((0, 0xA5FFA5FF, 7))
        self.put(command(other, rng.choice("jsI"), data) + reply(other, data))
        self.await_reply()

    def talk_out_of_turn(self) -> None:
        """Another frame while the reply to one is on its way."""
        rng, host = self.rng, self.host
        self.left -= 2
        host.say(rng.choice("cjy"), 0)
        host.back_to(host.e + rng.choice((0, 1, 30, 60, 100, 400, 4_000)))
        self.put(command(host.address, rng.choice("yj"), 0xF8))
        host.forget()
        if rng.random() < 0.7:
            host.pause(ceil(200 * host.bit))

    def noise(self) -> None:
        """Levels on an idle line, breaks."""
        rng, host = self.rng, self.host
        for _ in range(rng.randint(1, 5)):
            host.low(rng.choice((0.01, 0.1, 0.48, 0.5, 0.52, 1, 3, 9.3, 9.6, 12, 30)))
            host.t += rng.choice((0, 3, 50, 1_000))
        self.await_reply()

    def pause(self) -> None:
        """Nothing, for a while."""
        self.host.pause(self.rng.choice((100, 3_000, 9_000)))
        self.left -= 0.5

    def reset(self) -> None:
        """rst_n in the middle of anything."""
        rng, host = self.rng, self.host
        if rng.random() < 0.5:
            host.say("s", 100)
            host.pause(rng.choice((0, 10, 500, 3_000)))
        host.reset(rng.choice((3, 12, 300)))
        host.boot()
        host.forget()
        self.left -= 2
        for code in "LSv":
            self.frame(code, 3000)
