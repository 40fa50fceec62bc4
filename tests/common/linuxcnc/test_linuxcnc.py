"""The component in the HAL of LinuxCNC: halrun with the models and the virtual board, MDI in a machine."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from tests.common.board.fixtures import StartBoard

EXAMPLE = ROOT / "examples" / "linuxcnc"
SYSTEM_PYTHON = Path("/usr/bin/python3")
PATIENCE = 60.0
MISSING = "LinuxCNC is not installed (Debian: apt-get install linuxcnc-uspace)"


@pytest.fixture(scope="module")
def environment(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """Make a Python environment as docs/coming_from.md describes it; return the variables of LinuxCNC.

    Its packages are those of this environment instead of `pip install`. If root runs LinuxCNC,
    RTAPI_UID must name another user for the realtime part, and this user must have access to the folder of
    the FIFO.
    """
    if not shutil.which("halrun") or not SYSTEM_PYTHON.exists():
        pytest.skip(MISSING)
    if Path("/tmp/linuxcnc.lock").exists():
        pytest.skip("LinuxCNC is running; a second one would end it")
    folder = tmp_path_factory.mktemp("linuxcnc")
    venv = folder / "venv"
    subprocess.run([SYSTEM_PYTHON, "-m", "venv", "--system-site-packages", "--without-pip", venv], check=True)
    (site,) = venv.glob("lib/python3*/site-packages")
    packages = [path for path in sys.path if path.endswith("site-packages")]
    (site / "openppmc.pth").write_text("\n".join([str(ROOT), *packages]), encoding="utf-8")
    program = venv / "bin" / "openppmc"
    program.write_text(f'#!/bin/sh\nexec {venv}/bin/python -m openppmc.cli "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    (folder / "home").mkdir()
    variables = {
        **os.environ,
        "PATH": f"{venv}/bin:{os.environ['PATH']}",
        "HOME": str(folder / "home"),
        "OPENPPMC_STATE": str(folder / "state"),
    }
    variables.pop("DISPLAY", None)
    shared = tempfile.mkdtemp()
    if os.geteuid() == 0:
        os.chmod(shared, 0o777)
        variables |= {"RTAPI_UID": "65534", "RTAPI_FIFO_PATH": f"{shared}/fifo"}
    yield variables
    shutil.rmtree(shared)


class Session:
    """A running halrun with one component `tc`."""

    def __init__(self, environment: dict[str, str], log: Path, load: str) -> None:
        self._environment, self._log = environment, log
        file = log.with_suffix(".hal")
        file.write_text(f"loadusr {load}\n", encoding="utf-8")
        with log.open("w", encoding="utf-8") as out:
            self._halrun = subprocess.Popen(
                ["halrun", "-I", "-f", file],
                env=environment,
                stdin=subprocess.PIPE,
                stdout=out,
                stderr=subprocess.STDOUT,
            )

    def halcmd(self, *words: str) -> str:
        """Run halcmd and return its output."""
        command = ["halcmd", *words]
        done = subprocess.run(command, env=self._environment, text=True, capture_output=True, check=False)
        return done.stdout.strip()

    def set(self, pin: str, value: float) -> None:
        """Set a pin or a parameter."""
        self.halcmd("setp", pin, str(value))

    def until(self, pin: str, condition: Callable[[str], bool]) -> str:
        """Wait until the condition is true for the value of a pin, and return this value."""
        end = time.monotonic() + PATIENCE
        while not condition(value := self.halcmd("getp", pin)):
            assert time.monotonic() < end, (pin, value, self._log.read_text(encoding="utf-8"))
            time.sleep(0.05)
        return value

    def close(self) -> str:
        """End halrun, which unloads the component, and return all output."""
        self._halrun.communicate(b"exit\n", timeout=PATIENCE)
        end = time.monotonic() + PATIENCE
        while "SIGTERM: " not in (text := self._log.read_text(encoding="utf-8")):
            assert time.monotonic() < end, text
            time.sleep(0.05)
        return text


def true(value: str) -> bool:
    """Return True if the text of a BIT pin means 1."""
    return value == "TRUE"


def test_group_on_a_model(environment: dict[str, str], tmp_path: Path) -> None:
    """Two armed axes of a bank start together in halrun; the end of halrun decelerates a moving motor."""
    hal = Session(
        environment,
        tmp_path / "bank.log",
        "-Wn tc openppmc --port model: --part bank hal --axes 1-2 --name tc --high 8000 --ramp 2000",
    )
    hal.until("tc.1.position-fb", bool)
    for axis, position in ((1, 20), (2, -5)):
        for name, value in (("scale", 100), ("arm", 1), ("enable", 1), ("position-cmd", position)):
            hal.set(f"tc.{axis}.{name}", value)
    hal.set("tc.group-start", 1)
    hal.until("tc.group-done", true)
    positions = [float(hal.halcmd("getp", f"tc.{axis}.position-fb")) for axis in (1, 2)]
    assert positions == [20, -5] and true(hal.halcmd("getp", "tc.1.in-position"))
    hal.set("tc.1.arm", 0)
    hal.set("tc.1.position-cmd", 350)
    begin = hal.until("tc.1.position-fb", lambda value: float(value) > 100)
    text = hal.close()
    end = int(text.split("axis 1: position ")[1].split(",")[0])
    assert "SIGTERM: stopped, " in text and 100 * float(begin) + 200 < end < 34_000


def test_virtual_board(environment: dict[str, str], start_board: StartBoard, tmp_path: Path) -> None:
    """On the RTL, an axis homes and moves. A lost board is a fault; `reset` opens the port again."""
    board, port = start_board(), tmp_path / "port"
    port.symlink_to(board.port)
    hal = Session(environment, tmp_path / "board.log", f"-W openppmc --port {port} hal")
    hal.until("openppmc.1.position-fb", bool)
    for name, value in (("scale", 10), ("enable", 1), ("home", 1)):
        hal.set(f"openppmc.1.{name}", value)
    hal.until("openppmc.1.homed", true)
    assert float(hal.halcmd("getp", "openppmc.1.position-fb")) == 0
    hal.set("openppmc.1.position-cmd", 123.4)
    hal.until("openppmc.1.position-fb", lambda value: float(value) == 123.4)
    hal.until("openppmc.1.in-position", true)
    board.close()
    hal.until("openppmc.1.fault", true)
    state = {
        name: hal.halcmd("getp", f"openppmc.1.{name}") for name in ("fault-code", "homed", "position-fb")
    }
    assert state == {"fault-code": "2", "homed": "FALSE", "position-fb": "123.4"}
    port.unlink()
    port.symlink_to(start_board().port)
    hal.set("openppmc.1.reset", 1)
    hal.until("openppmc.1.fault", lambda value: value == "FALSE")
    assert float(hal.halcmd("getp", "openppmc.1.position-fb")) == 0
    hal.set("openppmc.1.position-cmd", 20)
    hal.until("openppmc.1.in-position", true)
    text = hal.close()
    assert text.count("fault 2") == 1 and "SIGTERM: nothing was moving, position 200" in text


def test_mdi(environment: dict[str, str], tmp_path: Path) -> None:
    """In a machine, MDI homes and moves the indexer, and waits for the end of each motion before the next
    line.
    """
    machine = tmp_path / "machine"
    shutil.copytree(EXAMPLE, machine)
    (machine / "indexer.tbl").touch()
    routine = machine / "index.ngc"
    text = routine.read_text(encoding="utf-8")
    assert "Q60\n" in text
    # time in s that the last MDI line waits: 4 instead of 60
    routine.write_text(text.replace("Q60\n", "Q4\n"), encoding="utf-8")
    lines = ["M64 P1", "M66 P1 L3 Q60", "o<index> call [7.5]", "o<index> call [2]", "G0 X3"]
    lines.append("o<index> call [100000]")
    quoted = " ".join(f"'{line}'" for line in lines)
    operator = machine / "operator"
    operator.write_text(
        f"#!/bin/sh\nexec python3 {Path(__file__).with_name('mdi.py')} {quoted}\n", encoding="utf-8"
    )
    operator.chmod(0o755)
    ini = machine / "indexer.ini"
    text = ini.read_text(encoding="utf-8")
    assert "DISPLAY = axis\n" in text
    ini.write_text(text.replace("DISPLAY = axis\n", "DISPLAY = ./operator\n"), encoding="utf-8")
    done = subprocess.run(
        ["linuxcnc", "-r", ini],
        cwd=machine,
        env=environment,
        stdin=subprocess.DEVNULL,
        text=True,
        capture_output=True,
        timeout=4 * PATIENCE,
        check=False,
    )
    print(done.stdout, done.stderr)
    states = [line for line in done.stdout.splitlines() if line.startswith((*lines, "message"))]
    assert states == [
        "M64 P1: angle 0, inputs (0, 0, 0), X 0",
        "M66 P1 L3 Q60: angle 0, inputs (0, 1, 0), X 0",
        "o<index> call [7.5]: angle 7.5, inputs (0, 1, 0), X 0",
        "o<index> call [2]: angle 2, inputs (0, 1, 0), X 0",
        "G0 X3: angle 2, inputs (0, 1, 0), X 3",
        "o<index> call [100000]: angle 2, inputs (0, 1, 1), X 3",
        "message:  the indexer has not confirmed its position",
    ]
    assert "indexer: axis 1: fault 6: " in done.stdout + done.stderr
    assert "SIGTERM: nothing was moving, position 800" in done.stdout + done.stderr
