"""The examples of docs/bank/README.md behave as the page states."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc.cli import main
from openppmc.model.bank.window import GO, INFO, MASK, POSITION, STOP
from scripts.pages.bank import SESSION_AXES

TEXT = (ROOT / "docs/bank/README.md").read_text(encoding="utf-8")
PORT = "model:speed=max,part=bank"


def block(kind: str) -> str:
    """Return the only fenced code block of this language on the page."""
    (found,) = re.findall(rf"^```{kind}\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)
    return str(found)


def test_python_example(capsys: pytest.CaptureFixture[str]) -> None:
    exec(compile(block("python").replace("/dev/ttyUSB0", PORT), "example", "exec"), {})
    printed = capsys.readouterr().out.strip()
    assert f"prints `{printed}`" in TEXT


def test_command_line(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    command, _, expected = block("console").removeprefix("$ openppmc ").partition("\n")
    monkeypatch.setenv("OPENPPMC_PORT", "model:speed=max")
    monkeypatch.setenv("OPENPPMC_STATE", str(tmp_path))
    main(command.split())
    assert capsys.readouterr().out == expected


def test_c_example_compiles(tmp_path: Path) -> None:
    compiler = shutil.which("cc") or shutil.which("gcc") or "g++"
    source = tmp_path / "example.c"
    access = (
        "static uint8_t read_cycle(void *ctx, unsigned a) { (void)ctx; return (uint8_t)a; }\n"
        "static void write_cycle(void *ctx, unsigned a, uint8_t v) { (void)ctx; (void)a; (void)v; }\n"
    )
    head, include, rest = block("c").partition('#include "ppmc_bank.h"\n')
    source.write_text(head + include + access + rest)
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{ROOT / 'drivers/c'}"]
    done = subprocess.run([compiler, *flags, str(source)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("register", "name"), [(POSITION, ""), (MASK, "MASK"), (GO, "GO"), (STOP, "STOP"), (INFO, "INFO")]
)
def test_register_table(register: int, name: str) -> None:
    row = next(line for line in TEXT.splitlines() if line.startswith(f"| 0x{register:X}"))
    assert name in row


def test_sessions_are_of_the_bank_that_they_name() -> None:
    assert f"axis 5 of {SESSION_AXES}, at 100 MHz" in TEXT
    assert TEXT.count("<!-- axis-session -->\n| a |") == TEXT.count("<!-- group-session -->\n| a |") == 1
