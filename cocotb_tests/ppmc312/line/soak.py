"""Seeds of `make soak PART=ppmc312-serial`: random streams on a line of PPMC-312 stations.

Each seed sends SIZE characters, bit by bit with noise, collisions and breaks, on a line of 4 to 16 golden
models. Then it sends SINGLE complete characters to one station after the other. After every few dozen
characters, at most one poll must recover every station. One of RTL_EACH seeds also runs on sixteen stations
of RTL, whose outputs are all compared.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence

from cocotb_tests.harness.random_items import Played, all_of
from cocotb_tests.harness.runner import attempt
from cocotb_tests.ppmc312.serial_streams import campaign

from .master import Master, at_once
from .setting import design
from .stream import model_line, play
from .test_line import stream_item

NAME = "ppmc312-serial"
SIZE, SINGLE = 120, 400
RTL_EACH = 50
MODEL_BYTES, RTL_BYTES = "bytes on golden models", "bytes on the RTL"
REPEAT = f"make soak PART={NAME} SEED={{}} COUNT=1"


class Streams:
    """Random streams on the line, for `make soak`."""

    def some(self, seeds: Sequence[int]) -> Played:
        """Run seeds in this process."""
        return all_of(map(self._one, seeds))

    def _one(self, seed: int) -> Played:
        item = stream_item(seed)
        count = random.Random(seed).choice((4, 4, 8, 16))
        try:
            at_once(play(Master(model_line(seed, count)), seed, SIZE, count))
            campaign(seed, SINGLE)
        except AssertionError as error:
            return Played([(seed, item.id, f"on golden models: {error}\nrepeat with: {REPEAT.format(seed)}")])
        bytes_of = Counter({"seeds": 1, MODEL_BYTES: SIZE + SINGLE})
        if seed % RTL_EACH:
            return Played(compared=bytes_of)
        if message := attempt(item, design=design(item.config)):
            return Played([(seed, item.id, message)])
        return Played(compared=bytes_of + Counter({RTL_BYTES: SIZE}))


SOAK = Streams()
