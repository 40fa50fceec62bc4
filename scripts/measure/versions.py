"""`make test WITH=versions`: test the package with its oldest and newest dependencies.

Each test has a separate environment. The lowest version of each dependency in pyproject.toml is tested with
the oldest Python that is found (3.10 or newer), the newest versions with the newest Python.
"""

from __future__ import annotations

import argparse
import glob
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "versions"
EXTRAS = "[decode,epics,ophyd,plot]"
TOOLS = re.compile(r"(?:cocotb|find_libpython|hypothesis|pytest[\w-]*)==.*")
"""Pattern of lines in requirements.lock: packages that only the tests need."""
TESTS = ("tests/*/host", "tests/*/cli", "tests/common/capture", "tests/common/lab")
FOUND = "import sys, venv, ensurepip; print(*sys.version_info[:2], sys.executable)"


class VersionsError(Exception):
    """There is no suitable Python, or a step has failed; the message is one line."""


def pythons(names: Iterable[str]) -> list[tuple[tuple[int, int], str]]:
    """Return (version, path) of all interpreters that can make an environment, oldest first."""
    found: dict[tuple[int, int], str] = {}
    for name in names:
        try:
            done = subprocess.run([name, "-c", FOUND], text=True, capture_output=True, check=False)
        except OSError:
            continue
        if done.returncode == 0:
            major, minor, path = done.stdout.rstrip().split(" ", 2)
            if (int(major), int(minor)) >= (3, 10):
                found.setdefault((int(major), int(minor)), path)
    return sorted(found.items())


def candidates() -> list[str]:
    """Return the interpreters on PATH and in the folder of pyenv."""
    pyenv = os.environ.get("PYENV_ROOT") or os.path.expanduser("~/.pyenv")
    names = ["python3", *(f"python3.{minor}" for minor in range(10, 30))]
    return [*names, *glob.glob(f"{glob.escape(pyenv)}/versions/*/bin/python")]


def lowest(project: str) -> list[str]:
    """Return a constraint `name==version` for each `name>=version` in the text of a pyproject.toml."""
    return [f"{name}=={version}" for name, version in re.findall(r'"([\w-]+)>=([\w.]+)"', project)]


def step(what: str, words: list[str], folder: Path = ROOT) -> None:
    """Run the command of a step; raise VersionsError if it fails."""
    env = {**os.environ, "PIP_REQUIRE_VIRTUALENV": "0", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    env["OPENPPMC_STATE"] = str(WORK / "state")
    if subprocess.run(words, cwd=folder, env=env, check=False).returncode:
        raise VersionsError(f"{what} failed: {' '.join(words[:6])} …")


def trial(name: str, python: str, constraints: list[str], tests: list[str]) -> None:
    """Build the package, install it with these constraints, run a command and the tests."""
    folder = WORK / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    limits = folder / "constraints.txt"
    limits.write_text("\n".join(constraints) + "\n", encoding="utf-8")
    step(name, [python, "-m", "venv", str(folder / "env")])
    own = str(folder / "env" / "bin" / "python")
    pip = [own, "-m", "pip", "install", "--quiet", "--retries", "2", "--upgrade"]
    step(name, [own, "-m", "pip", "wheel", "--quiet", "--no-deps", "-w", str(folder), str(ROOT)])
    wheel = next(folder.glob("*.whl"))
    lines = (ROOT / "requirements.lock").read_text(encoding="utf-8").splitlines()
    tools = [line for line in lines if TOOLS.fullmatch(line)]
    step(name, [*pip, "-c", str(limits), f"{wheel}{EXTRAS}", "bluesky", *tools])
    step(name, [own, "-m", "pip", "list", "--format", "freeze"])
    # Test the installed package, not the package in the source tree.
    step(name, [str(folder / "env/bin/openppmc"), "--port", "model:speed=max", "status"], folder)
    step(name, [own, "-m", "pytest", "-n", "0", "-q", "-W", "ignore", *tests])


def main(words: list[str] | None = None) -> int:
    """Test with the lowest and with the newest versions; return the exit status."""
    parser = argparse.ArgumentParser(prog="make test WITH=versions", description=__doc__)
    parser.add_argument("-k", default="", help="names of tests")
    word = parser.parse_args(words).k
    tests = [path for one in TESTS for path in glob.glob(one)] + (["-k", word] if word else [])
    found = pythons(candidates())
    try:
        if not found:
            raise VersionsError("no Python 3.10 or newer with venv; install one, or add it to PATH")
        for name, (version, python), constraints in (
            ("lowest", found[0], lowest((ROOT / "pyproject.toml").read_text(encoding="utf-8"))),
            ("newest", found[-1], []),
        ):
            print(f"versions: {name} versions, Python {version[0]}.{version[1]} ({python})", flush=True)
            trial(name, python, constraints, tests)
    except VersionsError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\nerror: interrupted", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
