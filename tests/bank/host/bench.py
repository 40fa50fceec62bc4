"""Common functions of the tests of the bank driver: a bank on the modelled board, in virtual time."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from openppmc.host import Link, PpmcBank
from openppmc.host.model_port import ModelPort
from openppmc.host.script import Script
from openppmc.model.bank.carrier import Carrier

SETUP = {"start_pps": 2000, "high_pps": 20_000, "ramp_pulses": 100}
SPEC = "model:speed=max,part=bank,axes=4"


@contextmanager
def opened(words: str = "", axes: int = 4) -> Iterator[PpmcBank]:
    """Open a bank with all axes initialised."""
    with PpmcBank.open(f"{SPEC.replace('=4', f'={axes}')},{words}") as bank:
        for axis in bank.axes:
            axis.initialise(**SETUP)  # type: ignore[arg-type]
        yield bank


def model(bank: PpmcBank) -> Carrier:
    """Return the modelled board."""
    assert isinstance(bank.link.port, ModelPort)
    assert isinstance(bank.link.port.board, Carrier)
    return bank.link.port.board


def frames(bank: PpmcBank) -> int:
    """Return the number of requests that the bridge has executed."""
    assert isinstance(bank.link.port, ModelPort)
    return bank.link.port.bridge.scripts


def pulses(bank: PpmcBank) -> dict[int, list[int]]:
    """Return lists, one per axis, to which the modelled board appends the cycle of each pulse."""
    board = model(bank)
    seen: dict[int, list[int]] = {number: [] for number in bank.axis}
    real = board._step

    def follow(edge: object) -> None:
        board_t[0] = edge.t  # type: ignore[attr-defined]
        real_follow(edge)  # type: ignore[arg-type]

    def step(n: int, way: int) -> None:
        seen[n + 1].append(board_t[0])
        real(n, way)

    board_t, real_follow = [0], board._follow
    board._follow = follow  # type: ignore[method-assign,assignment]
    board._step = step  # type: ignore[method-assign]
    return seen


def at(link: Link, number: int, script: Script) -> Script:
    """Access an axis as another program does, so that the driver does not know that another axis is selected.

    Return the script that was executed.
    """
    whole = Script().write(3, number - 1).extend(script)
    link.execute(whole)
    return whole
