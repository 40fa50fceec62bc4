"""The virtual board as a program: its text after `sim:`, start and end, sleep, waveforms."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from openppmc import sim
from openppmc.host import Ppmc104
from openppmc.sim.common.build import find_root

from .fixtures import PATIENCE, ROOT, SETUP, StartBoard, Wait

PYTHON = (sys.executable, "-m", "openppmc.sim")


def alive(pid: int) -> bool:
    """Return whether a process exists and is not a zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("colour=red", "unknown word 'colour'"),
        ("start", "word=value"),
        ("start=1.5", "whole number"),
        ("alarm=20..10", "must not exceed"),
        ("cw=-500", "CW limit"),
        ("speed=0", "speed=0"),
        ("speed=fast", "speed=fast"),
        ("clk=7999999", "clk="),
        ("xtal=nan", "xtal=nan"),
        ("timing=SLOW", "timing=SLOW"),
        ("vcd_for=5", "add vcd=FILE"),
        ("vcd=/no/such/folder/x.vcd", "not a file"),
        (f"start={1 << 31}", "outside"),
    ],
)
def test_bad_text(text: str, expected: str) -> None:
    """Each mistake in the text after `sim:` raises ValueError with one line; for an unknown word, the line
    lists the known words.
    """
    with pytest.raises(sim.SpecError) as caught:
        sim.start(text)
    message = str(caught.value)
    assert isinstance(caught.value, ValueError) and expected in message and "\n" not in message
    if "unknown" in expected:
        assert "slow_ccw" in message and "vcd_from" in message


def test_needs_a_checkout(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """If the folder does not contain the project, the error states this."""
    monkeypatch.setenv("OPENPPMC_ROOT", str(tmp_path))
    with pytest.raises(sim.SimError, match="no checkout of OpenPPMC"):
        find_root()
    monkeypatch.setenv("OPENPPMC_ROOT", str(ROOT))
    assert find_root() == ROOT


def test_close_ends_the_program(start_board: StartBoard) -> None:
    """close() leaves no process behind and may be called twice."""
    board = start_board()
    pid = board.process.pid
    board.close()
    board.close()
    assert not alive(pid)
    with pytest.raises(sim.SimError):
        board.status()


def test_dies_with_its_parent(until: Wait) -> None:
    """If the parent process is killed, its board ends, too."""
    code = "import time; from openppmc import sim"
    code += "; board = sim.start(); print(board.process.pid, flush=True); time.sleep(60)"
    parent = subprocess.Popen([sys.executable, "-c", code], cwd=ROOT, stdout=subprocess.PIPE, text=True)
    assert parent.stdout is not None
    pid = int(parent.stdout.readline())
    assert alive(pid)
    parent.kill()
    parent.wait()
    parent.stdout.close()
    until(lambda: not alive(pid), "end of the board", 10)


def test_foreground(tmp_path: Path, until: Wait) -> None:
    """`make board` prints the port, keeps a link to it, and ends with Ctrl-C without a traceback."""
    link = tmp_path / "board"
    process = subprocess.Popen(
        [*PYTHON, f"start=700,link={link}"],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # In a background job SIGINT is ignored, and child processes inherit this.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    try:
        until(link.is_symlink, "link to the port")
        with Ppmc104.open(str(link)) as axis:
            axis.initialise(**SETUP)
            assert axis.move(5).complete
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=PATIENCE)
    finally:
        process.kill()
    assert process.returncode == 0 and "Traceback" not in err
    assert f"openppmc --port {link} info" in out and "position      700" in out
    assert not link.is_symlink()


def test_foreground_bad_text() -> None:
    """A mistake on the command line prints one line and exits with status 1."""
    done = subprocess.run([*PYTHON, "cw=x"], cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 1 and done.stderr.startswith("error: cw=x") and done.stderr.count("\n") == 1


def cpu_seconds(pid: int) -> float:
    """Return the CPU time that a process has used."""
    words = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def test_sleeps_at_rest(start_board: StartBoard, until: Wait) -> None:
    """An idle board uses no CPU time, although board time continues; the first byte wakes it up."""
    board = start_board()
    with Ppmc104.open(board.port) as axis:
        axis.initialise(**SETUP)
        axis.move(10)
        until(lambda: board.status().asleep, "sleep")
        used, begin = cpu_seconds(board.process.pid), board.status().seconds
        time.sleep(1.0)
        assert cpu_seconds(board.process.pid) - used < 0.2
        assert 0.7 < board.status().seconds - begin < 3
        assert axis.move(10).position == 20
        assert not board.status().asleep


def test_not_faster_than_real_time(board: sim.SimBoard) -> None:
    """The board is not faster than real time."""
    first, begin = board.status(), time.monotonic()
    time.sleep(0.5)
    wall, last = time.monotonic() - begin, board.status()
    assert not last.asleep and last.seconds - first.seconds <= wall + 0.05


def test_slow_motion(start_board: StartBoard) -> None:
    """With speed=0.05 the board runs at a twentieth of real time."""
    board = start_board("speed=0.05")
    first, begin = board.status(), time.monotonic()
    time.sleep(1)
    ratio = (board.status().seconds - first.seconds) / (time.monotonic() - begin)
    assert 0.03 < ratio < 0.06


def test_vcd_window(start_board: StartBoard, tmp_path: Path, until: Wait) -> None:
    """The waveform file covers exactly the requested milliseconds, with both clock edges and the
    RTL's names.
    """
    file = tmp_path / "board.vcd"
    board = start_board(vcd=file, vcd_from=5, vcd_for=2)
    until(lambda: board.status().seconds > 0.02, "end of the window")
    board.close()
    text = file.read_text()
    times = [int(stamp) for stamp in re.findall(r"^#(\d+)$", text, re.M)]
    assert times[0] == 5_000_000_000 and times[-1] == 7_000_000_000 - 62_500
    assert len(times) == 2 * 16_000
    for name in ("uart_rxd", "pout_n", "u_part", "u_bridge"):
        assert re.search(rf"\b{name}\b", text)


def test_log_cannot_be_written(start_board: StartBoard) -> None:
    """If the log cannot be written, the start fails; there is no board without a log."""
    with pytest.raises(sim.SimError, match="cannot write"):
        start_board(log="/proc/openppmc.txt")
