"""Selection of the faults of a session by its seed. Consecutive seeds damage every byte of a session."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from random import Random

from scripts.measure.fire.boards import TARGETS
from scripts.measure.fire.line import Fault, Kind
from scripts.measure.fire.session import AS_REQUESTED, Player, WrongError

KINDS = tuple(Kind)
REPAIRED = (Kind.LOSE, Kind.DOUBLE, Kind.FLIP, Kind.DELAY, Kind.SHARE)
"""Faults after which a bridge with a CRC continues, so no call of its driver may fail.

Exception: after a delay of more than LONGEST_DELAY, which may outlast all attempts to send a request, a call
may fail.
"""
LONGEST_DELAY = 1.0


@dataclass(frozen=True)
class Played:
    """Session that has ended.

    Attributes:
        faults: faults of the line.
        outcome: see `Player`.
        error: description of the failure, or an empty text.
        longest: longest time of a call in s.
    """

    faults: tuple[Fault, ...]
    outcome: str
    error: str
    longest: float


def _dialogue(name: str, number: int) -> Random:
    """Return the random generator for the distances and pauses of dialogue `number` of a board."""
    return Random(f"{name} {number}")


@cache
def sizes(name: str, number: int) -> tuple[int, int]:
    """Return the number of bytes to the host, and to the board, in a dialogue without faults."""
    player = Player(name, _dialogue(name, number))
    line = player.line
    player.play()
    return line.passed[0], line.passed[1]


def faults_of(name: str, seed: int) -> tuple[int, tuple[Fault, ...]]:
    """Return the number of the dialogue that a seed selects, and its faults.

    A dialogue is a session with given distances and pauses. Each of the first n seeds damages a different one
    of the n bytes of dialogue 0. The next n seeds damage the same bytes, each with another kind of fault.
    After all kinds, the next dialogue begins. For a board with a CRC, each dialogue with an odd number has a
    second fault at a random place. A bit that the checksum of the board may miss is not inverted.
    """
    seeds, number = seed, 0
    while seeds >= (size := sum(sizes(name, number)) * len(KINDS)):
        seeds, number = seeds - size, number + 1
    to_host, to_board = sizes(name, number)
    turn, place = divmod(seeds, to_host + to_board)
    rng = Random(f"{name} {seed}")
    kind = KINDS[(turn + place) % len(KINDS)]
    detail = rng.randrange(1 << 16)
    if place >= to_host and detail % 8 == TARGETS[name].unchecked:
        detail += 1
    first = (
        Fault(kind, True, place - to_host, detail) if place >= to_host else Fault(kind, False, place, detail)
    )
    if number % 2 == 0 or not TARGETS[name].crc:
        return number, (first,)
    direction = rng.random() < 0.5
    second = Fault(
        rng.choice(REPAIRED), direction, rng.randrange((to_host, to_board)[direction]), rng.randrange(1 << 16)
    )
    return number, (first, second)


def play(name: str, seed: int) -> Played:
    """Run the session of a seed."""
    number, faults = faults_of(name, seed)
    player = Player(name, _dialogue(name, number), faults)
    error = ""
    try:
        player.play()
        repaired = TARGETS[name].crc and len(faults) == 1 and faults[0].kind in REPAIRED
        if faults[0].kind is Kind.DELAY and faults[0].delay > LONGEST_DELAY:
            repaired = False
        if repaired and player.outcome != AS_REQUESTED:
            error = f"a call fails with {player.outcome} although the fault can be repaired"
    except WrongError as wrong:
        error = f"after {player.outcome}: {wrong}"
    if error:
        error = f"{'; '.join(map(str, faults))}: {error}"
    return Played(faults, player.outcome, error, player.longest)
