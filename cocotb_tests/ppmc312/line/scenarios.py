"""Scenarios of valid and disturbed traffic on a line of sixteen stations.

A scenario is a function of a master and a random generator. After each disturbance, the first poll recovers
every station.
"""

from __future__ import annotations

import random
from collections.abc import Awaitable, Callable

from openppmc.model.ppmc312.front.serial import INSTRUCTION, POLL

from .master import Master, NoFrameError, Reply, understood
from .setting import ALL, STATIONS
from .wave import length, merged, wave

Scene = Callable[[Master, random.Random], Awaitable[None]]

SETTING = "00 00 0140 00A0 000360"
"""Base clock 8 MHz, rates 320 to 160 (25 to 50 kpps), ramp of 864 pulses."""
STOPPED = b"\x38"
EVERY = range(STATIONS)


def polled(station: int, control: int = POLL) -> bytes:
    """Return the characters of a poll."""
    return bytes([control | station, ~(control | station) & 0x7F])


def check(got: object, want: object, what: str) -> None:
    """Raise an AssertionError that states both values if they differ."""
    assert got == want, f"{what}: expected {want}, got {got}"


async def all_back(master: Master, number: int = STATIONS) -> list[Reply]:
    """Check that each station answers its first poll after a disturbance; return the replies."""
    await master.quiet()
    replies = []
    for station in range(number):
        reply = await master.poll(station)
        assert reply is not None and reply.station == station, f"station {station} is lost: {reply}"
        replies.append(reply)
    return replies


async def counts(master: Master, station: int) -> tuple[int, ...]:
    """Read the numbers of framing errors, overruns and wrong checksums since the last read."""
    return tuple((await master.ask(station, "4f")).data)


async def forget(master: Master, *stations: int) -> None:
    """Clear the error counters."""
    for station in stations:
        await counts(master, station)


# -------------------------------------------------------------------- valid traffic


async def start_all(master: Master, rng: random.Random) -> None:
    """Sixteen axes are set up, started, polled until they have stopped, and read back."""
    pulses = [40 + 20 * number + rng.randrange(20) for number in EVERY]
    for station in EVERY:
        check((await master.ask(station, SETTING)).kind, "ready", "setting")
    for station, count in enumerate(pulses):
        code = 0x83 | 0x20 * (station & 1)
        check((await master.ask(station, f"{code:02x} 0000 {count:08x}")).kind, "ready", "start")
    waiting = set(EVERY)
    for _ in range(12):
        for station in sorted(waiting):
            reply = await master.poll(station)
            assert reply is not None
            if reply.kind == "data":
                check(reply.data, STOPPED, "END code")
                waiting.discard(station)
            else:
                check(reply.kind, "busy", f"answer of station {station} before its stop")
    check(waiting, set(), "stations that still move")
    for station, count in enumerate(pulses):
        where = int.from_bytes((await master.ask(station, "42")).data, "big", signed=True)
        check(where, -count if station & 1 else count, f"position of station {station}")


async def speeds(master: Master, rng: random.Random) -> None:
    """If the clock of the master is 2 % slow or fast, every frame is received."""
    exact = master.bit
    for factor in (0.98, 1.02):
        master.bit = exact * factor
        for station in (0, 5, 10, 15):
            check((await master.ask(station, "41")).data, b"\x12", "version")
        master.bit = exact * (2 - factor)
        await all_back(master, 6)
    master.bit = exact


# -------------------------------------------------------------------- disturbed traffic


async def bad_checksums(master: Master, rng: random.Random) -> None:
    """A frame with a wrong checksum is answered with reply 41 and counted; its instruction is not
    executed.
    """
    for station in (1, 14):
        good = master.frame(INSTRUCTION | station, b"\x26\x15")
        bad = good[:-1] + bytes([good[-1] ^ 1 << rng.randrange(7)])
        check(await master.exchange(bad), Reply("specific", station, b"\x41"), "wrong checksum")
        upper = master.frame(INSTRUCTION | station, b"\x26\x0a").replace(b"a", b"A")
        check(await master.exchange(upper), Reply("specific", station, b"\x41"), "upper case")
        check(await counts(master, station), (0, 0, 2), "counters")
    await all_back(master, 2)


async def foreign(master: Master, rng: random.Random) -> None:
    """Frames with an undefined kind or with bit 6 in the control code, frames without a control code, and
    truncated frames are not answered.
    """
    for station in (0, 9):
        for control in (0xA0, 0xB0, 0xC0, 0xD0, 0xE0, 0xF0):
            check(await master.exchange(polled(station, control)), None, f"control code {control:02X}")
    check(await master.exchange(b"4d" * 3), None, "data only")
    cut = master.frame(INSTRUCTION | 4, b"\x84\x01\x00\x00\x00\x00\x05")
    for size in (1, 2, 3, 9, len(cut) - 1):
        check(await master.exchange(cut[:size]), None, f"{size} characters")
        check((await master.exchange(polled(5))), Reply("ready", 5, b""), "the next station")
    await all_back(master)


async def two_masters(master: Master, rng: random.Random) -> None:
    """If the frames of two masters overlap, at several distances, one poll recovers every station."""
    for _ in range(4):
        a, b = rng.sample(EVERY, 2)
        one = master.frame(INSTRUCTION | a, b"\x26\x2a")
        other = rng.choice((polled(b), master.frame(INSTRUCTION | b, b"\x42")))
        now = master.port.now
        later = now + rng.choice((0, 1, 48, 96, 500, 960, 2000, rng.randrange(4000)))
        await master.drive(merged(wave(one, now, master.bit), wave(other, later, master.bit)))
        await master.port.until(round(max(now + length(one, master.bit), later + length(other, master.bit))))
        await master.quiet()
    await all_back(master)


async def out_of_turn(master: Master, rng: random.Random) -> None:
    """While a station replies, the master sends to the same station, which is an overrun, and to other
    stations.

    Each of the two frames to the station that replies counts as one overrun.
    """
    await forget(master, 7)
    for message in (polled(7), master.frame(INSTRUCTION | 7, b"\x26\x3f"), polled(8)):
        await master.send(polled(7))
        assert await master.port.fall(4096) is not None, "no reply to talk into"
        await master.rest(rng.uniform(0.5, 3))
        await master.send(message)
        await master.quiet()
    heard = await counts(master, 7)
    check(heard[1], 2, "overruns of station 7")
    for station in rng.sample(EVERY, 3):
        for _ in range(3):
            await master.send(polled(station))  # without waiting for the answer
    await all_back(master)


async def noise(master: Master, rng: random.Random) -> None:
    """After noise at some or all stations, within and between characters, one poll recovers every station."""
    port, bit = master.port, master.bit
    for _ in range(6):
        message = master.frame(INSTRUCTION | rng.randrange(STATIONS), b"\x26" + bytes([rng.randrange(64)]))
        begin = port.now
        levels = wave(message, begin, bit)
        end = begin + length(message, bit)
        spots = sorted(rng.uniform(begin, end) for _ in range(rng.choice((1, 1, 2, 5))))
        steps = [(t, {"master": level}) for t, level in levels]
        for spot in spots:
            who = rng.choice((ALL, ALL, 1 << rng.randrange(STATIONS), rng.getrandbits(STATIONS)))
            width = rng.choice((1, 4, 30, 96, 300))
            steps += [(round(spot), {"noise": who}), (round(spot) + width, {"noise": 0})]
        for t, pins in sorted(steps, key=lambda step: step[0]):
            await port.until(max(t, port.now))
            port.set(**pins)
        port.set(noise=0)
        await master.quiet()
    await all_back(master)


async def breaks(master: Master, rng: random.Random) -> None:
    """Each low level that is longer than a character, alone or within a frame, is one framing error."""
    await forget(master, 2)
    whole = master.frame(INSTRUCTION | 2, b"\x26\x01")
    cut, rest = whole[:4], whole[4:]
    for bits in (11, 40.3, 333):
        begin = master.port.now
        start = begin + length(cut, master.bit)
        await master.drive(wave(cut, begin, master.bit))
        await master.port.until(round(start))
        await master.drive([(round(start), 0), (round(start + bits * master.bit), 1)])
        await master.rest(1)
        check(await master.exchange(rest), None, "the rest of a frame with a break in it")
        check(await master.exchange(polled(2)), Reply("ready", 2, b""), f"after a break of {bits} bits")
    check(await counts(master, 2), (3, 0, 0), "counters")
    await all_back(master)


async def babble(master: Master, rng: random.Random) -> None:
    """After any characters, with and without pauses, one poll recovers every station."""
    await master.send(rng.randbytes(30))
    await master.send(rng.randbytes(8), gap=rng.uniform(0, 3))
    await all_back(master)


GOOD: tuple[Scene, ...] = (start_all, speeds)
BAD: tuple[Scene, ...] = (bad_checksums, foreign, two_masters, out_of_turn, noise, breaks, babble)


# -------------------------------------------------------------------- two stations with one address

TWIN = 5
MUTE = 15
TWINS = sum((TWIN if number == 6 else number) << 4 * number for number in EVERY)
"""Pins adr: station 6 has the address of station 5."""
ONE_MUTE = sum((0 if number == MUTE else 7) << 3 * number for number in EVERY)
"""Pins mod: the last station has no valid speed."""


async def twins(master: Master, rng: random.Random) -> None:
    """Two stations with one address answer together: equal answers are valid, different answers are garbled.

    The other stations are not affected.
    """
    check(await master.poll(6), None, "no station has address 6")
    check(await master.poll(MUTE), None, "a station without a speed")
    check(await master.poll(TWIN), Reply("ready", TWIN, b""), "both answer alike")
    check(await master.ask(TWIN, SETTING), Reply("ready", TWIN, b""), "both are set")
    # The alarm input of one of the two stations is asserted, so their answers differ from now on.
    master.port.set(alm_n=ALL & ~(1 << 6))
    await master.rest(4)
    await master.send(polled(TWIN))
    data = await master.hear(5000)
    try:
        garbled = understood(data) not in (Reply("ready", TWIN, b""), Reply("specific", TWIN, b"\x46"))
    except NoFrameError:
        garbled = True
    check(garbled, True, f"two different answers at once ({data.hex(' ')})")
    await master.quiet()
    for station in (4, 7):
        check(await master.poll(station), Reply("ready", station, b""), "a neighbour")
    # The report was sent in the garbled answer and is not repeated.
    check(await master.poll(TWIN), Reply("ready", TWIN, b""), "both alike again")
    for _ in range(3):
        await master.send(rng.randbytes(12))
        await master.quiet()
        for station in (0, 4, TWIN, 7, 14):
            assert await master.poll(station) is not None, f"station {station} is lost"
