"""`directed`: when a test is compared with the golden model, and the message after a failure."""

from __future__ import annotations

from typing import Any

import cocotb
import pytest

from cocotb_tests.harness import D16, F16, DutBench, ModelBench, OnModel, directed, on_model, start_bench
from cocotb_tests.harness.collect import rules_of
from cocotb_tests.harness.run_context import current_test
from cocotb_tests.ppmc104.bench import PPMC104


class Simulated(ModelBench):
    """A golden model that is treated as if it were the RTL."""

    simulated = True


class Comparer:
    """Replacement for the comparison: it stores the benches and fails on request."""

    def __init__(self) -> None:
        self.benches: list[Any] = []
        self.finds = ""

    def __call__(self, bench: Any) -> None:
        self.benches.append(bench)
        if self.finds:
            raise AssertionError(self.finds)


@pytest.fixture
def comparer(monkeypatch: pytest.MonkeyPatch) -> Comparer:
    """Replace the comparison; `start_bench` returns benches that count as RTL, so they must be compared."""
    found = Comparer()
    monkeypatch.setattr("cocotb_tests.harness.run_context.check_against_model", found)
    monkeypatch.setattr("cocotb_tests.harness.run_context.ModelBench", Simulated)
    return found


def run(test: Any, **arguments: Any) -> None:
    """Run the test on the golden model."""
    on_model(test.func(OnModel(), **arguments))


async def start() -> Any:
    return await start_bench(OnModel(), PPMC104)


def test_a_test_is_compared_at_its_end(comparer: Comparer) -> None:
    @directed("P104-STP-01", builds=(F16, D16))
    async def good(dut: Any) -> None:
        assert dut.config == F16
        await start()
        assert not comparer.benches

    run(good)
    assert len(comparer.benches) == 1
    assert current_test() is None
    assert rules_of(good) == ("P104-STP-01",)
    assert good.func._openppmc_configs == (F16, D16)
    assert good.func._openppmc_uncompared == ""


def test_a_second_start_compares_the_first_side_and_stills_it(comparer: Comparer) -> None:
    @directed()
    async def twice(dut: Any) -> None:
        first = await start()
        task = first.at(100, csel=0)
        second = await start()
        assert comparer.benches == [first] and task.over
        assert second is not first and current_test().bench is second  # type: ignore[union-attr]

    run(twice)
    assert len(comparer.benches) == 2


def test_a_difference_fails_the_test(comparer: Comparer) -> None:
    comparer.finds = "pout_n differs"

    @directed()
    async def fine(dut: Any) -> None:
        await start()

    with pytest.raises(AssertionError, match="^pout_n differs$"):
        run(fine)


def test_a_difference_before_a_second_start_is_reported_once(comparer: Comparer) -> None:
    comparer.finds = "pout_n differs"

    @directed()
    async def twice(dut: Any) -> None:
        await start()
        await start()

    with pytest.raises(AssertionError, match="^pout_n differs$"):
        run(twice)
    assert len(comparer.benches) == 1


@pytest.mark.parametrize(
    ("finds", "opinion"),
    [
        ("", "up to here the golden model shows the same edges"),
        ("d_o is 3", "the golden model differs: d_o is 3"),
    ],
)
def test_a_failed_check_states_the_result_of_the_model(comparer: Comparer, finds: str, opinion: str) -> None:
    comparer.finds = finds

    @directed()
    async def wrong(dut: Any) -> None:
        await start()
        raise AssertionError("3 pulses, not 4")

    with pytest.raises(AssertionError) as found:
        run(wrong)
    assert str(found.value) == f"3 pulses, not 4\n{opinion}"
    assert found.traceback[-1].name == "wrong", "the line of the test is in the traceback"


def test_a_timeout_stays_one(comparer: Comparer) -> None:
    @directed()
    async def hangs(dut: Any) -> None:
        await (await start()).edge("pout_n", 0, timeout=50)

    with pytest.raises(TimeoutError, match="(?s)no level 0 of pout_n within 50 cycles.*same edges$"):
        run(hangs)


def test_uncompared_is_not_compared(comparer: Comparer) -> None:
    @directed("P104-BCK-05", uncompared="no rule fixes it")
    async def free(dut: Any) -> None:
        await start()
        raise AssertionError("wrong")

    with pytest.raises(
        AssertionError, match="^wrong\nthe outputs of this test are not compared with the golden model$"
    ):
        run(free)
    assert not comparer.benches
    assert free.func._openppmc_uncompared == "no rule fixes it"


def test_parameters_go_with_it(comparer: Comparer) -> None:
    @directed("P104-STP-01")
    @cocotb.parametrize(count=[1, 2])
    async def many(dut: Any, count: int) -> None:
        await start()
        assert count in (1, 2)

    @cocotb.parametrize(count=[1, 2])
    @directed("P104-STP-01")
    async def others(dut: Any, count: int) -> None:
        await start()

    for test in (many, others):
        cases = list(test.generate_tests())
        assert [case.name.rpartition("/")[2] for case in cases] == ["count=1", "count=2"]
        for case in cases:
            on_model(case.func(OnModel(), **case.kwargs))
    assert len(comparer.benches) == 4


def test_golden_follows_and_is_never_ahead() -> None:
    """The model that `golden` returns has received all pin changes of its bench, and has run up to the edge
    before the next edge of the bench.
    """
    bench, golden = ModelBench(PPMC104, OnModel()), DutBench.golden.fget
    model = golden(bench)
    assert model.now == bench.now - 1
    on_model(bench.clocks(10))
    bench.set(csel=0)
    assert golden(bench) is model and model is not bench.model
    assert model.now == bench.now - 1
    on_model(bench.clocks(1))
    assert golden(bench).inputs["csel"] == 0
