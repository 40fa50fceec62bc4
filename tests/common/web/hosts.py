"""Random hosts on the golden model: the pin changes that each host makes, and the expected edges."""

from __future__ import annotations

import importlib
import random
from collections.abc import Iterator
from itertools import count, islice

from cocotb_tests.bank.random_host import in_motion
from cocotb_tests.harness.model_bench import OnModel, on_model
from cocotb_tests.harness.random_items import RandomItems
from cocotb_tests.harness.run_context import last_test
from openppmc.check.records import Recording
from openppmc.model.ppmc312.front.serial import LENGTHS
from scripts.site.webparts import WebPart
from tests.common.web.players import player

IN_MOTION = 3
"""Number of bank hosts that keep all axes in motion; each one makes 50 000 intervals."""


def _items(part: WebPart) -> RandomItems:
    items: RandomItems = importlib.import_module(f"cocotb_tests.{part.name}.test_random").random_item
    return items


def seeds(part: WebPart) -> Iterator[int]:
    """Yield the seeds of `make test` that use the build of the playground, then those of `make soak`."""
    if part.stations:
        return count(1)
    items = _items(part)
    fitting = (seed for seed in count(1) if items.takes(seed) and items.build(seed) == part.config)
    if part.name != "bank":
        return fitting
    quick = (seed for seed in count(1) if items.build(seed) == part.config and in_motion(seed))
    still = (seed for seed in fitting if not in_motion(seed))
    return (seed for some in (islice(quick, IN_MOTION), still) for seed in some)


def recorded(part: WebPart, seed: int) -> Recording:
    """Run the host of a seed on the golden model; return the recording."""
    if part.stations:
        return player(part).play(line_text(random.Random(seed)))
    item = _items(part)(seed)
    test = getattr(importlib.import_module(item.module), item.test)
    on_model(test.func(OnModel(item.config, seed)))
    last = last_test()
    assert last is not None and last.bench is not None
    return last.bench.recording()


TABLE = "> 00 00 0140 00A0 000360"
MOVES = ("83 0000 000006E0", "A4 0140 00000064", "A5 0100", "86 0000", "82", "80", "81", "8A 0140")
PINS = ("fl_n", "bl_n", "org_n", "alm_n", "run", "evt0_n", "auxi3", "epin")


def line_text(rng: random.Random) -> str:
    """Return a random session for the stations of a line: motions, faults, pins, pauses, connections."""
    lines = []
    for station in rng.sample(range(16), 2):
        lines += [f"axis {station}", TABLE, "<", f"> {rng.choice(MOVES)}", "<"]
        for _ in range(5):
            code = rng.choice([code for code, size in LENGTHS.items() if size < 5])
            other = rng.randrange(16)
            lines += rng.choice((
                ["?"],
                [f"> {code:02X} {rng.randbytes(LENGTHS[code]).hex()}", "<"],
                [f"> {rng.choice(MOVES)}", "<"],
                [f"m {rng.randbytes(rng.randint(1, 4)).hex()}", "<"],
                [f"set {rng.choice(PINS)}[{station}]={rng.randrange(2)}", f"wait {rng.randrange(30_000)}"],
                [f"wait {rng.choice((200, 2_000, 20_000, 100_000))}", "?"],
                [f"unplug {other}", f"axis {other}", "?", f"plug {other}", f"axis {station}"],
            ))  # fmt: skip
    return "\n".join([*lines, "reset", "?"])
