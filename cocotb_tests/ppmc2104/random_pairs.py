"""Two runs of axis 2, one of them with traffic to axis 1 between the accesses to axis 2.

A plan for axis 2 is a pure function of a seed. The plan consists of slots, each of which begins with an
operation of axis 2. Times are cycles after the beginning of a slot.
"""

from __future__ import annotations

import random
from dataclasses import dataclass

from cocotb_tests.harness import F11, F16, F25, Config
from cocotb_tests.ppmc2104.random_codes import Codes
from cocotb_tests.ppmc2104.random_host import SWITCHES

SLOT = 24_000
# The instruction that begins a slot is complete long before this time within the slot. From this time on,
# switches change and stop codes are sent.
FIRST_EVENT = 400

Write = tuple[int, int]
Event = tuple[int, str, int]


@dataclass(frozen=True)
class Slot:
    """One operation of axis 2: its bytes, and its events (cycles, pin, level) or (cycles, "code", code of a
    stop).
    """

    writes: tuple[Write, ...]
    events: tuple[Event, ...]


@dataclass(frozen=True)
class Pair:
    """The plan of a seed: build, bus style, setting of axis 2, and slots.

    `period` is the period of extck[2] in cycles, or 0 for the internal clock.
    """

    config: Config
    busc: int
    setting: tuple[Write, ...]
    slots: tuple[Slot, ...]
    period: int


def _writes(code: int, data: list[int]) -> tuple[Write, ...]:
    return ((1, code), *((0, byte) for byte in data))


def pair(seed: int) -> Pair:
    """Return the plan of a seed."""
    rng = random.Random(f"ppmc2104 pair {seed}")
    external = rng.random() < 0.3
    codes = Codes(rng, False, (False, external))
    setting = codes.setting(2, wrong=0)
    period = rng.choice((20, 33, 64)) if setting[1] and setting[0] & 8 else 0
    slots = []
    for _ in range(rng.randint(4, 8)):
        events: list[Event] = []
        for at in sorted(rng.sample(range(FIRST_EVENT, SLOT - 4000, 200), rng.choice((0, 0, 1, 2)))):
            if rng.random() < 0.5:
                events.append((at, "code", rng.choice((0x60, 0x61, 0x61))))
            else:
                pin = f"{rng.choice(SWITCHES)}[2]"
                events += [(at, pin, 0), (at + rng.choice((5, 90, 180)), pin, 1)]
        events.append((SLOT - 2000, "code", 0x60))
        slots.append(Slot(_writes(*codes.operation(2)), tuple(events)))
    return Pair(rng.choice((F16, F11, F25)), rng.getrandbits(1), _writes(*setting), tuple(slots), period)


def traffic(seed: int, count: int) -> list[list[Write] | tuple[str, int]]:
    """Return `count` actions for axis 1: instructions with all their data bytes, and pin changes."""
    rng = random.Random(f"ppmc2104 traffic {seed}")
    codes = Codes(rng, False, (False, False))
    made: list[list[Write] | tuple[str, int]] = [list(_writes(*codes.setting(1, wrong=0)))]
    plain = ((0x40, []), (0x41, []), (0xC0, []), (0x80, []), (0x83, []), (0x86, []), (0x87, []), (0xC1, []))
    for _ in range(count):
        kind = rng.random()
        if kind < 0.35:
            code, data = codes.operation(1)
            length = {3: 3, 4: 4, 5: 1, 7: 1}.get(code & 7, 0)
            made.append(list(_writes(code, (data + [7, 7, 0, 0])[:length])))
        elif kind < 0.5:
            made.append(list(_writes(*codes.setting(1, wrong=0.2))))
        elif kind < 0.8:
            made.append(list(_writes(*rng.choice((*plain, (0x84, [0x40, 0x50]), (0x85, [0]), (0xF1, []))))))
        else:
            pin = rng.choice((*SWITCHES, "run", "csel", "extck"))
            made.append((f"{pin}[1]", rng.getrandbits(1)))
    return made
