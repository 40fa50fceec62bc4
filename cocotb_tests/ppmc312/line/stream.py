"""Random characters, frames, noise and silence on a line, for tests and for `make soak PART=ppmc312-serial`.

After each section of a stream, at most one poll recovers every station.
"""

from __future__ import annotations

import random

from openppmc.model.ppmc312.front.serial import INSTRUCTION

from .master import T_INIT, Master, NoFrameError
from .models import ModelLine
from .scenarios import SETTING, polled
from .setting import STATIONS
from .wave import length, merged, wave

INSTRUCTIONS = (
    *(SETTING, SETTING, "00 08 0140 00A0 000360", "00 00 0140 0141 000360"),
    *(
        "83 0000 0000001e",
        "a3 0000 00000019",
        "84 0140 00000007",
        "85 0140",
        "a6 0000",
        "82",
        "a2",
        "88 0000",
    ),
    *("80", "81", "80", "90 00000010", "91 0000000a", "a0", "b1", "89 00c8", "9a 0140 00000005"),
    *("20", "21", "22", "23", "25", "26 2a", "27", "28 ff", "44", "45", "06 01", "06 00", "05 00c8"),
    *("40", "41", "42", "62", "43 00000064", "63 ffffff9c", "4d", "4e", "4f", "04 00000010", "02 01 0005"),
    *(
        "49 03 02 26 15 00 00 00 00 00 00",
        "59 03 02 80 00 00 00 00 00 00 00",
        "69",
        "79",
        "ff",
        "47",
        "7f 00",
    ),
)
"""Instructions for the stream; their pulse rates are so low that sixteen models can be simulated."""
PART = 60
"""Number of characters between two checks of the stations."""


async def disorder(master: Master, rng: random.Random, size: int, count: int = STATIONS) -> int:
    """Send at least `size` characters to `count` stations, in sections of PART characters.

    Returns:
        The number of stations that needed a second poll.

    Raises:
        AssertionError: A station does not answer its second poll.
    """
    late = sent = 0
    exact = master.bit
    while sent < size:
        master.bit = exact * rng.uniform(0.98, 1.02)
        before = sent
        while sent < min(before + PART, size):
            sent += await _some(master, rng, count)
        late += await recovered(master, count)
    master.bit = exact
    return late


async def recovered(master: Master, count: int) -> int:
    """Check that each station answers its first or second poll; return how many needed the second."""
    late = 0
    await master.quiet()
    for station in range(count):
        try:
            reply = await master.poll(station)
        except NoFrameError:
            reply = None
        if reply is None or reply.station != station:
            late += 1
            await master.quiet(T_INIT / master.bit)
            reply = await master.poll(station)
            assert reply is not None and reply.station == station, f"station {station} is lost: {reply}"
    return late


async def _some(master: Master, rng: random.Random, count: int) -> int:
    """Send one random item; return its number of characters."""
    station, kind = rng.randrange(count), rng.random()
    text = bytes.fromhex(rng.choice(INSTRUCTIONS))
    frame = master.frame(INSTRUCTION | station, text)
    if kind < 0.2:
        frame = rng.randbytes(rng.randint(1, 12))
    elif kind < 0.3:
        frame = frame[: rng.randrange(1, len(frame))]
    elif kind < 0.4:
        spot = rng.randrange(len(frame))
        frame = frame[:spot] + bytes([frame[spot] ^ 1 << rng.randrange(8)]) + frame[spot + 1 :]
    elif kind < 0.5:
        frame = polled(station)
    elif kind < 0.6:
        return await _collision(master, rng, frame, polled(rng.randrange(count)))
    elif kind < 0.7:
        return await _noisy(master, rng, frame)
    elif kind < 0.74:
        begin = master.port.now
        await master.drive([(begin, 0), (begin + round(rng.uniform(1, 60) * master.bit), 1)])
        await master.rest(rng.choice((0.5, 1, 3)))
        return 1
    await master.send(frame, rng.choice((0, 0, 0, 0.3, 2)))
    pause = rng.random()
    if pause < 0.5:
        await master.hear(round(T_INIT if text[0] == 0 else 60 * master.bit))
    elif pause < 0.97:
        await master.rest(rng.choice((0.5, 0.6, 1, 5, rng.uniform(0.5, 50))))
    else:
        await master.rest(rng.choice((1660, 1700)))  # 20 ms
    return len(frame)


async def _collision(master: Master, rng: random.Random, one: bytes, other: bytes) -> int:
    """Send the overlapping frames of two masters."""
    begin, bit = master.port.now, master.bit
    later = begin + rng.randrange(round(length(one, bit)))
    await master.drive(merged(wave(one, begin, bit), wave(other, later, bit * rng.uniform(0.98, 1.02))))
    await master.rest(rng.uniform(0.5, 3))
    return len(one) + len(other)


async def _noisy(master: Master, rng: random.Random, frame: bytes) -> int:
    """Send a frame; some stations receive some of its bits inverted."""
    begin, port = master.port.now, master.port
    steps = [(t, {"master": level}) for t, level in wave(frame, begin, master.bit)]
    for _ in range(rng.choice((1, 1, 3))):
        spot = begin + rng.randrange(round(length(frame, master.bit)))
        steps += [(spot, {"noise": rng.getrandbits(STATIONS)})]
        steps += [(spot + rng.choice((1, 2, 10, 96, 400)), {"noise": 0})]
    for t, pins in sorted(steps, key=lambda step: step[0]):
        await port.until(max(t, port.now))
        port.set(**pins)
    port.set(noise=0)
    await master.rest(rng.uniform(0.5, 3))
    return len(frame)


def pins_of(seed: int) -> dict[str, int]:
    """Return random levels of the two pins that select whether a station receives the other drivers and its
    own driver in addition to the master.
    """
    rng = random.Random(f"pins {seed}")
    return {"hear_others": int(rng.random() < 0.8), "hear_self": int(rng.random() < 0.2)}


async def play(master: Master, seed: int, size: int, count: int = STATIONS) -> int:
    """Play the stream of a seed; return the number of stations that needed a second poll."""
    await master.port.until(8)
    return await disorder(master, random.Random(f"line {seed}"), size, count)


def model_line(seed: int, count: int) -> ModelLine:
    """Return a line of models with the pins for a seed."""
    return ModelLine(count=count, **pins_of(seed))
