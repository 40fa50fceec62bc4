"""Random hosts of the PMC006: frames good and bad, motions, stops, programs, pins that move by themselves.

A seed decides all of it, `plan` the build. The host plays on the golden model; the tape goes to the RTL.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable
from math import ceil

from cocotb_tests.harness.background import Background
from cocotb_tests.harness.config import Config
from cocotb_tests.harness.scripts import building

from .builds import D8E, F8B, ODD
from .random_faults import Faults
from .random_meeting import Meetings
from .random_pins import Pins
from .random_program import some_program
from .scenes import device, image, page
from .script_host import Host

BUILDS: tuple[tuple[Config, int], ...] = ((F8B, 80), (ODD, 12), (D8E, 8))


def plan(seed: int) -> Config:
    """Build of a seed (any int)."""
    builds, weights = zip(*BUILDS, strict=True)
    return random.Random(f"p006 build {seed}").choices(builds, weights)[0]


def play(seed: int, config: Config) -> Talker:
    """Play one seed on the model; AssertionError if the part hangs or answers nonsense."""
    with building(config):
        return Talker(seed).play()


class Talker(Meetings, Pins, Faults):
    """One random host."""

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
        self.host = Host(eeprom=memory, levels=levels, boot=False, error=rng.choice((0, 0, 0, 0.02, -0.02)))
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
            (self.meeting, 11),
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
