"""The golden model in place of the RTL: time, pins, waits, the tests that run on it, a wrong figure."""

from __future__ import annotations

import asyncio
import importlib
from itertools import repeat
from typing import Any

import pytest

from cocotb_tests.harness import D16, F16, PARTS, HostBus, ModelBench, OnModel, on_model, start_bench
from cocotb_tests.harness.collect import all_tests, rules_of
from cocotb_tests.harness.model_tests import model_tests

RTL_ONLY = {
    "p2104_ac_03_write_times_of_the_data_sheet",
    "p2104_ac_04_read_times_of_the_data_sheet",
    "p2104_ac_05_no_invisible_write",
    "p2104_ac_66_clk_o",
}
ACCEPTANCE = {
    "ppmc104": ("moves", "stops", "clocks"),
    "ppmc2104": ("moves", "errors", "axes", "bus"),
    "stmc": ("moves", "stops", "registers"),
}


def new_bench(part: str = "ppmc104", **pins: int) -> ModelBench:
    return ModelBench(PARTS[part], OnModel(F16), **pins)


def test_time_goes_forward_only() -> None:
    """Waits advance the time. A wait or a pin change for a time in the past is rejected."""
    bench = new_bench()
    assert bench.now == 4 and on_model(bench.until(10)) == 10 and on_model(bench.clocks(5)) == 15
    with pytest.raises(ValueError, match="already edge 15"):
        on_model(bench.until(14))
    with pytest.raises(ValueError, match="already edge 15"):
        bench.at(14, l1_n=0)


def test_pins_change_at_their_stamps() -> None:
    """Immediate and scheduled pin changes are recorded at their edges, one bit at a time."""
    bench = new_bench("ppmc2104", busc=1)
    assert bench.set(**{"fl_n[2]": 0}) == 4
    cancelled = bench.at(20, errint_n=0)
    bench.at(12, auxi=3)
    cancelled.cancel()
    on_model(bench.until(30))
    assert bench.stimulus == [(0, "busc", 1), (4, "fl_n", 0b01), (12, "auxi", 3)]
    assert bench.pin("fl_n[2]") == 0 and bench.pin("fl_n") == 0b01


def test_an_external_clock_runs_during_the_test() -> None:
    """An external clock with a period of 20 cycles has exact edges until it is stopped."""
    bench = new_bench()
    clock = bench.external_clock(repeat(20), high=5)
    on_model(bench.until(50))
    clock.cancel()
    on_model(bench.until(200))
    assert [(c.t, c.value) for c in bench.stimulus] == [(4, 1), (9, 0), (24, 1), (29, 0), (44, 1), (49, 0)]
    assert bench.pin_edges("clock") == [4, 24, 44]


def test_waits_end_at_the_edge_or_after_their_time() -> None:
    """A wait for a pulse ends one edge after it; a wait for an edge that does not occur times out."""
    bench = new_bench()

    async def step() -> int:
        host = HostBus(bench)
        await host.init(0x0A, 9, 4, 4)
        await host.command(0xC1)
        await host.command(0x42, poll=False)
        edge = await bench.edge("pout_n", 0)
        assert bench.now == edge + 1 and bench.pulses() == [edge]
        assert await bench.level_is("pout_n", 1) == bench.rises("pout_n")[0] + 1
        return edge

    assert on_model(step()) > 0
    now = bench.now
    with pytest.raises(TimeoutError, match="no level 0 of aux_n within 500 cycles"):
        on_model(bench.edge("aux_n", 0, 500))
    assert bench.now == now + 500


def test_a_wait_for_the_simulator_is_reported() -> None:
    """If a coroutine waits for a trigger of the simulator, an error reports this."""
    with pytest.raises(RuntimeError, match="only a simulator has"):
        on_model(asyncio.sleep(0))


def test_the_bench_is_that_of_the_part_in_its_build() -> None:
    """The model has the parameters of its build, and its outputs have their reset levels."""
    bench: Any = on_model(start_bench(OnModel(D16), PARTS["ppmc104"], settle=0))
    assert bench.now == 0 and not bench.simulated and bench.model.datasheet
    assert {name: bench.level(name) for name in bench.outputs} == PARTS["ppmc104"].reset_levels()


@pytest.mark.parametrize("part", ACCEPTANCE)
def test_which_acceptance_checks_run_on_the_model(part: str) -> None:
    """All acceptance tests except RTL-only ones run on the model, with the same rules and docstrings."""
    names = [f"tb_acceptance_{name}" for name in ACCEPTANCE[part]]
    made = model_tests(__name__, f"cocotb_tests.{part}", *names)
    modules = [importlib.import_module(f"cocotb_tests.{part}.{name}") for name in names]
    tests = {test.func.__name__: test for module in modules for test in all_tests(module)}
    expected = {
        f"test_{name.partition('_')[2]}": test for name, test in tests.items() if name not in RTL_ONLY
    }
    assert set(made) == set(expected)
    for name, test in expected.items():
        assert rules_of(made[name]) == rules_of(test) and made[name].__doc__ == test.func.__doc__


def test_a_wrong_figure_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    """If an expected interval is wrong, the check fails on the model and reports the difference."""
    module = importlib.import_module("cocotb_tests.ppmc104.tb_acceptance_moves")
    monkeypatch.setattr(module, "A_INTERVALS", [321, *module.A_INTERVALS[1:]])
    made = model_tests(__name__, "cocotb_tests.ppmc104", "tb_acceptance_moves")
    with pytest.raises(AssertionError, match=r"AC-09: intervals: expected \[321, 256"):
        made["test_ac_09_trapezoid"]()
