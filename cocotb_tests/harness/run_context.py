"""Decorators of simulated tests, which compare every edge of every output with the golden model.

    @directed("P104-STP-01", "AC-20", builds=(F16, F100))
    async def p104_stp_01_immediate(dut):
        "After 0x40 in a constant-speed move, no further pulse is output."
        env = await Env.start(dut, INIT_A)

    @random_test("P312-GEN-01", least=200)
    async def p312_random_host(dut, seed):
        "All outputs change as in the golden model for every random host."
        await ReactiveHost(await Host.start(dut), seed).play()

Both decorators make a `cocotb.test()`, so `cocotb.parametrize`, `skip` and `xfail` work with them. The golden
model receives the pin changes that the test makes. At the end, and before each further `start_bench`, every
edge of every output is compared. A random test plays the seeds of its batch (`random_items`), each after a
reset.
"""

from __future__ import annotations

import functools
from collections.abc import Awaitable, Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from hashlib import sha256
from typing import Any, cast

import cocotb

from .collect import verifies
from .compare import add_counts, check_against_model
from .config import F16, Config, configs, each_seed
from .dut_bench import DutBench
from .model_bench import ModelBench, OnModel
from .part import Part
from .rtl_bench import RtlBench

TAIL = 24
"""Cycles for which the bench continues before the comparison, so that all effects of the last action
occur.
"""
Comparer = Callable[[Any], Any]
"""Function that compares the recording of a bench with the golden model; raises AssertionError at a
difference.
"""


class RunContext:
    """One running test: its present bench, if any, and the function that compares it (None: no comparison).

    Args:
        seed: seed of the benches of the test, if it is not that of the run.

    Attributes:
        differs: True from the start of a comparison on; False again if it succeeds.
    """

    def __init__(self, compare: Comparer | None, seed: int | None = None) -> None:
        self._compare = compare
        self.seed = seed
        self.bench: DutBench | None = None
        self.differs = False

    async def compare(self) -> None:
        """Compare the recording of the present bench; raise AssertionError at a difference."""
        if self._compare and self.bench and self.bench.simulated:
            await self.bench.align()
            await self.bench.clocks(TAIL)
            self.differs = True
            self._compare(self.bench)
            self.differs = False

    async def model_result(self) -> str:
        """Return the result of the comparison for a run in which a check of the test has failed."""
        if not (self._compare and self.bench and self.bench.simulated):
            return "the outputs of this test are not compared with the golden model"
        try:
            await self.compare()
        except Exception as other:  # any error of the model is secondary to the failed check
            return f"the golden model differs: {other}"
        return "up to here the golden model shows the same edges"

    async def close_bench(self) -> None:
        """Compare the present bench, if any, and stop its pin changes before another bench starts."""
        if self.bench:
            await self.compare()
            self.bench.close()
            self.bench = None


_running: list[RunContext] = []
_last: list[RunContext] = []


def current_test() -> RunContext | None:
    """Return the directed or random test that is running; None outside of one."""
    return _running[-1] if _running else None


@contextmanager
def running_test(compare: Comparer | None, seed: int | None = None) -> Iterator[RunContext]:
    """Provide the context of a running test; `compare` compares its benches (see `RunContext`)."""
    _running.append(RunContext(compare, seed))
    try:
        yield _running[-1]
    finally:
        _last[:] = [_running.pop()]


def last_test() -> RunContext | None:
    """Return the directed or random test that ended last, with its bench; None if no test has ended."""
    return _last[-1] if _last else None


async def start_bench(dut: Any, part: Part, settle: int = 4, **pins: int) -> DutBench:
    """Return a bench at edge `settle`: an `RtlBench` on `dut`, or a `ModelBench` if `dut` is an `OnModel`.

    A directed test may call it again: the recording of the previous bench is compared with the golden model,
    its scheduled pin changes stop, and the device starts again from a reset.
    """
    test = current_test()
    if test:
        await test.close_bench()
    seed = test.seed if test else None
    if isinstance(dut, OnModel):
        bench: DutBench = ModelBench(part, dut if seed is None else replace(dut, seed=seed), settle, **pins)
    else:
        bench = await RtlBench.start(dut, part, settle=settle, seed=seed, **pins)
    if test:
        test.bench = bench
    return bench


def directed(
    *rules: str, builds: Sequence[Config] = (F16,), uncompared: str = "", exact: str = ""
) -> Callable[[Any], Any]:
    """Make a cocotb test that verifies `rules` in these builds; no rule if it plays sessions of a manual.

    Raises ValueError for an invalid rule ID.

    Args:
        uncompared: reason why the outputs are not compared with the golden model; the run lists such tests.
        exact: reason why the test does not run with JITTER=1: its checks need the edge of a pin change.
    """

    def mark(test: Any) -> Any:
        function = getattr(test, "func", test)

        @functools.wraps(function)
        async def run(dut: Any, **arguments: Any) -> None:
            with running_test(None if uncompared else check_against_model) as context:
                await run_and_compare(context, function(dut, **arguments))

        # cocotb must see the arguments of `run`.
        del run.__wrapped__  # type: ignore[attr-defined]
        run._openppmc_directed = True  # type: ignore[attr-defined]
        run._openppmc_uncompared = uncompared  # type: ignore[attr-defined]
        run._openppmc_exact = exact  # type: ignore[attr-defined]
        configs(*builds)(verifies(*rules)(run) if rules else run)
        if function is test:
            return cocotb.test()(run)
        test.func = run
        return cocotb.test()(test)

    return mark


async def run_and_compare(context: RunContext, test: Any) -> None:
    """Run the test, then compare. If the test fails, add the result of the comparison to its message."""
    try:
        await test
    except (AssertionError, TimeoutError) as error:
        if not context.differs:
            error.args = (f"{error}\n{await context.model_result()}",)
        raise
    await context.compare()


RandomTest = Callable[[Any, int], Awaitable[None]]


def random_test(*rules: str, least: int = 0, uncompared: str = "") -> Callable[[RandomTest], Any]:
    """Make a cocotb test that verifies `rules`, from a coroutine that plays one seed on one bench.

    Args:
        least: minimum number of output edges of a seed; a seed with fewer edges fails.
        uncompared: reason why the output edges are not compared.
    """

    def mark(test: RandomTest) -> Any:
        name = getattr(test, "__name__", "")

        async def one(dut: Any, seed: int) -> str:
            compared = 0

            def compare(bench: DutBench) -> None:
                nonlocal compared
                comparison = check_against_model(bench)
                compared += comparison.edges_compared
                add_counts(edges=comparison.edges_compared, pulses=comparison.pulses)
                if log := bench.stage_log:
                    add_counts(late=log.late, prompt=log.prompt)
                    assert log.late and log.prompt, (
                        f"seed {seed}: {log.late} late, {log.prompt} prompt changes"
                    )

            with running_test(None if uncompared else compare, seed) as context:
                await run_and_compare(context, test(dut, seed))
                digest = pins_digest(context.bench) if context.bench else ""
                if context.bench and context.bench.simulated:
                    assert compared >= least, (
                        f"seed {seed}: {compared} output edges, expected {least} or more"
                    )
                    cocotb.log.info("seed %d: %d edges compared, pins %s", seed, compared, digest)
                    add_counts(seeds=1)
                return digest

        @functools.wraps(test)
        async def run(dut: Any) -> str:
            if isinstance(dut, OnModel):
                return await one(dut, dut.seed)
            await each_seed(name, functools.partial(one, dut))
            return ""

        # cocotb must see the argument of `run`, not those of the test.
        del run.__wrapped__  # type: ignore[attr-defined]
        run._openppmc_uncompared = uncompared  # type: ignore[attr-defined]
        return cocotb.test()(verifies(*rules)(run))

    return mark


def pins_digest(bench: DutBench) -> str:
    """Return a digest of all pin changes of a bench.

    It is equal for the same host on RTL and golden model.
    """
    return sha256(repr(sorted(map(tuple, bench.stimulus))).encode()).hexdigest()[:12]


def note(bench: DutBench, text: str) -> None:
    """Write the plan of the host to the folder of the run."""
    if bench.simulated:
        (cast(RtlBench, bench).out / "plan.txt").write_text(text + "\n", encoding="utf-8")
