"""What many scripts of the PMC006 begin with: SETUP of chapter 11, motions, programs, EEPROM pages."""

from __future__ import annotations

from collections.abc import Iterable

from cocotb_tests.harness.scripts import parameters
from openppmc.model.carrier.eeprom import Eeprom24C32

from .bench import PMC006
from .programs import END, FACTORY_PAGE, P1, WAIT_REST, Op, goto, image, out, page, rot, words  # noqa: F401
from .script_host import Host

EXT1, EXT2, DECAY, STALL = 0x02, 0x04, 0x08, 0x10
"""Bits of status 1 beside BUSY."""
FREE_RUN, EXT1_EN, EXT2_EN, SPEED_MODE, FORWARD, OFFLINE = 0x01, 0x02, 0x04, 0x08, 0x10, 0x20
"""Bits of status 2."""


def setup(host: Host) -> Host:
    """SETUP: e 1000, u 3, o 3, v 3200."""
    host.ok(e=1000, u=3, o=3, v=3200)
    return host


def ready(**given: object) -> Host:
    """A host behind SETUP."""
    return setup(Host(**given))  # type: ignore[arg-type]


def brisk(host: Host, speed: int = 3000, **settings: int) -> Host:
    """Constant speed from the first step to the last."""
    host.ok(v=speed, L=speed, S=speed, **settings)
    return host


def quick(speed: int = 3000, **given: object) -> Host:
    """A host whose motions are `brisk`."""
    return brisk(Host(**given), speed)  # type: ignore[arg-type]


def start(host: Host, count: int) -> None:
    """An accepted s."""
    assert host.ask("s", count) == host.accepted(count)


def run(host: Host, on: int = 1) -> None:
    """N 1 or N 0 with the reply that says so."""
    assert host.ask("N", on) == on


def rest(host: Host, limit_us: float = 10_000_000) -> int:
    """Run to the end of motion; returns its edge."""
    return host.until("mon_busy", 0, limit_us)


def move(host: Host, count: int) -> list[int]:
    """A whole move; returns its intervals in us. The number of steps is checked."""
    start(host, count)
    rest(host)
    assert len(host.steps()) == count, f"{len(host.steps())} steps instead of {count}"
    return host.intervals()


def after_steps(host: Host, count: int, limit_us: float = 20_000_000) -> int:
    """Run until so many steps have been made since `mark`; returns the edge of that step."""
    end = host.t + host.us(limit_us)
    while host.made() < count:
        assert host.t < end, f"only {host.made()} steps"
        host.step()
    return host.steps()[count - 1]


def cruise(host: Host, interval: float, limit_us: float = 1_000_000) -> None:
    """Run until the last two intervals are this one, rounded up or down."""
    end = host.t + host.us(limit_us)
    seen = host.made()
    last: list[int] = []
    while len(last) < 2 or not all(abs(one - interval) < 1 for one in last):
        assert host.t < end, f"the interval of {interval} us is never reached"
        host.step()
        if host.made() != seen:
            seen = host.made()
            steps = host.last_steps(3)
            last = [host.in_us(b - a) for a, b in zip(steps, steps[1:], strict=False)]


def still(host: Host, clk: int | None = None) -> bool:
    """Whether no step is made for so long (10 ms)."""
    host.sync()
    since = host.t
    host.pause(host.us(10_000) if clk is None else clk)
    return not host.steps(since)


def download(host: Host, program: Iterable[Op], first: int = 0) -> None:
    """Write a program from instruction `first` on and point to it."""
    assert host.ask("A", 2 * first) == 2 * first
    for word in words(program):
        assert host.ask("W", word) == word
    assert host.ask("A", 2 * first) == 2 * first


def load(host: Host, *program: Op) -> None:
    """Write a program and run it."""
    download(host, program)
    assert host.ask("z") == 1


# ---------------------------------------------------------------------- EEPROM


def device(content: bytes = b"", **more: int) -> Eeprom24C32:
    """An EEPROM at the clock of the part that the next host will have."""
    values = {name: int(str(parameters(PMC006, {})[name])) for name in ("clk_hz", "ee_dev")}
    return Eeprom24C32(values["clk_hz"], content, **{"device": values["ee_dev"], **more})  # type: ignore[arg-type]


def with_eeprom(content: bytes = b"", address: int = 0xFF, write_us: int = 5_000, **levels: int) -> Host:
    """A host on a part with an EEPROM."""
    return Host(address=address, eeprom=device(content, write_us=write_us), levels=levels)
