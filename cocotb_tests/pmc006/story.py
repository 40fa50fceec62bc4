"""What `make demo PART=pmc006` plays: a script on the golden model with a motor on its bridges, whose tape
the RTL gets.

Three moves of the same way with finer and finer steps; then a program, loaded over the line, homes on a
switch and shuttles without a host. The motor is there for the moves only: its comparators change often.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from cocotb_tests.harness.config import Config
from cocotb_tests.pmc006.script_host import Host
from openppmc.model.pmc006.bench.motor import Motor, Plant
from openppmc.model.pmc006.program import assemble

BUILD = Config("demo8m", clk_hz=8_000_000, extra=(("BAUD", 115_200), ("T_OFF_NS", 40_000)))
MOTOR = Motor(ohm=1.0, henry=4e-3, volt=24.0)
CURRENT = 1500
"""mA."""
WAY = 64
"""Full steps of a move."""
SPEED, START, LEAD = 300, 75, 20
"""Full steps a second, at the most and at both ends; full steps behind the start where the switch is."""
MOVES = ((4, 2), (16, 4), (32, 5))
"""Microsteps, and the coefficient that makes 1700 full steps/s^2 of them."""
FINE = 8
"""Microsteps of the program."""
PROGRAM = f"""\
        MIC   {FINE}
        ACC   5
        VSET  fixed, {500 * FINE}
        EXTEN on
        DIR   backward
        ROT   100000
        WAIT  busy, low        ; the switch has stopped it
        CLR1
        DIR   forward
        ROT   {40 * FINE}
        WAIT  busy, low
        OUT   gpo1, on           ; homed
again:  ROT   {50 * FINE}
        WAIT  busy, low
        OUT   gpo2, on
        DIR   backward
        ROT   {50 * FINE}
        WAIT  busy, low
        OUT   gpo2, off
        DIR   forward
        CNTI
        CMP   counter, 2
        JNE   again
        OUT   gpo1, off
        END
"""


class Story:
    """The script; `chapters` as those of `story.Story`."""

    def __init__(self, **parameters: object) -> None:
        self.host = Host(**parameters)
        self.plant = Plant(self.host.model, self.host.clk_hz, MOTOR)
        self.chapters: list[dict[str, Any]] = []
        self.place = 0.0

    @contextmanager
    def chapter(self, key: str, title: str) -> Iterator[None]:
        """Everything that the block does belongs to this chapter."""
        begin = self.host.t
        yield
        self.chapters.append({"key": key, "title": title, "begin": begin, "end": self.host.t})

    def tell(self) -> None:
        """All of it."""
        host = self.host
        with self.chapter("set", "settings"):
            host.ask("j")
            host.ok(e=CURRENT, f=1)
            host.ms(5)
        for number, (fine, coefficient) in enumerate(MOVES):
            with self.chapter(f"move{fine}", f"{WAY} full steps in {fine} microsteps each"):
                self.move(fine, coefficient, forward=number != 1)
        with self.chapter("load", "load a program"):
            host.ok(A=0)
            for word in assemble(PROGRAM).words[: 2 * PROGRAM.count("\n")]:
                host.ask("W", word)
            host.ok(A=0, L=START * FINE, S=START * FINE)
        self.plant.detach()
        host.pins(cmp_a=0, cmp_b=0)
        with self.chapter("program", "home and shuttle without a host"):
            host.ask("z")
            self.watch()
            host.ms(4)

    def move(self, fine: int, coefficient: int, forward: bool) -> None:
        """A move with this number of microsteps, polled to its end."""
        host = self.host
        host.ok(
            m=fine,
            v=SPEED * fine,
            L=START * fine,
            S=START * fine,
            u=coefficient,
            o=coefficient,
            d=int(forward),
        )
        host.ask("s", WAY * fine)
        while host.ask("j") & 1:
            host.ms(20)
        host.ask("c")

    def watch(self) -> None:
        """Until the program has switched GPO1 on and off; the switch is on behind its place."""
        host, model = self.host, self.host.model
        begin, place, level, homed = model.position, (1 if len(MOVES) % 2 else 0) * WAY, 1, False
        while True:
            host.step()
            now = int((model.position - begin) / FINE + place > -LEAD)
            if now != level:
                host.pins(ext1=now)
                level = now
            homed |= bool(model.outputs["gpo"] & 1)
            if homed and not model.outputs["gpo"] & 1:
                return
