"""Compares the part under random hosts with the golden model, for fixed seeds or with `--seed N`.

`python -m scripts.measure.soak --seed S --count N` runs any number of other seeds.
"""

from __future__ import annotations

import re
from pathlib import Path

from cocotb_tests.harness import (
    D16,
    F11,
    F16,
    F100,
    HostBus,
    ModelBench,
    OnModel,
    RandomItems,
    SimOptions,
    generating,
    on_model,
)
from cocotb_tests.harness.build import part_design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.compare import compare_recording
from cocotb_tests.harness.random_host import in_turn
from cocotb_tests.harness.random_items import shrink_report
from cocotb_tests.ppmc104.bench import PPMC104
from cocotb_tests.ppmc104.random_host import scenario
from openppmc.check.records import Recording

SEEDS = range(1, 221)
CHAOS_SEEDS = range(1, 41)


random_item = RandomItems("ppmc104", "tb_random", "random_host", SEEDS, lambda seed: scenario(seed).config)
noise_item = RandomItems(
    "ppmc104",
    "tb_random",
    "random_noise",
    CHAOS_SEEDS,
    in_turn(F16, F16, F11, F100, F16, D16),
)
pytest_generate_tests = generating(test_random=random_item, test_noise=noise_item)


def test_random(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """For the scenarios of some seeds, every output edge equals that of the golden model."""
    random_item.run(item, seeds, sim_options)


def test_noise(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """After noise on all pins, the documented sequence makes the core work again."""
    noise_item.run(item, seeds, sim_options)


def test_a_failing_run_ends_with_a_short_list(tmp_path: Path) -> None:
    """If golden model and RTL have different crystals, the failing run is reduced to fewer than ten
    transactions.
    """

    async def run(bench: ModelBench) -> None:
        host = HostBus(bench)
        for number in range(9):
            bench.set(auxi=number, vsel=number & 1)
            await host.command(0x80, poll=False)
            await bench.clocks(300)
        await host.init(0x0A, 9, 4, 4)
        await host.move(0x43, 3)
        await bench.clocks(9_000)

    bench = ModelBench(PPMC104, OnModel())
    on_model(run(bench))
    recording = bench.recording()
    recording.params["XTAL_HZ"] = 8_000_000
    (tmp_path / "recording.json").write_text(recording.to_json(), encoding="utf-8")
    text = shrink_report(tmp_path, part_design("ppmc104", F16)).splitlines()
    assert re.match(r"shrunk from \d\d transactions to [1-9] in \d+ trials(, \d lines)?:$", text[0]), text
    assert text[1].startswith("  write C ") and " differs at edge " in text[-2]
    short = Recording.from_json((tmp_path / "short" / "recording.json").read_text(encoding="utf-8"))
    assert len(short.stimulus) < len(recording.stimulus) / 3 and short.accesses
    assert compare_recording(short).mismatch is not None


def test_scenarios_are_reproducible_and_varied() -> None:
    """The same seed returns the same list; all fixed seeds together use each kind of action and each
    build.
    """
    assert scenario(5) == scenario(5) != scenario(6)
    assert random_item.complete and len(SEEDS) >= 200
    assert noise_item.complete
    plans = [scenario(seed) for seed in SEEDS]
    kinds = {action[0] for plan in plans for action in plan.actions}
    assert kinds == {
        "write",
        "send",
        "status",
        "read",
        "fetch",
        "finish",
        "wait",
        "pins",
        "blip",
        "raw",
        "reset",
    }
    assert {plan.config.name for plan in plans} == {
        "f16", "f8m", "f11m", "f25m", "f50m", "f100m", "d16", "d11m", "d25x8",
    }  # fmt: skip
    assert sum(plan.clocked for plan in plans) > 30
