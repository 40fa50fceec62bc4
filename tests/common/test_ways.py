"""Limits for the modules, files and calls of a command or an import, each measured in a separate process.

If a limit is exceeded, the command may load a module that it does not use, or a layer may have been added.
docs/architecture.md describes the path of a byte. Lower a limit when a change allows it.
"""

from __future__ import annotations

import ast
import json
import re
import resource
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc.host import Ppmc104

HELP = "from openppmc.cli import main; main(['--help'])"
MOVE = ("--port", "model:speed=max", "move", "3000")
SIMULATION = "import cocotb_tests.ppmc104.tb_ext_clock"
"""The import that a simulator makes for a file of directed tests."""


@cache
def measured(way: str, *words: str) -> list[str]:
    """Return the result of `ways` in a separate process."""
    command = [sys.executable, "-m", "tests.common.ways", way, *words]
    done = subprocess.run(command, cwd=ROOT, text=True, capture_output=True, check=False, timeout=120)
    assert done.returncode == 0 and done.stdout, done.stderr
    return json.loads(done.stdout)


def below(names: list[str], *folders: str) -> list[str]:
    """Return the modules or files that are in these packages or folders."""
    return [name for name in names if name.startswith(folders)]


def few(names: list[str], bound: int) -> None:
    """Fail with the list of names if there are more names than the limit."""
    if not 0 < len(names) <= bound:
        pytest.fail(f"{len(names)}, not {bound}: {', '.join(names)}", pytrace=False)


@pytest.mark.parametrize(
    ("code", "package", "bound"),
    [
        (HELP, "openppmc", 12),
        (f"from openppmc.cli import main; main({[*MOVE]})", "openppmc", 59),
        ("from openppmc.host import Ppmc104", "openppmc", 25),
        (SIMULATION, "openppmc.model", 18),
        (SIMULATION, "cocotb_tests.harness", 18),
    ],
    ids=["help", "move", "driver", "models-in-simulation", "harness-in-simulation"],
)
def test_loads_few_modules(code: str, package: str, bound: int) -> None:
    """A command, an import of a driver and a simulation load only the modules that they use."""
    few(below(measured("modules", code), package), bound)


@pytest.mark.parametrize(
    ("folders", "bound"),
    [(("openppmc/cli/", "openppmc/host/"), 24), (("openppmc/model/",), 11)],
    ids=["cli-and-host", "model"],
)
def test_a_move_enters_few_files(folders: tuple[str, ...], bound: int) -> None:
    """A move, from the command to the golden model, enters functions of few files, so it is easy to
    follow.
    """
    few(below(measured("files", *MOVE), *folders), bound)


def test_a_move_makes_few_calls() -> None:
    """Between `main` and the link there are few frames, of which few check arguments."""
    frames = measured("frames", *MOVE)
    assert [frames[0][1], frames[-1][1]] == ["main", "_run"]
    assert len(frames) <= 15, frames
    checks = [frame for frame in frames if frame[0].endswith(("/arguments.py", "/check.py"))]
    assert 0 < len(checks) <= 4, frames


def _cpu(*words: str) -> float:
    """Return the CPU time of a Python process in seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *words], cwd=ROOT, check=True, stdout=subprocess.DEVNULL, timeout=120)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def test_help_costs_little_more_than_typer() -> None:
    """`openppmc --help` takes at most 3 times the CPU time of `import typer` (minima of five runs)."""
    pairs = [(_cpu("-m", "openppmc.cli", "--help"), _cpu("-c", "import typer")) for _ in range(5)]
    help_seconds, typer_seconds = map(min, zip(*pairs, strict=True))
    assert help_seconds <= 3 * typer_seconds, f"{help_seconds:.3f} s, {typer_seconds:.3f} s"


def test_a_part_has_few_bases_and_names() -> None:
    """A `Ppmc104` has few base classes and few public names."""
    few([base.__name__ for base in Ppmc104.__mro__[1:-1]], 5)
    few([name for name in dir(Ppmc104) if not name.startswith("_")], 35)


def private_names(path: Path) -> list[str]:
    """Return the uses of names with `_` of other objects in a file, except those of named tuples and `os`."""
    own = ("self", "cls", "super()", "os")
    return [
        f"{path.relative_to(ROOT)}:{node.lineno}: {ast.unparse(node)}"
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Attribute)
        and re.match(r"_(?!_)", node.attr)
        and node.attr not in ("_asdict", "_fields", "_make", "_replace")
        and ast.unparse(node.value) not in own
    ]


def test_users_of_the_host_package_need_no_private_name() -> None:
    """The command line, the adapters and the examples use only public names of the drivers."""
    files = [
        *(ROOT / f"openppmc/{name}.py" for name in ("drives", "epics", "linuxcnc", "ophyd", "positioner")),
        *(ROOT / "openppmc/cli").rglob("*.py"),
    ]
    files += (ROOT / "examples").rglob("*.py")
    assert len(files) > 30
    assert [use for path in sorted(files) for use in private_names(path)] == []


@pytest.mark.parametrize(
    ("folder", "longest", "bound"),
    [("openppmc/host", 0, 67), ("cocotb_tests/harness", 0, 37), ("openppmc", 0, 283), ("openppmc", 60, 69)],
)
def test_few_files(folder: str, longest: int, bound: int) -> None:
    """A folder has few files, and only few of them are short.

    Args:
        longest: only files with at most this number of lines are counted; 0: all files are counted.
    """
    found = sorted((ROOT / folder).rglob("*.py"))
    lines = {
        str(path.relative_to(ROOT)): len(path.read_text(encoding="utf-8").splitlines()) for path in found
    }
    few([name for name, count in lines.items() if not longest or count <= longest], bound)


def test_scripts_have_few_lines() -> None:
    """The number of lines of the scripts is limited (docs/decisions/0137-lines-of-scripts.md)."""
    files = [path for path in (ROOT / "scripts").rglob("*") if path.suffix in (".py", ".yml", ".sh")]
    assert len(files) > 100
    assert sum(len(path.read_text(encoding="utf-8").splitlines()) for path in files) <= 25_550
