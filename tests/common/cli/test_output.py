"""Output of all commands: in any encoding, on a narrow terminal, to a stdout that is full, closed or
unread.
"""

from __future__ import annotations

import doctest
import io
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from cocotb_tests.harness import project
from cocotb_tests.harness.paths import ROOT
from openppmc import streams
from openppmc.cli import main
from openppmc.cli.common import output, session
from openppmc.host import Ppmc104
from tests.common.cli import all_commands

FAULT = "fault of this program"
ENCODINGS = ("ascii", "latin-1", "cp1252", "cp437", "cp864")
NARROW = 40
posix = pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs fork and /dev/full")


@pytest.fixture(autouse=True)
def _environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OPENPPMC_STATE", str(tmp_path / "state"))
    for name in ("OPENPPMC_PORT", "OPENPPMC_PART", "OPENPPMC_LINE", "OPENPPMC_ADDRESS"):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture
def commands(tmp_path: Path) -> dict[str, list[str]]:
    """Return a command line for every command."""
    return all_commands.lines(all_commands.files(tmp_path))


@pytest.fixture(autouse=True)
def no_console() -> Iterator[None]:
    """Remove the console after each test, because it keeps text that a broken stdout did not accept."""
    yield
    vars(output).pop("console", None)


def printed(
    words: list[str], encoding: str, columns: int = 200, run: Callable[[list[str]], int] = main
) -> tuple[int, str, str]:
    """Return exit status, stdout and stderr of a command with this encoding.

    Args:
        run: function that runs the command.
    """
    both = [io.TextIOWrapper(io.BytesIO(), encoding) for _ in range(2)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("COLUMNS", str(columns))
        patch.delattr(output, "console", raising=False)
        patch.setattr(sys, "stdout", both[0])
        patch.setattr(sys, "stderr", both[1])
        code = run(words)
    out, err = (stream.detach().getvalue().decode(encoding) for stream in both)
    return code, out, err


def test_the_list_of_commands_is_complete() -> None:
    """The list that the following tests use contains every command of every device."""
    assert all_commands.without_line() == set()


def test_every_command_in_ascii_on_a_narrow_terminal(commands: dict[str, list[str]]) -> None:
    """In ASCII on 40 columns, every command and its help print the same words as in UTF-8 on 200 columns."""
    for name, words in commands.items():
        for line in (words, [*words, "--help"]):
            code, out, err = printed(line, "utf-8")
            assert code == (0 if "--help" in line else all_commands.REJECTED.get(name, 0)), (name, err)
            narrow = printed(line, "ascii", NARROW)
            assert narrow[0] == code, (name, narrow)
            assert not re.search(r"\\[ux]\w", narrow[1]), (name, narrow)
            # A word longer than a line is cut. Narrow help omits the titles of panels and the type bool.
            wanted = re.findall(r"\w+", streams.readable(re.sub(r"╭.*|\bbool\b", "", out), "ascii"))
            got = re.sub(r"\s", "", narrow[1])
            assert not [word for word in wanted if word not in got], (name, narrow[1])
            if "--help" in line:
                assert max(map(len, narrow[1].splitlines())) <= NARROW, (name, narrow[1])


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_text_in_every_encoding(
    encoding: str, commands: dict[str, list[str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Results, help and errors that contain rare characters are printed in each encoding."""
    monkeypatch.chdir(tmp_path)
    code, out, _ = printed(["--help"], encoding)
    assert code == 0 and ("sim:…" if encoding in ("cp1252",) else "sim:...") in out
    code, out, _ = printed(commands["decode"], encoding)
    assert code == 0 and " -> ready, nothing pending" in out
    assert ("tolerance 10 us" if encoding in ("ascii", "cp864") else "tolerance 10 µs") in out
    code, out, _ = printed(commands["pmc006 set"][:-2] + ["acceleration", "attenuation"], encoding)
    assert code == 0 and ("steps/s^2" if encoding in ("ascii", "cp864") else "steps/s²") in out
    assert ("50 \u066a of" if encoding == "cp864" else "50 % of") in out
    code, _, err = printed(["script", "日本 → é\udcff.txt"], encoding)
    assert code == 1 and err.startswith(r"error: \u65e5\u672c -> ") and err.count("\n") == 1, err


def test_scripts_of_the_project_print_in_ascii() -> None:
    """Scripts that use `project.run` (make demo, make bench …) also print in any encoding."""

    def show(words: list[str]) -> int:
        project.console.print(*words, highlight=False)
        return project.fail("≥ 2 µs")

    words = ["✓ building … (1.5 s)", "–", "3 × 2"]
    code, out, err = printed(words, "ascii", run=lambda words: project.run(lambda: show(words)))
    assert (code, out, err) == (1, "ok building ... (1.5 s) - 3 x 2\n", "error: >= 2 us\n")


def test_columns_stay_aligned() -> None:
    """If a character is replaced by a longer text, fewer spaces follow it, so that columns stay aligned."""
    texts = {
        "→ 05  1": "-> 05 1",
        "→→→ 5    1\n→ 5    1": "->->-> 5 1\n-> 5   1",
        " … 1  2": " ... 1 2",
        "é  1": "e  1",
    }
    assert {text: streams.readable(text, "ascii") for text in texts} == texts
    failed, attempted = doctest.testmod(streams)
    assert attempted and not failed


# Command that prints a table -> one of the headings of this table.
TABLES = {
    "ppmc312-serial scan": "line faults",
    "ppmc312-serial status": "line faults",
    "pmc006 scan": "line faults",
    "pmc006 info": "range",
    "status of the bank": "last byte",
    "decode": "first / pps",
}


@pytest.mark.parametrize("name", TABLES)
def test_tables_on_a_narrow_terminal(name: str, commands: dict[str, list[str]]) -> None:
    """On a narrow terminal, each cell of a table is on its own line with its heading, and no cell is cut."""
    wide = printed(commands[name], "utf-8")[1].splitlines()
    narrow = printed(commands[name], "utf-8", NARROW)[1].splitlines()
    table = [line for line in narrow if line not in wide]
    assert max(map(len, table)) <= NARROW
    assert not any("…" in line for line in table)
    assert any(re.match(f"{TABLES[name]}  +\\w", line) for line in table)


def broken(mode: str, words: list[str]) -> tuple[int, str]:
    """Return exit status and stderr of a command whose stdout is full, closed, or a pipe that no process
    reads.
    """
    with ExitStack() as stack, pytest.MonkeyPatch.context() as patch:
        stdout = None
        if mode == "full":
            stdout = stack.enter_context(open("/dev/full", "w"))
        elif mode == "pipe":
            read, write = os.pipe()
            os.close(read)
            stdout = stack.enter_context(open(write, "w"))
        err = io.StringIO()
        patch.setattr(sys, "stdout", stdout)
        patch.setattr(sys, "stderr", err)
        return main(words), err.getvalue()


@posix
@pytest.mark.parametrize("mode", ["pipe", "full", "closed"])
def test_every_command_with_a_broken_stdout(mode: str, commands: dict[str, list[str]]) -> None:
    """A pipe without a reader causes status 141 and no line; a full or closed stdout causes status 1 and one
    line.

    An error of the command itself has precedence; the command then writes nothing to stdout.
    """
    reason = {"full": "No space left on device", "closed": "closed"}.get(mode, "the reader has ended")
    cause = f"error: stdout: cannot be written ({reason})"
    for name, words in commands.items():
        code, err = broken(mode, words)
        errors = [line for line in err.splitlines() if line.startswith("error")]
        assert FAULT not in err and "Traceback" not in err
        if name in all_commands.REJECTED:
            assert (code, len(errors)) == (all_commands.REJECTED[name], 1), (name, err)
            assert "stdout" not in err
            continue
        assert code == (141 if mode == "pipe" else 1), (name, err)
        if name == "pmc006 speed":  # the only command here that leaves its motor running
            assert re.fullmatch(re.escape(cause) + r": stopped, position \d+", errors[0]), (name, err)
        else:
            assert errors == ([] if mode == "pipe" else [cause + "; send it to a file or another program"])


SHELL = {
    "{} --help | head -1": (141, 0),
    "{} --port model: status | head -1": (141, 0),
    "{} ports >&-": (1,),
    "{} ports > /dev/full": (1,),
    "PYTHONUNBUFFERED=1 {} ports > /dev/full": (1,),
    "{} ports 2>&-": (0,),
    "{} ports <&- >&- 2>&-": (1,),
    "{} bogus 2>&-": (2,),
    "{} bogus 2>/dev/full": (2,),
    "PYTHONIOENCODING=ascii {} --help": (0,),
}


@posix
@pytest.mark.parametrize("line", SHELL)
def test_in_a_shell(line: str) -> None:
    """For each redirection in a shell, the exit status is the documented one, and at most one line is
    printed.
    """
    command = f"{sys.executable} -m openppmc.cli"
    done = subprocess.run(
        ["bash", "-c", f"{line.format(command)}; exit ${{PIPESTATUS[0]}}"],
        cwd=ROOT,
        env={**os.environ, "OPENPPMC_DEBUG": ""},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode in SHELL[line], done
    assert done.stderr.count("\n") == (done.returncode in (1, 2) and "2>" not in line), done


@posix
def test_a_motor_stops_when_stdout_is_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    """If stdout breaks while a motor moves, the motor is decelerated before the port is closed."""
    monkeypatch.setattr(session.BOARD, "port", "model:speed=max")
    monkeypatch.setattr(session.BOARD, "part", None)
    motions = []

    def run() -> int:
        with session.opened() as board:
            axis = board.part
            assert isinstance(axis, Ppmc104)
            axis.initialise(start_pps=1000, high_pps=8000, ramp_pulses=100)
            motions.append(axis.jog(1, None, True))
            print("text")
            board.guard.pause(board.part, 1)
        return 0

    with open("/dev/full", "w") as full:
        monkeypatch.setattr(sys, "stdout", full)
        assert streams.guarded(run) == 1
        assert sys.stdout is full
    (motion,) = motions
    assert motion.result is not None and motion.result.cause_text == "stop command"


@posix
def test_a_script_ends_before_its_next_motion(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """After its output could not be written, a script starts no further motion."""
    moves: list[int] = []
    monkeypatch.setattr(Ppmc104, "move", lambda axis, pulses, *_: moves.append(pulses))
    file = tmp_path / "script.txt"
    file.write_text("move 1\nposition\nmove 2\n")
    with open("/dev/full", "w") as full:
        monkeypatch.setattr(sys, "stdout", full)
        assert main(["--port", "model:speed=max", "script", str(file)]) == 1
    assert moves == [1]
