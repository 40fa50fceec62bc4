"""Random queues of moves between two limit switches have the same results as single calls of `move`.

A PPMC-312 with DATASHEET timing filters its switches for 200 µs. A move of a queue may begin during this
time, and then it ends at the switch, although the part would reject it later. Therefore no test here uses
this timing with a PPMC-312.
"""

from __future__ import annotations

from random import Random
from typing import Any

import pytest

from openppmc.host import PpmcError, open_part

PARTS = {
    "part=ppmc104": (5000, 9000, 4),
    "part=ppmc104,timing=DATASHEET": (5000, 9000, 4),
    "part=ppmc2104": (5000, 9000, 4),
    "part=ppmc2104,timing=DATASHEET": (5000, 9000, 4),
    "part=stmc": (5000, 9000, 4),
    "part=stmc,timing=DATASHEET": (5000, 9000, 4),
    "part=bank,axes=4": (5000, 9000, 4),
    "part=ppmc312": (4000, 8000, 600),
}


def executed(text: str, moves: list[int], queued: bool, pps: int | None) -> list[Any]:
    """Execute moves on a new board; return the results, the exception and the position."""
    with open_part(f"model:speed=max,{text},cw=4012,ccw=3988,slow_cw=4009,slow_ccw=3990") as part:
        axis: Any = part.axes[0]
        axis.initialise(*PARTS[text])
        ends: list[Any] = []
        try:
            if queued:
                for end in axis.moves(moves, pps):
                    ends.append(end)
            else:
                for one in moves:
                    ends.append(axis.move_constant(one, pps) if pps and one else axis.move(one))
        except PpmcError as error:
            ends += [type(error), str(error), getattr(error, "result", None)]
        return [*ends, axis.position]


@pytest.mark.parametrize("text", PARTS)
@pytest.mark.parametrize("seed", range(12))
def test_a_queue_ends_as_its_moves(text: str, seed: int) -> None:
    random = Random(f"{seed} {text}")
    moves = [random.choice((0, 1, 2, 3, 4, 5, 9)) * random.choice((1, -1)) for _ in range(40)]
    pps = random.choice((None, 6000))
    assert executed(text, moves, True, pps) == executed(text, moves, False, pps)
