"""A command line for every command of every part, and a process that runs them with a broken stdout."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import typer

from cocotb_tests.harness.paths import ROOT
from openppmc import parts
from openppmc.cli.common.app import app

MODEL = ("--port", "model:speed=max")
SERIAL, PMC006 = ("--part", "ppmc312-serial"), ("--part", "pmc006")
LINES: dict[str, tuple[str, ...]] = {"": (), "ppmc312-serial": SERIAL, "pmc006": PMC006}


def _short() -> dict[str, dict[str, str]]:
    """Part ("": one behind the bridge), command, its arguments; {…}: files of `files`."""
    return {
        "": {
            "ports": "",
            "info": "",
            "init": "",
            "move": "20",
            "jog": "cw --seconds 0.1",
            "home": "--fast",
            "stop": "",
            "status": "",
            "monitor": "--count 2 --every 0.05",
            "plan": "1000",
            "table": "",
            "script": "{script}",
            "selftest": "--yes",
            "decode": "{capture} --compare",
        },
        "ppmc312-serial": {
            "scan": "",
            "poll": "--count 2",
            "status": "--axis 0-2",
            "reset": "--axis 1",
            "init": "--axis 1",
            "move": "20 --axis 1",
            "jog": "cw --axis 1 --seconds 0.1",
            "home": "--axis 1 --fast",
            "stop": "--axis 1",
            "info": "--axis 1",
            "monitor": "--axis 1 --count 2",
            "script": "{stations}",
            "ports": "",
            "plan": "1000",
            "decode": "{capture}",
        },
        "pmc006": {
            "move": "20",
            "jog": "forward --seconds 0.1",
            "speed": "800",
            "stop": "",
            "home": "--speed 3000 --slow 1000",
            "scan": "",
            "info": "",
            "status": "",
            "monitor": "--count 2",
            "script": "{controllers}",
            "set": "current microsteps",
            "io": "gpo1=1",
            "address": "3",
            "save": "--yes",
            "reset-flags": "",
            "ports": "",
            "decode": "{capture}",
            "program assemble": "{program}",
            "program disassemble": "{image}",
            "program load": "{program}",
            "program read": "",
            "program burn": "--yes",
            "program run": "",
            "program halt": "",
            "program try": "",
            "program state": "",
        },
    }


def lines(files: dict[str, Path]) -> dict[str, list[str]]:
    """Command lines by name. files: for the braces above; `image` need not be there."""
    found = {}
    for part, commands in _short().items():
        for name, text in commands.items():
            arguments = [word.format_map(files) for word in text.split()]
            found[f"{part} {name}".strip()] = [*MODEL, *LINES[part], *name.split(), *arguments]
    found["info of the bank"] = [*MODEL, "--part", "bank", "status"]
    found["table of a PPMC-312"] = [*MODEL, "--part", "ppmc312", "table"]
    return found


def _names(command: Any, before: str = "") -> Iterator[str]:
    """The commands of a group, those of groups in it after its name."""
    for name, one in command.commands.items():
        yield from _names(one, f"{name} ") if hasattr(one, "commands") else [before + name]


def unknown() -> set[str]:
    """Commands that have no line above."""
    groups = {"": typer.main.get_command(app)}
    for row in parts.having("commands"):
        groups[row.name] = typer.main.get_command(row.load("commands"))
    return {
        f"{part} {name}".strip()
        for part, group in groups.items()
        for name in _names(group)
        if name not in _short().get(part, {})
    }


CHILD = """
import json, os, sys
from openppmc.cli import main
import openppmc.cli.common.app
mode, lines = sys.argv[1], json.load(sys.stdin)
for name, words in lines.items():
    seen, out = os.pipe()
    child = os.fork()
    if child == 0:
        os.dup2(out, 2)
        if mode == "full":
            os.dup2(os.open("/dev/full", os.O_WRONLY), 1)
        elif mode == "closed":
            os.close(1)
            sys.stdout = sys.__stdout__ = None
        else:
            read, write = os.pipe()
            os.dup2(write, 1)
            os.close(read), os.close(write)
        sys.exit(main(words))
    os.close(out)
    with os.fdopen(seen, encoding="utf-8") as said:
        text = said.read()
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    print(json.dumps([name, code, text]), flush=True)
"""


def broken(mode: str, commands: dict[str, list[str]], folder: Path) -> Iterable[tuple[str, int, str]]:
    """Name, exit code, stderr of each command with a stdout that is full, closed or a pipe to no reader."""
    env = {**os.environ, "OPENPPMC_STATE": str(folder), "PYTHONUTF8": "0", "OPENPPMC_DEBUG": ""}
    done = subprocess.run(
        [sys.executable, "-c", CHILD, mode],
        input=json.dumps(commands),
        cwd=ROOT,
        env=env,
        text=True,
        capture_output=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    rows = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(rows) == len(commands)
    return [(name, code, text) for name, code, text in rows]
