"""Seeds of `make soak PART=ppmc312-serial`: random streams on a line of PPMC-312 stations.

Each seed: SIZE characters, bit by bit with noise, collisions and breaks, on 4 to 16 golden models on a line;
then SINGLE characters, as whole ones, for one station after the other. After every few dozen of them one poll
at most must bring every station back. Every RTL_EACHth seed goes to sixteen stations of RTL as well, and all
their outputs are compared.
"""

from __future__ import annotations

import random

from cocotb_tests.harness.runner import attempt
from cocotb_tests.ppmc312.serial_streams import campaign

from .master import Master, at_once
from .setting import design
from .stream import model_line, play
from .test_line import stream_item

NAME = "ppmc312-serial"
SIZE, SINGLE = 120, 400
RTL_EACH = 50
REPEAT = f"make soak PART={NAME} SEED={{}} COUNT=1"


class Streams:
    """Random streams on the line, for `make soak`."""

    def one(self, seed: int) -> tuple[int, str, str]:
        """Run one seed in this process; returns (seed, test id, message or "")."""
        item = stream_item(seed)
        count = random.Random(seed).choice((4, 4, 8, 16))
        try:
            at_once(play(Master(model_line(seed, count)), seed, SIZE, count))
            campaign(seed, SINGLE)
        except AssertionError as error:
            return seed, item.id, f"on golden models: {error}\nrepeat with: {REPEAT.format(seed)}"
        if seed % RTL_EACH:
            return seed, item.id, ""
        return seed, item.id, attempt(item, design=design(item.config))

    def summary(self, first: int, count: int) -> str:
        """What has been done when all seeds have passed."""
        samples = sum(not seed % RTL_EACH for seed in range(first, first + count))
        text = "at most one poll brought every station back: "
        text += f"{count * (SIZE + SINGLE):,} bytes on golden models"
        if samples:
            text += f", {samples * SIZE:,} on the RTL, every output edge as in the golden models"
        return text


SOAK = Streams()
