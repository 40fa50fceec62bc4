"""The runner of campaigns: results, a lost worker, interruption and continuation, errors of one line."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from distributed import Future

from cocotb_tests.harness.project import ROOT, ProjectError
from scripts.measure.campaign.cluster import Workers
from scripts.measure.campaign.jobs import Done
from scripts.measure.campaign.run import run
from scripts.measure.campaign.store import Store

from . import work

TWO = Workers(2)


def ran(folder: Path, how: object, count: int, workers: Workers = TWO, stamp: str = "") -> dict[str, Done]:
    """Run jobs 0 … count - 1; return the results by key."""
    with Store(folder / "results.sqlite") as store:
        return {
            done.key: done for done in run(work.campaign(how, folder, count, stamp), workers, store=store)
        }


def test_all_results_come_from_both_workers(tmp_path: Path) -> None:
    """Each of forty jobs on two workers runs once, and a job that fails is reported as failed."""
    done = ran(tmp_path, work.square, 40)
    assert [done[str(n)].data["square"] for n in range(40)] == [n * n for n in range(40)]
    assert [key for key in done if not done[key].good] == ["13"]
    assert len({one.data["worker"] for one in done.values()}) == 2
    assert all(work.begun(tmp_path, n) == 1 for n in range(40))


def test_a_killed_worker_loses_nothing(tmp_path: Path) -> None:
    """If one of two workers is killed, its job runs again, and all other jobs run, too."""
    done = ran(tmp_path, work.dies, 40)
    assert len(done) == 40 and done["5"].good and done["5"].data["square"] == 25
    assert work.begun(tmp_path, 5) == 2
    assert len({one.data["worker"] for one in done.values()}) >= 2


def test_a_job_that_kills_each_worker_is_no_good(tmp_path: Path) -> None:
    """If a job kills every worker, it is listed as failed, and all other jobs have their results."""
    done = ran(tmp_path, work.dies_always, 12)
    assert [key for key in done if not done[key].good] == ["5"]
    assert done["5"].data["message"] == "its workers were lost" and len(done) == 12


def test_good_results_are_taken_over(tmp_path: Path) -> None:
    """If a campaign gets more jobs, only the failed and the new jobs run."""
    ran(tmp_path, work.square, 15)
    done = ran(tmp_path, work.square, 20)
    assert len(done) == 20 and sum(one.old for one in done.values()) == 14
    begun = [work.begun(tmp_path, n) for n in range(20)]
    assert begun == [2 if n == 13 else 1 for n in range(20)]
    again = ran(tmp_path, work.square, 3, stamp="another tree")
    assert not any(one.old for one in again.values())


def test_ctrl_c_and_going_on(tmp_path: Path) -> None:
    """Ctrl-C ends a campaign within seconds; the next run executes only the remaining jobs, each once."""
    command = [sys.executable, "-m", work.__name__, str(tmp_path)]
    with subprocess.Popen(
        command,
        cwd=ROOT,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        # Background jobs of a shell ignore SIGINT, and child processes inherit that.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as first:
        assert first.stdout and first.stderr
        seen = [first.stdout.readline() for _ in range(5)]
        first.send_signal(signal.SIGINT)
        since = time.monotonic()
        out, told = first.communicate(timeout=60)
    assert first.returncode == 130 and time.monotonic() - since < 20
    assert told.strip().splitlines() == ["error: interrupted"]
    assert len([line for line in seen if line.strip()]) == 5
    kept = len(seen) + len(out.split())
    assert 5 <= kept < 20
    rest = subprocess.run(command, cwd=ROOT, text=True, capture_output=True, check=True)
    assert len(rest.stdout.split()) == 20
    assert sum(work.begun(tmp_path, n) == 1 for n in range(20)) >= kept
    assert all(work.begun(tmp_path, n) <= 2 for n in range(20))


def test_ctrl_c_while_a_job_is_submitted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C during the creation of a Future ends the campaign, and no traceback is printed."""
    printed: list[str] = []
    monkeypatch.setattr(sys, "unraisablehook", lambda what: printed.append(str(what.exc_value)))
    create = Future.__init__

    def interrupted(self: Future, *words: object, **named: object) -> None:
        signal.raise_signal(signal.SIGINT)
        create(self, *words, **named)

    monkeypatch.setattr(Future, "__init__", interrupted)
    with pytest.raises(KeyboardInterrupt):
        ran(tmp_path, work.square, 5)
    assert printed == []


def test_mistakes_are_one_line(tmp_path: Path) -> None:
    """An invalid job, address, count or file causes a ProjectError of one line."""
    with pytest.raises(ProjectError, match="^no such thing$"):
        ran(tmp_path, work.refuses, 3)
    with pytest.raises(ProjectError, match="SCHEDULER=tcp://127.0.0.1:1: no answer"):
        ran(tmp_path, work.square, 50, Workers(2, "tcp://127.0.0.1:1"))
    with pytest.raises(ProjectError, match="SCHEDULER=here: expected tcp://host:port"):
        Workers(2, "here")
    with pytest.raises(ProjectError, match="-n must be 1 or more"):
        Workers(0)
    (tmp_path / "results.sqlite").write_text("no data base, but some words that are long enough to be read")
    for name in ("results.sqlite-wal", "results.sqlite-shm"):
        (tmp_path / name).unlink(missing_ok=True)
    with pytest.raises(ProjectError, match="remove it to start again"):
        ran(tmp_path, work.square, 1)
