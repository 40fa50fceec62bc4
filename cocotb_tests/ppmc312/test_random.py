"""Compares the part under random hosts and noise with the golden model, for fixed seeds or with `--seed N`.

One simulation plays several seeds of one build in turn, each after a reset. `make soak PART=ppmc312` plays
any number of other seeds.
"""

from __future__ import annotations

from cocotb_tests.harness import D16, F16, F50, OnModel, RandomItems, SimOptions, generating, on_model
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.random_host import in_turn

from . import random_serial
from .host_coverage import counting, thin
from .host_coverage_serial import counting_frames, thin_frames
from .random_host import ODD, build, play

SEEDS = range(1, 151)
NOISE_SEEDS = range(1, 33)
SERIAL_SEEDS = range(1, 41)
CHANGE_SEEDS = (*range(1, 29), 210)
BATCH = 14


random_item = RandomItems("ppmc312", "tb_random", "p312_random_host", SEEDS, build, BATCH)
noise_item = RandomItems(
    "ppmc312",
    "tb_random",
    "p312_random_noise",
    NOISE_SEEDS,
    in_turn(F16, F16, F50, ODD, F16, D16),
    BATCH,
)
changes_item = RandomItems(
    "ppmc312", "tb_random", "p312_random_changes", CHANGE_SEEDS, in_turn(F16, F50), BATCH
)
serial_item = RandomItems(
    "ppmc312", "tb_random", "p312_random_serial", SERIAL_SEEDS, random_serial.build, BATCH
)
pytest_generate_tests = generating(
    test_random=random_item, test_noise=noise_item, test_changes=changes_item, test_serial=serial_item
)


def test_random(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """With the hosts of some seeds, every output edge equals that of the golden model."""
    random_item.run(item, seeds, sim_options)


def test_noise(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """With noise on all pins, every output edge equals that of the golden model, and the device recovers."""
    noise_item.run(item, seeds, sim_options)


def test_changes(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """With changes of the speed in tables that are not monotonic, every output edge equals the model."""
    changes_item.run(item, seeds, sim_options)


def test_serial(item: Item, seeds: str, sim_options: SimOptions) -> None:
    """With hosts on the serial line, every output edge equals that of the golden model."""
    serial_item.run(item, seeds, sim_options)


def test_scenarios_are_reproducible_and_varied() -> None:
    """The fixed seeds are all different and together use each build."""
    builds = [build(seed) for seed in SEEDS]
    assert builds == [build(seed) for seed in SEEDS]
    assert {config.name for config in builds} == build.names
    assert all(one.complete for one in (random_item, noise_item, changes_item, serial_item))


def test_hosts_are_rich() -> None:
    """Each kind of event occurs often enough in every third host with FAST times.

    The device is in ABN or INI for less than 30 % of the time, and in ACC or FIX for more than 30 %.
    """
    with counting() as counts:
        for seed in SEEDS[::3]:
            if not build(seed).datasheet:
                on_model(play(OnModel(build(seed), seed), seed))
    assert not thin(counts), f"too rare (seen, needed): {thin(counts)}"
    cycles = sum(number for kind, number in counts.items() if kind.startswith("cycles "))
    assert (counts["cycles ABN"] + counts["cycles INI"]) / cycles < 0.3
    assert (counts["cycles ACC"] + counts["cycles FIX"]) / cycles > 0.3


def test_hosts_on_the_line_are_rich() -> None:
    """The fixed seeds use each build, and each kind of frame, reply and error occurs often enough."""
    assert {random_serial.build(seed).name for seed in SERIAL_SEEDS} == random_serial.build.names
    with counting_frames() as counts:
        for seed in SERIAL_SEEDS:
            on_model(random_serial.play(OnModel(random_serial.build(seed), seed), seed))
    assert not thin_frames(counts), f"too rare (seen, needed): {thin_frames(counts)}"
