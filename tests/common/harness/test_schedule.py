"""Tests that share a simulator process are still separate tests of pytest: own results, own selection."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import BUILD, ROOT

SAMPLE = '''"""Items of tb_runs, each of which writes down where it ran."""

import os
from pathlib import Path

import pytest

from cocotb_tests.harness.runner import run_item
from tests.common.harness.test_runs import ITEMS, counter

NAMES = ("passes", "raises", "skips", "xfails", "shows", "cases/step=1", "cases/step=-2")


@pytest.mark.parametrize("item", [pytest.param(ITEMS[name], id=ITEMS[name].id) for name in NAMES])
def test_sample(item, sim_options):
    worker = os.environ.get("PYTEST_XDIST_WORKER", "")
    with Path(os.environ["SEEN"]).open("a") as file:
        file.write(f"{worker} {len(sim_options.group)} {len(sim_options.done)}\\n")
    run_item(item, sim_options, design=counter())
'''


# The waves of a test have one folder, so these runs of the same tests must not overlap.
waves = pytest.mark.xdist_group("waves of the sample")


@pytest.fixture(name="sample")
def _sample() -> Iterator[Path]:
    """Write the sample below the project's folder, where the plugin is loaded; each worker has its own
    folder.
    """
    (BUILD / "sample").mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=BUILD / "sample") as folder:
        file = Path(folder) / "test_sample.py"
        file.write_text(SAMPLE, encoding="utf-8")
        yield file


def ran(sample: Path, seen: Path, *words: str) -> tuple[dict[str, int], list[list[str]]]:
    """Run pytest; return the number of tests by outcome, and (worker, group size, groups run before) for each
    test.
    """
    env = {**os.environ, "SEEN": str(seen)}
    env.pop("PYTEST_XDIST_WORKER", None)
    env.pop("PYTEST_CURRENT_TEST", None)
    command = [sys.executable, "-m", "pytest", str(sample), "-p", "no:cacheprovider", *words]
    done = subprocess.run(command, cwd=ROOT, env=env, capture_output=True, text=True, check=False)
    last = done.stdout.strip().splitlines()[-1]
    counts = {word: int(n) for n, word in re.findall(r"(\d+) (passed|failed|skipped|xfailed)", last)}
    assert counts, done.stdout + done.stderr
    return counts, [row.split(" ") for row in seen.read_text().splitlines()]


@pytest.mark.parametrize("workers", ["0", "2"])
def test_a_group_is_one_process_of_one_worker(sample: Path, tmp_path: Path, workers: str) -> None:
    counts, rows = ran(sample, tmp_path / "seen", "-n", workers)
    assert counts == {"passed": 3, "failed": 2, "skipped": 1, "xfailed": 1}
    assert len({worker for worker, _, _ in rows}) == 1
    assert [row[1:] for row in rows] == [["7", "0"], *([["7", "1"]] * 6)]


def test_one_test_alone(sample: Path, tmp_path: Path) -> None:
    counts, rows = ran(sample, tmp_path / "seen", "-n", "2", "-k", "raises-f16")
    assert counts == {"passed": 1} and [row[1:] for row in rows] == [["0", "0"]]


def test_some_by_their_names(sample: Path, tmp_path: Path) -> None:
    """Tests can be selected by their names, as in the command that repeats a group."""
    counts, rows = ran(sample, tmp_path / "seen", "-k", "raises-f16 or cases.step.1-f16")
    assert counts == {"passed": 2} and [row[1] for row in rows] == ["2", "2"]


def test_the_first_failure_ends_the_run(sample: Path, tmp_path: Path) -> None:
    counts, rows = ran(sample, tmp_path / "seen", "-n", "0", "-x")
    assert counts == {"passed": 2, "failed": 1, "skipped": 1, "xfailed": 1} and len(rows) == 5


@waves
def test_with_waves_each_is_alone(sample: Path, tmp_path: Path) -> None:
    counts, rows = ran(sample, tmp_path / "seen", "-n", "0", "--waves", "-k", "raises or skips")
    assert counts == {"passed": 1, "skipped": 1} and [row[1] for row in rows] == ["0", "0"]


@waves
@pytest.mark.parametrize(("mark", "workers"), [("", 2), ('pytestmark = pytest.mark.xdist_group("one")\n', 1)])
def test_what_is_marked_goes_to_one_worker(sample: Path, tmp_path: Path, mark: str, workers: int) -> None:
    """Tests with the same `xdist_group` run in one worker, even if each runs in its own process."""
    sample.write_text(f"{SAMPLE}\n\n{mark}", encoding="utf-8")
    _, rows = ran(sample, tmp_path / "seen", "-n", "2", "--waves")
    assert len(rows) == 7 and len({worker for worker, _, _ in rows}) == workers
