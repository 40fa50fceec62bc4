"""Folders whose names break tools: builds work in them, or are rejected in one line.

`.ci/run` tests all steps in such a folder: clone, environment, demo, test, bitstream, virtual board.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from cocotb_tests.harness.project import ROOT
from openppmc.sim.common.build import SimError, verilator_command, verilator_environment
from scripts import env as environment

ODD = "my dir ünï (#1, 100%) it's"
DESIGN = 'module odd(input wire a, output wire b); `include "half.svh"\nendmodule\n'
MAIN = '#include "Vodd.h"\nint main() { Vodd top; top.a = 1; top.eval(); return top.b ? 0 : 1; }\n'


@pytest.mark.parametrize("name", ["a:b", 'a"b', "a$b", "a`b", "a\\b", "a\nb", "a\tb"])
def test_a_folder_that_cannot_work_is_refused_in_one_line(name: str, tmp_path: Path) -> None:
    done = check(tmp_path / name)
    assert done.returncode != 0 and done.stdout == ""
    (line,) = done.stderr.splitlines()
    assert "the project's folder must not have" in line


def test_an_odd_folder_is_not_refused(tmp_path: Path) -> None:
    assert "must not" not in check(tmp_path / ODD).stderr


def check(folder: Path) -> subprocess.CompletedProcess[str]:
    """Run the checks of `make demo` in `folder`, which contains nothing else."""
    for name in (
        "Makefile",
        "scripts/find_python.sh",
        *(f"scripts/{module}.py" for module in ("__init__", "run", "targets", "env")),
        *(f"openppmc/{module}.py" for module in ("__init__", "parts", "streams")),
    ):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    env = {name: value for name, value in os.environ.items() if not name.startswith("MAKE")}
    return subprocess.run(
        ["make", "-n", "demo"], cwd=folder, env=env, capture_output=True, text=True, check=False, timeout=60
    )


def test_verilator_builds_in_an_odd_folder(tmp_path: Path) -> None:
    """In a folder with such a name, Verilator finds sources, includes and C++ by their absolute names."""
    project = tmp_path / ODD
    work = project / "build" / "x"
    for path, text in {"odd.sv": DESIGN, "inc/half.svh": "assign b = a;\n", "main.cpp": MAIN}.items():
        (project / path).parent.mkdir(parents=True, exist_ok=True)
        (project / path).write_text(text)
    work.mkdir(parents=True)
    words = ["--cc", "--exe", "--build", "--top-module", "odd", "--Mdir", str(work), "-o", "odd"]
    words += ["--output-split", "0", "-MAKEFLAGS", "OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0"]
    words += [f"-I{project / 'inc'}", str(project / "odd.sv"), str(project / "main.cpp")]
    done = subprocess.run(
        verilator_command(words, work),
        cwd=work,
        env=verilator_environment(work),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert subprocess.run([work / "odd"], check=False).returncode == 0


def test_verilator_elsewhere_in_an_odd_folder_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("openppmc.sim.common.build.package", lambda: Path("/opt/my env/verilator"))
    with pytest.raises(SimError, match="put the Python environment and the project into one folder"):
        verilator_environment(Path("/srv/project/build"))


def test_make_calls_python3(tmp_path: Path) -> None:
    """Verilator's makefile calls python, which Debian does not have; python3 takes its place."""
    makefile = "PYTHON3 = python\nall:\n\t@echo $(PYTHON3)\n"
    env = verilator_environment(tmp_path)
    words = ["make", "--no-print-directory", "-f", "-"]  # make test is a make above this one
    said = subprocess.run(words, input=makefile, env=env, text=True, capture_output=True, check=True)
    assert said.stdout == "python3\n"


def test_the_command_starts_in_an_odd_folder(tmp_path: Path) -> None:
    """The command starts, also through a link, and uses the Python in its own folder."""
    folder = tmp_path / ODD / "bin"
    folder.mkdir(parents=True)
    (folder / "python").write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    (folder / "openppmc").write_text(environment.COMMAND.format(root=ascii(str(ROOT))))
    for path in folder.iterdir():
        path.chmod(0o755)
    (tmp_path / "link").symlink_to(folder / "openppmc")
    for command in (folder / "openppmc", tmp_path / "link"):
        done = subprocess.run([command, "--help"], cwd="/", capture_output=True, text=True, check=False)
        assert done.returncode == 0 and "move" in done.stdout, done.stderr
