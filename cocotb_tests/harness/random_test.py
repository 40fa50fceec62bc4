"""`random_test`: the decorator of random tests: closed loop, many seeds a run, compared as directed tests.

    @random_test("P312-GEN-01", least=200)
    async def p312_random_host(dut, seed):
        "Given a random host, when it has played, then all outputs changed as in the golden model."
        await Lively(await Host.start(dut), seed).play()

The seeds are those of the batch (`batches`) or the one of the run. Each begins with a reset; at its end every
edge of every output is compared. A difference leaves the recording that `shortened` makes a short list of.
"""

from __future__ import annotations

import functools
from collections.abc import Awaitable, Callable
from hashlib import sha256
from typing import Any, cast

import cocotb

from . import tally
from .bench import Bench
from .compare import check_against_model
from .directed import judged
from .model_bench import OnModel
from .running import running_test
from .seeds import each_seed
from .side import Side
from .verifies import verifies

RandomTest = Callable[[Any, int], Awaitable[None]]


def random_test(*rules: str, least: int = 0, uncompared: str = "") -> Callable[[RandomTest], Any]:
    """A cocotb test that verifies `rules`, of a coroutine that plays one seed on one side.

    least: output edges that a seed must have made, all compared. uncompared: why they are not.
    """

    def mark(test: RandomTest) -> Any:
        name = getattr(test, "__name__", "")

        async def one(dut: Any, seed: int) -> str:
            compared = 0

            def judge(side: Side) -> None:
                nonlocal compared
                comparison = check_against_model(side)
                compared += comparison.edges_compared
                tally.tell(edges=comparison.edges_compared, pulses=comparison.pulses)

            with running_test(None if uncompared else judge, seed) as running:
                await judged(running, test(dut, seed))
                digest = pins_digest(running.side) if running.side else ""
                if running.side and running.side.simulated:
                    assert compared >= least, f"seed {seed} did next to nothing ({compared} edges)"
                    cocotb.log.info("seed %d: %d edges compared, pins %s", seed, compared, digest)
                    tally.tell(seeds=1)
                return digest

        @functools.wraps(test)
        async def run(dut: Any) -> str:
            if isinstance(dut, OnModel):
                return await one(dut, dut.seed)
            await each_seed(name, functools.partial(one, dut))
            return ""

        # The simulator side must see the argument of `run`, not those of the test.
        del run.__wrapped__  # type: ignore[attr-defined]
        run._openppmc_uncompared = uncompared  # type: ignore[attr-defined]
        return cocotb.test()(verifies(*rules)(run))

    return mark


def pins_digest(side: Side) -> str:
    """Stands for all pin changes that a side has seen: the same host did the same on RTL and golden model."""
    return sha256(repr(sorted(map(tuple, side.stimulus))).encode()).hexdigest()[:12]


def note(side: Side, text: str) -> None:
    """Leave in the folder of the run what its host is going to do."""
    if side.simulated:
        (cast(Bench, side).out / "plan.txt").write_text(text + "\n", encoding="utf-8")
