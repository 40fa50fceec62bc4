"""Signals to real processes while a motor moves: the motor decelerates, and the exit status is 128 + n."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from random import Random
from types import FrameType

import pytest

from openppmc.host import OutOfRange, Pmc006, Ppmc104, stop_on_signals

pty = pytest.importorskip("pty", reason="Windows sends no signals to other processes")

LIBRARY = """
import sys, time
from openppmc.host import Ppmc104, stop_on_signals
with Ppmc104.open("model:speed=1,part=ppmc104") as axis:
    axis.initialise(1000, {high}, {ramp})
    with stop_on_signals(axis, seconds={seconds}):
        motion = axis.jog(0, high=True)
        print("moving", flush=True)
        {body}
print("not reached")
"""


def started(
    command: list[str], ready: str, before: Callable[[], object] | None = None
) -> subprocess.Popen[str]:
    """Start a process and wait until it has printed the line `ready`."""

    def prepare() -> None:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_DFL)
        if before is not None:
            before()

    process = subprocess.Popen(
        [sys.executable, *command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=prepare,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )
    assert process.stdout is not None
    for line in process.stdout:
        if line.strip() == ready:
            return process
    raise AssertionError(f"{process.communicate()} without {ready}")


def library(body: str, high: int = 5000, ramp: int = 100, seconds: float = 10) -> list[str]:
    text = LIBRARY.format(body=textwrap.indent(body, " " * 8).strip(), high=high, ramp=ramp, seconds=seconds)
    return ["-c", text]


LOOPS = [
    "motion.wait()",
    "while True: time.sleep(0.01)",
    "while True: axis.position",
    "axis.halt(); list(axis.moves([30, -30] * 100_000))",
    "axis.halt(); list(axis.moves([300, -300] * 100_000))",
]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize("body", LOOPS)
def test_a_signal_in_a_program(number: signal.Signals, body: str) -> None:
    process = started(library(body), "moving")
    time.sleep(0.3)
    process.send_signal(number)
    out, err = process.communicate(timeout=30)
    assert process.returncode == 128 + number and out == ""
    word = "interrupted" if number == signal.SIGINT else number.name
    # Between two moves of a queue, the signal finds no motion.
    ends = ["stopped", "nothing was moving"] if "moves" in body else ["stopped"]
    assert err.startswith(tuple(f"{word}: {end}, position " for end in ends)) and err.count("\n") == 1


@pytest.mark.parametrize(
    "kind, switches", [(Ppmc104, ",cw=9000000,slow_cw=8000000"), (Pmc006, ",high=9000000")]
)
def test_handlers_that_raise_at_any_time_leave_the_model_whole(
    kind: type[Ppmc104] | type[Pmc006], switches: str
) -> None:
    random = Random(1)

    def raises(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    with kind.open(f"model:speed=max{switches}") as axis:
        if isinstance(axis, Ppmc104):
            axis.initialise(1000, 5000, 100)
        motion = axis.jog(1 if isinstance(axis, Pmc006) else 0)
        before = signal.signal(signal.SIGALRM, raises)
        try:
            for _ in range(200):
                with suppress(KeyboardInterrupt):
                    signal.setitimer(signal.ITIMER_REAL, random.uniform(0.0002, 0.004))
                    while True:
                        axis.position  # noqa: B018
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        axis.stop(wait=False)
        end = motion.wait(10)
        assert end.position == axis.position > 0


def interrupted_at(call: int, action: Callable[[], object]) -> bool:
    """Run an action, and raise KeyboardInterrupt at this call of a function of the host library.

    Return False if the action has fewer calls. Calls of generators do not count: Python ignores an exception
    that is raised while it closes one.
    """
    left = call

    def trace(frame: FrameType, event: str, argument: object) -> None:
        nonlocal left
        counts = str(frame.f_globals.get("__name__")).startswith("openppmc.host")
        left -= counts and frame.f_code.co_name != "<genexpr>"
        if counts and left == 0:
            raise KeyboardInterrupt

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        action()
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
    return False


@pytest.mark.parametrize("kind", [Ppmc104, Pmc006])
def test_a_handler_that_raises_at_any_call_leaves_the_link_ready(kind: type[Ppmc104] | type[Pmc006]) -> None:
    with kind.open("model:speed=max") as axis:
        call = 1
        while interrupted_at(call, lambda: axis.position):
            assert axis.position == 0, call
            call += 1
    assert call > 10


def test_what_decelerates_for_too_long_is_stopped_at_once() -> None:
    process = started(library("motion.wait()", 1100, 4000, seconds=0.5), "moving")
    time.sleep(1)
    process.send_signal(signal.SIGTERM)
    _, err = process.communicate(timeout=30)
    assert process.returncode == 143 and err.startswith("SIGTERM: stopped immediately after 0.5 s, position ")


def test_the_second_signal_stops_at_once() -> None:
    process = started(library("motion.wait()", 1100, 4000), "moving")
    time.sleep(1)
    begin = time.monotonic()
    process.send_signal(signal.SIGTERM)
    time.sleep(0.2)
    process.send_signal(signal.SIGTERM)
    _, err = process.communicate(timeout=30)
    assert process.returncode == 143 and err.startswith("SIGTERM: stopped immediately, position ")
    assert time.monotonic() - begin < 3


def test_nohup_stays_in_force() -> None:
    ignore = lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN)  # noqa: E731
    process = started(library("axis.stop(); print('end', flush=True); time.sleep(1)"), "moving", ignore)
    process.send_signal(signal.SIGHUP)
    out, err = process.communicate(timeout=30)
    assert process.returncode == 0 and out == "end\nnot reached\n" and err == ""


def test_a_block_that_ends_restores_the_handlers() -> None:
    before = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)]
    with stop_on_signals():
        assert signal.getsignal(signal.SIGTERM) not in before
    assert [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)] == before
    with pytest.raises(OutOfRange, match="seconds 0 is not more than 0"), stop_on_signals(seconds=0):
        pass


COMMAND = """
import sys
from openppmc.cli import main
from openppmc.cli.common.session import Guard
progress, said = Guard.progress, []
def moving(self, now):
    if now.made and not said:
        said.append(print("moving", flush=True))
    progress(self, now)
Guard.progress = moving
sys.exit(main(sys.argv[1:]))
"""
"""The command line, changed so that it prints a line at the first progress message."""
COMMANDS = {
    "ppmc104": ["--part", "ppmc104", "jog", "cw", "--ramped"],
    "ppmc2104": ["--part", "ppmc2104", "move", "400000", "-300000"],
    "stmc": ["--part", "stmc", "move", "400000"],
    "ppmc312": ["--part", "ppmc312", "jog", "cw"],
    "bank": ["--part", "bank", "move", "400000", "-300000"],
    "pmc006": ["--part", "pmc006", "move", "400000"],
    "script": ["script", "moves.txt"],
    "home": ["home", "--direction", "cw"],
}


FREE = dict.fromkeys(COMMANDS, ",ccw=-900000,slow_ccw=-800000,cw=900000,slow_cw=800000") | {
    "pmc006": ",start=0"
}
"""Options that put the switches at positions that no motor reaches."""
for _name, _axes in (("ppmc2104", [2]), ("bank", [2])):
    for _axis in _axes:
        FREE[_name] += f",ccw{_axis}=-900000,slow_ccw{_axis}=-800000,cw{_axis}=900000,slow_cw{_axis}=800000"


@pytest.mark.parametrize("name", COMMANDS)
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_a_signal_in_a_command(name: str, number: signal.Signals, tmp_path: Path) -> None:
    words = COMMANDS[name]
    if name == "script":
        file = tmp_path / "moves.txt"
        file.write_text("init\nmove 400000\n")
        words = ["script", str(file)]
    process = started(["-c", COMMAND, "--port", f"model:speed=1{FREE[name]}", *words], "moving")
    process.send_signal(number)
    _, err = process.communicate(timeout=40)
    word = "interrupted" if number == signal.SIGINT else number.name
    assert process.returncode == 128 + number, err
    last = err.splitlines()[-1]
    assert last.startswith(f"{word}: stopped, ") and "position " in last


@pytest.mark.parametrize("delay", [0.1, 0.2, 0.4, 0.7])
def test_an_interrupt_during_the_start_is_one_line(delay: float) -> None:
    """An interrupt while the command starts produces exactly one line."""
    code = (
        "import openppmc.cli as c, sys; print('on', flush=True); "
        "sys.exit(c.main(['--port', 'model:speed=1', 'jog', 'cw']))"
    )
    process = started(["-c", code], "on")
    time.sleep(delay)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=30)
    assert process.returncode == 130 and err.startswith("interrupted") and err.count("\n") == 1, err


def test_a_closed_terminal() -> None:
    """After the terminal is closed, SIGHUP ends the command with status 129, although it cannot print any
    more.
    """
    child, master = pty.fork()
    if child == 0:
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
        os.execv(sys.executable, [sys.executable, "-c", COMMAND, "--port", "model:speed=1", "jog", "cw"])
    heard = b""
    while b"moving" not in heard:
        heard += os.read(master, 1000)
    os.close(master)
    _, status = os.waitpid(child, 0)
    assert os.waitstatus_to_exitcode(status) == 129
