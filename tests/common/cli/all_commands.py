"""Command lines for every command of every device."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from openppmc.cli import main
from openppmc.cli.app import Commands
from tests.common.capture import sessions
from tests.common.capture.analyser import probe, write_saleae

REJECTED = {
    **{"stop": 1, "table": 1, "selftest": 1},
    # Exit status 1: the tests run without LinuxCNC.
    **{"hal": 1, "ppmc312-serial hal": 1, "pmc006 hal": 1},
    # Exit status 2: the prefix of the EPICS records in ARGUMENTS is not ASCII.
    **{"ioc": 2, "ppmc312-serial ioc": 2, "pmc006 ioc": 2},
}
"""Commands that an idle model rejects, with their exit status; they print nothing to stdout."""
# Device -> command -> arguments; the device "" represents all devices behind the bridge. A word in braces is
# a key of the result of `files`.
ARGUMENTS: dict[str, dict[str, str]] = {
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
        "hal": "",
        "ioc": "--prefix µ:",
        "decode": "{ppmc104} --part ppmc104 --compare --timing FAST",
    },
    "ppmc312-serial": {
        "scan": "",
        "poll": "--count 2",
        "status": "--axis 0-2",
        "reset": "--axis 1",
        "init": "--axis 1",
        "move": "20 --axis 1",
        "jog": "cw --axis 1 --seconds 0.1",
        "home": "--axis 1 --search 4000",
        "stop": "--axis 1",
        "hal": "--axes 1",
        "info": "",
        "monitor": "--axis 1 --count 2",
        "script": "{stations}",
        "ioc": "--prefix µ:",
        "ports": "",
        "plan": "1000",
        "decode": "{ppmc312-serial}",
    },
    "pmc006": {
        "move": "20",
        "jog": "forward --seconds 0.1",
        "speed": "800",
        "stop": "",
        "home": "--speed 3000 --slow 1000",
        "hal": "",
        "scan": "",
        "info": "",
        "status": "",
        "monitor": "--count 2",
        "script": "{controllers}",
        "ioc": "--prefix µ:",
        "set": "current microsteps",
        "io": "gpo1=1",
        "address": "3",
        "save": "",
        "reset-flags": "",
        "ports": "",
        "decode": "{pmc006}",
        "program assemble": "{program}",
        "program disassemble": "{image}",
        "program load": "{program}",
        "program read": "",
        "program burn": "",
        "program run": "",
        "program halt": "",
        "program try": "",
        "program state": "",
    },
}


def files(folder: Path) -> dict[str, Path]:
    """Write the input files of the commands; their names contain characters that few encodings have."""
    texts = {
        "script": "move 5\nposition\nmove -5\n",
        "stations": "init axis=1\nmove 5 axis=1\nposition axis=1\n",
        "controllers": "move 5\nposition\n",
        "program": "EXTEN on\n",
    }
    found = {name: folder / f"{name} µ→.txt" for name in texts}
    for name, path in found.items():
        path.write_text(texts[name], encoding="utf-8")
    found["image"] = folder / "image.bin"
    assemble = [
        "--part",
        "pmc006",
        "program",
        "assemble",
        str(found["program"]),
        "--out",
        str(found["image"]),
    ]
    assert main(assemble) == 0
    for part in ("ppmc104", "ppmc312-serial", "pmc006"):
        found[part] = write_saleae(probe(sessions.SESSIONS[part]()), folder / f"{part} µ→.csv")
    return found


def lines(paths: dict[str, Path]) -> dict[str, list[str]]:
    """Return command lines by name: those of all commands, including the commands that single devices add."""
    port = ["--port", "model:speed=max"]
    found = {}
    for part, commands in ARGUMENTS.items():
        for name, text in commands.items():
            words = [str(paths[word[1:-1]]) if word[0] == "{" else word for word in text.split()]
            own = ["--part", part] if part else []
            found[f"{part} {name}".strip()] = [*port, *own, *name.split(), *words]
    found["status of the bank"] = [*port, "--part", "bank", "status"]
    found["table of a PPMC-312"] = [*port, "--part", "ppmc312", "table"]
    return found


def without_line() -> set[str]:
    """Return the commands without a line in ARGUMENTS."""
    return {
        f"{part} {name}".strip()
        for row in Commands.rows
        for part in row.parts
        for name in _names(row.name, row.build())
        if name not in ARGUMENTS.get(part, {})
    }


def _names(name: str, command: Any) -> list[str]:
    """Return the name of the command; for a group, the names of its commands, each after the name of the
    group.
    """
    return [f"{name} {one}" for one in command.commands] if hasattr(command, "commands") else [name]
