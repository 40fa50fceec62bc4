"""The environment that make installs: stamps, the lock between two makes, a broken .venv, errors of pip.

A script replaces pip, so the tests download nothing.
"""

from __future__ import annotations

import fcntl
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from cocotb_tests.harness.paths import ROOT
from scripts import env

PIP = """#!/bin/sh
case "$*" in
*--version) echo "pip {version} from here" ;;
*) echo "$*" >>calls; {install} ;;
esac
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """Create a folder with the module, its groups and the lock file; `fake` adds a .venv."""
    (tmp_path / "scripts").mkdir()
    for name in ("scripts/__init__.py", "scripts/env.py", "pyproject.toml", "requirements.lock"):
        shutil.copy(ROOT / name, tmp_path / name)
    return tmp_path


def fake(project: Path, install: str = "echo Collecting cocotb", version: str = "") -> None:
    """Create a .venv whose pip runs the shell text `install`; by default, pip has the locked version."""
    lock = (project / "requirements.lock").read_text(encoding="utf-8")
    version = version or lock.split("\npip==")[1].split()[0]
    (project / ".venv" / "bin").mkdir(parents=True)
    library = project / ".venv" / "lib" / f"python{sys.version_info.major}.{sys.version_info.minor}"
    library.mkdir(parents=True)
    python = project / ".venv" / "bin" / "python"
    python.write_text(PIP.format(version=version, install=install))
    python.chmod(0o755)


def start(project: Path, *groups: str) -> subprocess.Popen[str]:
    """Start `python -m scripts.env GROUP…` in the project."""
    command = [sys.executable, "-B", "-m", "scripts.env", *groups]
    pipe = subprocess.PIPE
    return subprocess.Popen(command, cwd=project, stdout=pipe, stderr=pipe, text=True)


def install(project: Path, *groups: str) -> tuple[int | None, str, str]:
    """Run scripts.env to its end; return its exit code and both outputs."""
    process = start(project, *groups)
    out, err = process.communicate(timeout=120)
    return process.returncode, out, err


def calls(project: Path) -> list[str]:
    """Return the arguments of each call of pip."""
    path = project / "calls"
    return path.read_text().splitlines() if path.exists() else []


def test_groups_are_installed_once(project: Path) -> None:
    """An installed group is not installed again unless the groups or the lock file change. `dev` includes
    `sim`.
    """
    fake(project)
    for groups in (("dev", "campaign"), ("dev",), ("sim",)):
        assert install(project, *groups)[0] == 0
    (call,) = calls(project)
    assert call.endswith("requirements.lock --group dev --group campaign")
    text = (project / "pyproject.toml").read_text(encoding="utf-8")
    (project / "pyproject.toml").write_text(text + "\n[tool.other]\n", encoding="utf-8")
    install(project, "sim")
    assert len(calls(project)) == 1
    with (project / "requirements.lock").open("a") as lock:
        lock.write("new==1\n")
    install(project, "sim")
    assert len(calls(project)) == 2


def test_an_old_pip_is_replaced_first(project: Path) -> None:
    """A pip that is too old to support groups is replaced before the installation."""
    fake(project, version="23.2")
    install(project, "sim")
    assert [call.split("requirements.lock ")[1] for call in calls(project)] == [
        "--upgrade pip",
        "--group sim",
    ]


def test_two_makes_wait_for_each_other(project: Path) -> None:
    """If two makes run, the second reports that it waits, does not install again, and succeeds."""
    fake(project, "sleep 2; echo Collecting cocotb")
    both = [start(project, "sim"), start(project, "sim")]
    outputs = [process.communicate(timeout=120) for process in both]
    assert [process.returncode for process in both] == [0, 0], outputs
    assert len(calls(project)) == 1
    assert sum("another make installs packages; waiting for it" in out for out, _ in outputs) == 1


def test_waiting_ends(
    project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """If another make holds the lock for WAIT_S, one line states what to do."""
    monkeypatch.setattr(env, "LOCK", project / "requirements.lock")
    monkeypatch.setattr(env, "VENV", project / ".venv")
    monkeypatch.setattr(env, "WAIT_S", 1)
    with env.LOCK.open("r+") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        assert env.main(["sim"]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line == "error: .venv: another make has been installing for 1 s; end it, then repeat"


@pytest.mark.parametrize(
    ("says", "line"),
    [
        (
            "ERROR: Could not find a version that satisfies the requirement x==9 (from versions: 1, 2)",
            "Could not find a version that satisfies the requirement x==9",
        ),
        (
            "WARNING: Retrying after connection broken by NewConnectionError",
            "no connection to the package index",
        ),
        ("Segmentation fault", "pip failed"),
    ],
)
def test_pip_fails(project: Path, says: str, line: str) -> None:
    """If pip fails, one line states the reason and what to do; the next make tries again."""
    fake(project, f"echo '{says}'; exit 1")
    for _ in range(2):
        code, _, err = install(project, "sim")
        assert (code, err) == (1, f"error: packages for sim: {line}; see .venv/pip.log, then repeat\n")
    assert len(calls(project)) == 2


def test_a_broken_environment_is_made_again(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An environment without Python or pip, or with another Python, is rebuilt even if it has stamps."""
    for name, path in (
        ("ROOT", "."),
        ("VENV", ".venv"),
        ("BIN", ".venv/bin"),
        ("PYTHON", ".venv/bin/python"),
    ):
        monkeypatch.setattr(env, name, project / path)
    monkeypatch.setattr(env, "LOCK", project / "requirements.lock")
    monkeypatch.chdir(project)
    real = subprocess.run

    def run(command: list[str], **options: Any) -> Any:
        if command[1:3] == ["-m", "venv"]:
            assert Path(command[0]).samefile(sys.executable) and not env.VENV.exists()
            return fake(project) or subprocess.CompletedProcess(command, 0)
        return real(command, **options)

    monkeypatch.setattr(env.subprocess, "run", run)
    breaks = (
        lambda: env.PYTHON.unlink(),
        lambda: env.PYTHON.unlink() or env.PYTHON.symlink_to("/no/python3"),
        lambda: env.PYTHON.write_text("#!/bin/sh\nexit 1\n") and env.stamp("sim").unlink(),
        lambda: (env.VENV / "lib").rename(env.VENV / "old") and env.PYTHON.write_text("#!/bin/sh\nexit 1\n"),
    )
    for count, spoil in enumerate(breaks, 2):
        assert env.main(["sim"]) == 0 and env.missing(["sim"]) == []
        spoil()
        assert env.missing(["sim"]) == ["sim"] and env.main(["sim"]) == 0
        assert len(calls(project)) == count


def test_a_broken_environment_that_cannot_be_removed(project: Path) -> None:
    """If a broken environment cannot be removed, one line asks the user to remove it."""
    (project / ".venv").write_text("a file")
    code, _, err = install(project, "sim")
    assert (code, err) == (
        1,
        "error: .venv: broken and not removable (Not a directory); remove it, then repeat\n",
    )


def test_a_linked_environment_is_left_alone(project: Path) -> None:
    """An environment that is a link belongs to another checkout and is not changed."""
    (project / "other").mkdir()
    (project / ".venv").symlink_to("other")
    assert install(project, "sim", "dev") == (0, "", "")
    assert list((project / "other").iterdir()) == []
