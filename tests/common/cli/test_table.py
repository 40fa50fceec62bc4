"""The table of commands, from which `--help` is printed without an import of the commands, is correct."""

from __future__ import annotations

import inspect
import subprocess
import sys
from collections import Counter

import pytest
import typer
from typer.testing import CliRunner

from cocotb_tests.harness.paths import ROOT
from openppmc import parts
from openppmc.cli.app import Commands, app
from openppmc.cli.common.group import BRIDGE, Command
from openppmc.host.capabilities import capabilities_of
from openppmc.host.link import DEFAULT_BAUD

ROWS = [pytest.param(row, id=f"{row.name}-{row.parts[0] or 'bridge'}") for row in Commands.rows]


@pytest.mark.parametrize("row", ROWS)
def test_a_row_is_true_of_its_command(row: Command) -> None:
    """The function that a row names can be imported; the first row of a name has the help text that `--help`
    prints.
    """
    found = row.load()
    text = found.info.help if isinstance(found, typer.Typer) else inspect.getdoc(found)
    first = next(one for one in Commands.rows if one.name == row.name)
    assert row.help == (" ".join(text.split()) if row is first else "")
    made = row.build()
    assert made.name == row.name and made.help.split() == text.split()
    assert made.context_settings.get("ignore_unknown_options", False) == row.numbers


def test_every_command_of_a_part_has_a_row() -> None:
    """A device has each command name only once; every device on a line has commands; `--help` lists all
    names.
    """
    counts = Counter((part, row.name) for row in Commands.rows for part in row.parts)
    assert {*counts.values()} == {1}
    assert {part for part, _ in counts} == {BRIDGE, *(row.name for row in parts.having("line"))}
    shown = CliRunner().invoke(app, ["--help"], env={"COLUMNS": "200"}).output
    for row in Commands.rows:
        assert f" {row.name} " in shown and row.help in shown


def test_options_in_front_state_what_the_library_has() -> None:
    """The help of --baud states the default rate of the link, and the field `axes` of a row is the number of
    axes of the device.
    """
    shown = CliRunner().invoke(app, ["--help"], env={"COLUMNS": "200"}).output
    assert f"line rate in bit/s ({DEFAULT_BAUD};" in shown
    rows = parts.having("number", "capabilities")
    assert {row.name: row.axes for row in rows} == {row.name: capabilities_of(row.name).axes for row in rows}


def test_a_misspelt_command_gets_the_nearest() -> None:
    """For a misspelt command, the most similar command of all devices is suggested."""
    for wrong, near in (("mvoe", "move"), ("scna", "scan"), ("reset-flag", "reset-flags")):
        result = CliRunner().invoke(app, [wrong])
        assert result.exit_code == 2 and f"Did you mean '{near}'" in " ".join(result.output.split())


def test_help_is_that_of_typer() -> None:
    """The help equals that of typer's own formatter, and all modules of rich can be used after it."""
    code = "from openppmc.cli import main; main(['--help'])"
    after = "; import rich.markdown, rich.traceback; rich.markdown.Markdown('x').parsed; rich.traceback.Stack"
    made = [
        subprocess.run([sys.executable, "-c", text], cwd=ROOT, capture_output=True, text=True, check=True)
        for text in (code + after, f"import typer.rich_utils; {code}")
    ]
    assert made[0].stdout == made[1].stdout != ""
