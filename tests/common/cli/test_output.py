"""Output of commands: any encoding, a narrow console, a pipe without a reader, a full or closed stdout."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc import streams
from openppmc.cli import main
from openppmc.cli.common import group, output
from tests.common.capture import sessions
from tests.common.capture.analyser import probe, write_saleae
from tests.common.cli import all_commands

ENCODINGS = ("ascii", "cp1252", "cp437", "latin-1", "cp932")
FAULT = "a fault of this program"


@pytest.fixture
def commands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, list[str]]:
    """A line for every command, with the files that it reads."""
    monkeypatch.setenv("OPENPPMC_STATE", str(tmp_path / "state"))
    for name in ("OPENPPMC_PORT", "OPENPPMC_PART", "OPENPPMC_LINE", "OPENPPMC_ADDRESS"):
        monkeypatch.delenv(name, raising=False)
    files = {name: tmp_path / name for name in ("script", "stations", "controllers", "image")}
    files["program"] = tmp_path / "π.asm"
    files["capture"] = write_saleae(probe(sessions.ppmc104()), tmp_path / "µ→.csv")
    files["script"].write_text("move 5\nwhere\nmove -5\n")
    files["stations"].write_text("axis 1\nmove 5\n")
    files["controllers"].write_text("move 5\n")
    files["program"].write_text("EXTEN on\n")
    assert (
        main(["--part", "pmc006", "program", "assemble", str(files["program"]), "--out", str(files["image"])])
        == 0
    )
    return all_commands.lines(files)


def test_the_table_of_commands_is_complete() -> None:
    """The tests below run every command of every part."""
    assert all_commands.unknown() == set()


def printed(words: list[str], encoding: str, monkeypatch: pytest.MonkeyPatch) -> tuple[int, str, str]:
    """Exit code, stdout and stderr of a command line whose streams have this encoding."""
    streams_of = [io.TextIOWrapper(io.BytesIO(), encoding, "strict", newline="") for _ in range(2)]
    with monkeypatch.context() as patch:
        patch.setattr(sys, "stdout", streams_of[0])
        patch.setattr(sys, "stderr", streams_of[1])
        code = main(words)
        for stream in streams_of:
            stream.flush()
    return code, *(stream.buffer.getvalue().decode(encoding) for stream in streams_of)  # type: ignore[attr-defined]


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_every_command_in_every_encoding(
    encoding: str, commands: dict[str, list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every command has the same exit code in any encoding as in UTF-8, and prints as much."""
    for name, words in commands.items():
        for line in (words, [*words, "--help"]):
            code, out, err = printed(line, "utf-8", monkeypatch)
            assert FAULT not in err, (name, err)
            got = printed(line, encoding, monkeypatch)
            assert got[0] == code and FAULT not in got[2] and "Encode" not in got[2], (name, got)
            assert len(got[1].splitlines()) == len(out.splitlines()), (name, out, got)


@pytest.mark.parametrize(
    ("text", "encoding", "shown"),
    [
        ("a → b, 5 µs, 3 m/s², sim:…", "ascii", "a -> b, 5 us, 3 m/s^2, sim:..."),
        ("a → b, 5 µs, 3 m/s², sim:…", "cp1252", "a -> b, 5 µs, 3 m/s², sim:…"),
        ("Zürich, ½, ≥ 3, 日", "ascii", "Zurich, 1?2, >= 3, ?"),
        ("undecodable \udcff", "utf-8", "undecodable ?"),
        ("日", "cp437", "?"),
    ],
)
def test_characters_that_an_encoding_lacks(
    text: str, encoding: str, shown: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A character that stdout cannot show becomes the nearest ASCII, others stay."""
    target = io.TextIOWrapper(io.BytesIO(), encoding)
    monkeypatch.setattr(sys, "stdout", target)
    streams.prepare()
    print(text, end="", flush=True)
    assert target.buffer.getvalue().decode(encoding) == shown  # type: ignore[attr-defined]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.parametrize("mode", ["pipe", "full", "closed"])
def test_every_command_with_a_broken_stdout(
    mode: str, commands: dict[str, list[str]], tmp_path: Path
) -> None:
    """A reader that has gone means status 141 and no word; a full or closed stdout one line and status 1."""
    helps = {f"{name} --help": [*words, "--help"] for name, words in commands.items()}
    for name, code, said in all_commands.broken(mode, {**commands, **helps}, tmp_path / "state"):
        errors = [line for line in said.splitlines() if line.startswith("error")]
        assert FAULT not in said and "Traceback" not in said and "Exception" not in said, (name, said)
        if name == "selftest" or name == "table":
            assert (code, len(errors)) == (1, 1), (name, said)  # nothing to print: it needs another board
        elif mode == "pipe":
            assert (code, errors) == (streams.PIPE_CLOSED, []), (name, said)
        else:
            reason = {"full": "No space left on device", "closed": "it is closed"}[mode]
            wanted = f"error: stdout: cannot be written ({reason}); send it to a file or to another program"
            assert (code, errors) == (1, [wanted]), (name, said)


SHELL = {
    "{} --help | head -1": (141,),
    "{} --port model:speed=max status | head -1": (0, 141),
    "{} ports >&-": (1,),
    "{} --port model:speed=max status > /dev/full": (1,),
    "{} --port model:speed=max status 2>&-": (0,),
    "{} --port model:speed=max status <&- >&- 2>&-": (1,),
    "{} --port model:foo info 2>&-": (1,),
    "{} --port model:foo info 2>/dev/full": (1,),
    "{} --port model:speed=max init 2>/dev/full": (0,),
}


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize("line", SHELL)
def test_in_a_shell(line: str, tmp_path: Path) -> None:
    """Pipes and streams as a shell makes them: no traceback, a status of the page on the command line."""
    command = f"{sys.executable} -m openppmc.cli"
    done = subprocess.run(
        ["bash", "-c", f"{line.format(command)}; exit ${{PIPESTATUS[0]}}"],
        cwd=ROOT,
        env={**os.environ, "OPENPPMC_STATE": str(tmp_path), "OPENPPMC_PORT": ""},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode in SHELL[line], done
    assert "Traceback" not in done.stderr and FAULT not in done.stderr and done.stderr.count("\n") <= 1


def test_a_motor_is_stopped_when_stdout_breaks(monkeypatch: pytest.MonkeyPatch) -> None:
    """An error of stdout while a motor moves leaves the session: the motor decelerates."""
    from openppmc.cli.common.session import BOARD, opened

    monkeypatch.setattr(BOARD, "port", "model:speed=max")
    with pytest.raises(streams.OutputError), opened() as session:
        axis = session.axis()
        axis.initialise(start_pps=1000, high_pps=8000, ramp_pulses=40)
        motion = axis.jog(ramped=True)
        session.guard.pause(session.part, 0.05)
        assert motion.poll() is not None and motion.end is None
        model = session.part.link.port.board  # type: ignore[attr-defined]
        raise streams.OutputError(OSError(28, "No space left on device"))
    del model


@pytest.mark.parametrize("columns", [40, 60])
def test_narrow_consoles(
    columns: int, commands: dict[str, list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Tables and help on a narrow console fit it, cut no word and lose no column."""
    for name, words in commands.items():
        for line in (words, [*words, "--help"]):
            monkeypatch.setenv("COLUMNS", "200")
            _, wide, _ = printed(line, "utf-8", monkeypatch)
            monkeypatch.setenv("COLUMNS", str(columns))
            _, narrow, _ = printed(line, "utf-8", monkeypatch)
            words_of = [word for word in wide.split() if word.isalnum()]
            lost = [word for word in words_of if word not in "".join(narrow.split())]
            assert not lost, (name, lost, narrow)
            assert narrow.count("…") <= wide.count("…"), (name, narrow)
            if "--help" in line:
                assert max(map(len, narrow.splitlines())) <= columns, (name, narrow)


def test_a_grid_fits_its_console() -> None:
    """A table of many columns has a line for each cell where the columns do not fit."""
    grid = output.Grid(("name", "value", "meaning"), left=("name", "meaning"))
    grid.add_row("max_speed", "1000", "top speed of moves and of free runs")
    grid.add_row("stops", "0", "")
    console = output.Console(width=30, file=io.StringIO())
    console.print(grid)
    lines = [line.rstrip() for line in console.file.getvalue().splitlines()]  # type: ignore[attr-defined]
    assert lines == [
        "name     max_speed",
        "value    1000",
        "meaning  top speed of moves",
        "         and of free runs",
        "",
        "name   stops",
        "value  0",
    ]
    assert group.NARROW > 60
