"""`judged_test`: a cocotb test of a part that is replayed into the golden model at its end.

A part's lab makes its own `part_test` of it. The test gets whatever `start` makes of the dut; that must have
a `bench`. On the golden model alone there is nothing to compare.
"""

from __future__ import annotations

import functools
from collections.abc import Awaitable, Callable, Sequence
from typing import Any

import cocotb

from .compare import check_against_model
from .config import Config, configs
from .verifies import verifies

Start = Callable[[Any], Awaitable[Any]]
Test = Callable[[Any], Awaitable[None]]


async def _judged(lab: Any, test: Test) -> None:
    """Run the test, then compare; a failed check says whether the golden model shows the same edges."""
    try:
        await test(lab)
    except (AssertionError, TimeoutError) as error:
        await lab.bench.align()
        try:
            check_against_model(lab.bench)
            verdict = "up to here the golden model shows the same edges"
        except Exception as other:  # whatever the model does, the failed check is what counts
            verdict = f"the golden model differs: {other}"
        raise AssertionError(f"{error}\n{verdict}") from None
    await lab.bench.align()
    check_against_model(lab.bench)


def judged_test(
    start: Start, rules: Sequence[str], on: Sequence[Config], compared: bool = True
) -> Callable[[Test], Any]:
    """A cocotb test that verifies `rules` in the build configurations `on`; see `_judged` if `compared`."""

    def mark(test: Test) -> Any:
        @functools.wraps(test)
        async def run(dut: Any) -> None:
            lab = await start(dut)
            await (_judged(lab, test) if compared and lab.bench.simulated else test(lab))

        # The simulator side must see the argument of `run`, not that of the test.
        del run.__wrapped__  # type: ignore[attr-defined]
        return cocotb.test()(verifies(*rules)(configs(*on)(run)))

    return mark
