"""Scripts: a short tour of the part, which netlists and the default build can be shown as well."""

from __future__ import annotations

from math import ceil

from cocotb_tests.harness.verifies import verifies

from .frames import command
from .scenes import DECAY, END, EXT1, Op, after_steps, brisk, load, out, rest, rot, start
from .script_host import Host


@verifies("P006-UART-01", "P006-FRM-02", "P006-FRM-03", "P006-MOT-03", "P006-MOT-05", "P006-EXC-12")
def test_tour() -> None:
    """A register, a frame with an error, a move, a stop by EXT1, a program; every kind of block."""
    host = Host()
    assert host.ask("R") == 0x123 and host.ask("n") == 800
    host.raw("A5 FF 6A 00 00 00 00 0F")
    assert host.silent(ceil(4 * host.bit))
    brisk(host, 3000, m=4, f=1)
    start(host, 7)
    rest(host)
    assert len(host.steps()) == 7 and set(host.intervals()) <= {333, 334}
    host.ok(d=0, e=2000)
    start(host, 0x7FFFFFFF)
    after_steps(host, 4)
    host.pins(ext1=0)
    host.pause(10)
    assert not host.busy and host.status() == DECAY | EXT1 and host.ask("b") == 0
    load(host, Op(0x08, 0, 3000), rot(2), Op(0x10, 8, 0), out(2, 1), END)
    host.until("gpo", 2, 10_000)
    assert host.position() == 7 - len(host.steps(0)[7:])


@verifies("P006-FRM-10", "P006-CMD-44")
def test_tour_of_another_address() -> None:
    host = Host(error=0.01)
    assert host.ask("w", 17) == 17
    host.send(command(16, "y", 0xF8))
    assert host.ask("x") == 0xF07
