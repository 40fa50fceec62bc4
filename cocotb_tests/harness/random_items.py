"""`RandomItems`: random tests of one kind, for the `test_random.py` of a part.

    random_item = RandomItems("stmc", "tb_random", "stmc_random_host", range(1, 151), build)
    pytest_generate_tests = generating(test_random=random_item)

Several seeds share a simulation (`batches`); each seed begins with a reset. A failing simulation reports the
shortest failing stimulus that was found (`shrink_report`).
"""

from __future__ import annotations

import importlib
import os
import re
import shutil
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from openppmc.check.records import Recording

from .build import Design, SimError, part_design
from .collect import Item, cocotb_items
from .compare import COUNTS_FILE, total_counts
from .config import SEEDS, Config
from .jitter import jitters
from .model_bench import OnModel, on_model
from .part import PARTS
from .paths import FAILURES, relative
from .replay import REPLAY, WORDS
from .runner import REPRO, SimOptions, attempt, run_sim
from .simulate import safe
from .variants import mutant_present

MODULE = "cocotb_tests.harness.replay"


def attempt_random(
    item: Item,
    options: SimOptions | None = None,
    env: Mapping[str, str] | None = None,
    design: Design | None = None,
) -> str:
    """Do the same as `attempt`; the message of a failing run ends with its shortest list of transactions.

    The search for this list simulates the device alone.
    """
    message = attempt(item, options, env, design)
    if not message or mutant_present():
        return message
    seed = options.seed if options and options.seed is not None else item.seed
    return f"{message}\n{shrink_report(FAILURES / f'{safe(item.id)}-s{seed}')}"


def replay_item(recording: Recording, test: str = "replay") -> Item:
    """Return the simulation that replays a recording, in the build of the recording."""
    known = {"clk_hz", "xtal_hz", "timing", "phase_idle"}
    params = {name.lower(): value for name, value in recording.params.items()}
    given = {name: value for name, value in params.items() if name in known}
    more = tuple((name.upper(), value) for name, value in params.items() if name not in known)
    config = Config("replay", **given, extra=more)  # type: ignore[arg-type]
    return Item(MODULE, test, config, recording.part, (), recording.seed)


def replay_line(file: Path) -> str:
    """Return the command that replays a recording."""
    return f"make replay FILE={relative(file)}"


def shrink_report(folder: Path, design: Design | None = None) -> str:
    """Shrink the recording of a failing run in its folder; return the shortest list of transactions as text.

    `design` (default: the recorded device) is simulated. The results are in the subfolder `short`.
    """
    file, short = folder / "recording.json", folder / "short"
    if jitters():
        return "not shrunk: a recording with JITTER=1 has the sampled levels, not the pins"
    if not file.is_file():
        return "not shrunk: no difference from the golden model was recorded"
    item = replay_item(Recording.from_json(file.read_text(encoding="utf-8")), "shrink")
    line = replay_line(short / "recording.json")
    trouble = ""
    try:
        design = design or part_design(item.part, item.config)
        run_sim(design, item, item.seed, env={REPLAY: str(file.resolve())}, folder=short, repro=line)
    except SimError as error:
        # A failed assertion or the time limit ended the search; the file contains the best list so far.
        trouble = str(error).splitlines()[0]
    words = short / WORDS
    if not words.is_file():
        return f"not shrunk: {trouble}"
    text = words.read_text(encoding="utf-8")
    if not (short / "recording.json").is_file():
        return text
    cut = f"\n(the search ended early: {trouble})" if trouble else ""
    return f"{text}{cut}\nlist and recording in {relative(short)}, carried out again by: {line}"


BATCH = 25


@cache
def _items(part: str, module: str) -> dict[str, Item]:
    params = cocotb_items(f"cocotb_tests.{part}", module, part=PARTS[part])
    return {param.values[0].test: param.values[0] for param in params}


def seed_item(part: str, module: str, test: str, seed: int, config: Config) -> Item:
    """Return the simulation of a device's random hosts, in the build of a seed."""
    return replace(_items(part, module)[test], config=config, seed=seed, tag=f"r{seed:04d}")


def batches(items: Sequence[Item], size: int = BATCH) -> list[tuple[Item, str]]:
    """Group items into simulations: at most `size` items of the same build in each.

    Returns (first item, all seeds) of each simulation.
    """
    builds: dict[str, list[Item]] = {}
    for item in items:
        builds.setdefault(item.config.name, []).append(item)
    return [
        (group[k], " ".join(str(item.seed) for item in group[k : k + size]))
        for group in builds.values()
        for k in range(0, len(group), size)
    ]


def parametrize(
    metafunc: pytest.Metafunc, make: Callable[[int], Item], seeds: Iterable[int], size: int = BATCH
) -> None:
    """Generate one pytest item (`item`, `seeds`) for each batch of seeds."""
    sets = batches([make(seed) for seed in seeds], size)
    metafunc.parametrize(("item", "seeds"), sets, ids=[item.id for item, _ in sets])


def batch_repro(item: Item) -> str:
    """Return the command that repeats the batch of seeds that begins with an item."""
    return f"make {item.target} T={item.id}{' JITTER=1' if jitters() else ''}"


def run_batch(item: Item, seeds: str, options: SimOptions, design: Design | None = None) -> None:
    """Run the seeds of a batch in one simulation, as a pytest test."""
    __tracebackhide__ = True
    print(f"seeds {seeds}")
    whole = {REPRO: batch_repro(item)} if " " in seeds else {}
    if message := attempt_random(item, options, {SEEDS: seeds, **whole}, design):
        pytest.fail(message, pytrace=False)


def played(make: Callable[[int], Item], fixed: Iterable[int]) -> list[int]:
    """Return the seeds of all batches that `fixed` seeds form, in ascending order."""
    return sorted(int(word) for _, seeds in batches([make(seed) for seed in fixed]) for word in seeds.split())


Failure = tuple[int, str, str]
"""A failing run: seed, test ID, message."""


@dataclass
class Played:
    """Result of some seeds; `compared`: name -> count, summed over comparisons with the golden model."""

    failures: list[Failure] = field(default_factory=list)
    compared: Counter[str] = field(default_factory=Counter)

    def add(self, other: Played) -> None:
        """Add the results of another simulation."""
        self.failures += other.failures
        self.compared.update(other.compared)


def play(items: Sequence[Item], design: Callable[[Item], Design | None], size: int = BATCH) -> Played:
    """Play one item per seed. If a seed of a simulation fails, repeat each of its seeds alone."""
    played = Played()
    alone = {item.seed: item for item in items}
    for first, seeds in batches(items, size):
        numbers = [int(word) for word in seeds.split()]
        whole = {REPRO: batch_repro(first)} if len(numbers) > 1 else {}
        message = _attempt(played, first, {SEEDS: seeds, **whole}, design(first))
        if not message:
            continue
        if len(numbers) == 1:
            played.failures.append((numbers[0], first.id, message))
            continue
        found = [
            (seed, alone[seed].id, said)
            for seed in numbers
            if (said := _attempt(played, alone[seed], {}, design(first)))
        ]
        played.failures += found or [(numbers[0], first.id, message)]
    return played


def _attempt(played: Played, item: Item, env: dict[str, str], design: Design | None) -> str:
    with TemporaryDirectory(prefix="openppmc-") as folder:
        file = Path(folder) / f"counts-{os.getpid()}"
        message = attempt_random(item, env={**env, COUNTS_FILE: str(file)}, design=design)
        if not message:
            played.compared.update(total_counts(file))
    return message


def all_of(parts: Iterable[Played]) -> Played:
    """Return the sum of several results."""
    played = Played()
    for part in parts:
        played.add(part)
    return played


@dataclass(frozen=True, eq=False)
class RandomItems:
    """Random tests of one kind; `random_item(seed)` returns the simulation of any seed.

    Attributes:
        seeds: seeds that `make test` plays; a simulation plays up to `batch` seeds of one build.
        build: function that returns the build of a seed.
        design: simulated design, if it is not the device alone.
        takes: function that returns True if a seed belongs to this kind.
    """

    part: str
    module: str
    test: str
    seeds: Sequence[int]
    build: Callable[[int], Config]
    batch: int = BATCH
    design: Callable[[Config], Design] | None = None
    takes: Callable[[int], bool] = lambda seed: True

    def __call__(self, seed: int) -> Item:
        """Return the simulation of a seed."""
        return seed_item(self.part, self.module, self.test, seed, self.build(seed))

    @property
    def complete(self) -> bool:
        """Whether `make test` plays each seed exactly once."""
        return played(self, self.seeds) == list(self.seeds)

    def _design(self, item: Item) -> Design | None:
        return self.design(item.config) if self.design else None

    def run(self, item: Item, seeds: str, options: SimOptions) -> None:
        """Run the seeds of a batch in one simulation, as a pytest test."""
        __tracebackhide__ = True
        run_batch(item, seeds, options, self._design(item))

    def some(self, seeds: Sequence[int]) -> Played:
        """Run some seeds in this process, for `make soak`."""
        return play([self(seed) for seed in seeds], self._design, self.batch)

    def pins(self, seed: int) -> tuple[str, str]:
        """Return two digests of all pin changes of a seed: on the RTL, and on the golden model alone."""
        item = self(seed)
        folder = run_sim(self._design(item) or part_design(item.part, item.config), item, seed)
        found = re.search(r"edges compared, pins (\w+)", (folder / "log.txt").read_text(encoding="utf-8"))
        shutil.rmtree(folder)
        test = getattr(importlib.import_module(item.module), item.test)
        return found[1] if found else "", on_model(test.func(OnModel(item.config, seed)))


def generating(**kinds: RandomItems) -> Callable[[pytest.Metafunc], None]:
    """Return the `pytest_generate_tests` of a module.

    It generates one item per batch for each named test function.
    """

    def generate(metafunc: pytest.Metafunc) -> None:
        kind = kinds.get(metafunc.function.__name__)
        if kind:
            chosen = metafunc.config.getoption("--seed")
            seeds = kind.seeds if chosen is None else [chosen] if kind.takes(chosen) else []
            parametrize(metafunc, kind, seeds, kind.batch)

    return generate
