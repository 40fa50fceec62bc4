"""`directed`: the one decorator of a directed test: closed loop, and compared with the golden model.

    @directed("P104-STP-01", "AC-20", builds=(F16, F100))
    async def p104_stp_01_immediate(dut):
        "Given a constant-speed move, when 0x40 is taken, then no further pulse comes."
        lab = await Lab.start(dut, INIT_A)

It is `cocotb.test()`, so `cocotb.parametrize`, `skip` and `xfail` go with it. Whatever the test drives, the
golden model gets the same pin changes: at the end of the test, and before each further `start_bench` in it,
every edge of every output is compared.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

import cocotb

from .compare import check_against_model
from .config import F16, Config, configs
from .running import Running, running_test
from .verifies import verifies


def directed(*rules: str, builds: Sequence[Config] = (F16,), uncompared: str = "") -> Callable[[Any], Any]:
    """A cocotb test that verifies `rules` (none: sessions of a manual) in the build configurations `builds`.

    `uncompared`: why the outputs are not compared with the golden model; the run lists such tests. Raises
    ValueError for an ID that is none.
    """

    def mark(test: Any) -> Any:
        function = getattr(test, "func", test)

        @functools.wraps(function)
        async def run(dut: Any, **arguments: Any) -> None:
            with running_test(None if uncompared else check_against_model) as running:
                await judged(running, function(dut, **arguments))

        # The simulator side must see the arguments of `run`.
        del run.__wrapped__  # type: ignore[attr-defined]
        run._openppmc_directed = True  # type: ignore[attr-defined]
        run._openppmc_uncompared = uncompared  # type: ignore[attr-defined]
        configs(*builds)(verifies(*rules)(run) if rules else run)
        if function is test:
            return cocotb.test()(run)
        test.func = run
        return cocotb.test()(test)

    return mark


async def judged(running: Running, test: Any) -> None:
    """Run the test, then compare; a failed check says whether the golden model shows the same edges."""
    try:
        await test
    except (AssertionError, TimeoutError) as error:
        if not running.differs:
            error.args = (f"{error}\n{await running.opinion()}",)
        raise
    await running.judge()
