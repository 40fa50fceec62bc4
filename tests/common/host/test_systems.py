"""Windows and macOS: the package without POSIX modules, names of ports, stored set-ups, messages.

The tests run on every system. They replace the parts of the system that differ; no test here is a run on
Windows or macOS.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
import serial
from serial.tools import list_ports, list_ports_common

from openppmc import sim
from openppmc.cli import main
from openppmc.cli.common import session
from openppmc.host import PortError, open_port, port, stopping
from openppmc.host.line_port import open_line

ROOT = Path(__file__).resolve().parents[3]
THIS = Path(__file__).relative_to(ROOT).as_posix()
PORTS = ("COM3", "com12", r"\\.\COM10", "/dev/cu.usbserial-1410", "/dev/cu.usbmodem14101", "/dev/ttyUSB0")
IMPORTS = """
import importlib, pkgutil, sys
from tests.common.host.without_posix import block
block()
import openppmc
from openppmc.errors import MissingExtraError
found = pkgutil.walk_packages(openppmc.__path__, "openppmc.")
names = [one.name for one in found if "__main__" not in one.name]
for name in names:
    try:
        importlib.import_module(name)
    except (MissingExtraError, ModuleNotFoundError) as error:
        # The optional packages may be missing here, or may need POSIX modules.
        if name not in ("openppmc.epics", "openppmc.litex", "openppmc.ophyd"):
            raise
print(len(names))
"""
"""Imports each module of the package."""
COMMANDS = """
import sys
from tests.common.host.without_posix import block
block()
from openppmc.cli import main
for words in sys.argv[1:]:
    status = main(words.split())
    if status:
        sys.exit(f"{words}: {status}")
"""
"""Executes several command lines."""


def python(code: str, *words: str, state: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Run a program in a separate process."""
    env = {**os.environ, "OPENPPMC_STATE": str(state)}
    for name in ("OPENPPMC_PORT", "OPENPPMC_PART", "OPENPPMC_LINE"):
        env.pop(name, None)
    return subprocess.run(
        [sys.executable, "-c", code, *words],
        env=env,
        cwd=ROOT,
        encoding="utf-8",
        capture_output=True,
        check=False,
    )


def test_no_module_needs_posix() -> None:
    """Every module of the package can be imported without the modules of POSIX."""
    done = python(IMPORTS)
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) > 150


def test_commands_without_posix(tmp_path: Path) -> None:
    """The commands work on the golden model of every part without the modules of POSIX."""
    moves = [
        "--port model:speed=max move 1000",
        "--port model:speed=max home",
        "--part ppmc2104 --port model:speed=max move 2000 -1500",
        "--part stmc --port model:speed=max move 800",
        "--part ppmc312 --port model:speed=max move 3000",
        "--part bank --port model:speed=max move 2000 -300 0 70",
        "--part ppmc312-serial --port model:speed=max scan",
        "--part pmc006 --port model:speed=max move 2000",
        "plan 5000",
        "--version",
    ]
    done = python(COMMANDS, *moves, state=tmp_path)
    assert done.returncode == 0, done.stderr


def test_tests_of_the_drivers_are_found_without_posix() -> None:
    """The tests that the workflow runs on Windows can be imported there."""
    workflow = (ROOT / ".github/workflows/host.yml").read_text(encoding="utf-8")
    names = re.findall(r"(?<= )tests/[\w./]+", workflow)
    assert len(names) > 10
    code = "import sys, pytest; sys.exit(pytest.main(sys.argv[1:]))"
    words = f"-p tests.common.host.without_posix --confcutdir=tests --co -q --ignore={THIS}"
    done = python(code, "-o", "addopts=", *words.split(), *names)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr


@pytest.mark.parametrize("name", PORTS)
def test_names_of_ports(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A name of Windows, macOS or Linux reaches pyserial unchanged."""
    opened: list[str] = []

    def record(path: str, *_: object, **__: object) -> SimpleNamespace:
        opened.append(path)
        return SimpleNamespace(close=lambda: None)

    monkeypatch.setattr(serial, "Serial", record)
    monkeypatch.setattr(serial, "serial_for_url", record)
    open_port(name).close()
    open_line(name, 9600, "pmc006").close()
    assert opened == [name, name]


def test_a_file_of_windows_in_the_text_of_a_line() -> None:
    """The colon after a drive letter does not end the value of a word in the text of a line."""
    text = r"program=C:\none\shuttle.asm"
    with pytest.raises(PortError, match=re.escape(f"{text}: ")):
        open_line(f"model:{text}", 9600, "pmc006")


def test_ports_in_numerical_order(monkeypatch: pytest.MonkeyPatch) -> None:
    """COM10 is listed after COM9."""
    found = [list_ports_common.ListPortInfo(f"COM{number}") for number in (10, 3, 9)]
    monkeypatch.setattr(list_ports, "comports", lambda: found)
    assert [name for name, _ in port.serial_ports()] == ["COM3", "COM9", "COM10"]


def test_ports_that_cannot_be_listed(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """If the system cannot list its ports, `ports` fails, and the message about a missing port remains."""

    def fail() -> None:
        raise OSError("The handle is invalid")

    monkeypatch.setattr(list_ports, "comports", fail)
    assert main(["ports"]) == 1
    reason = "the serial ports cannot be listed (The handle is invalid); name one with --port"
    assert capsys.readouterr().err.splitlines() == [f"error: {reason}"]
    with pytest.raises(PortError, match=rf"^COM77: no such port; {re.escape(reason)}$"):
        open_port("COM77")


WINDOWS_ERRORS = {
    "could not open port 'COM3': FileNotFoundError(2, 'Not found', None, 2)": "no such port",
    "could not open port 'COM3': PermissionError(13, 'No', None, 5)": "another program has this port open",
    "Cannot configure port. Original message: OSError(22, 'Wrong', None, 87)": "not a serial port",
}
"""Messages of pyserial on Windows, which have no error number -> beginning of the message of this project."""


@pytest.mark.parametrize("text", WINDOWS_ERRORS)
def test_errors_of_windows(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """An error of Windows is reported with its cause, in one line."""

    def fail(*_: object, **__: object) -> None:
        raise serial.SerialException(text)

    monkeypatch.setattr(port, "_WINDOWS", True)
    monkeypatch.setattr(serial, "Serial", fail)
    with pytest.raises(PortError, match=f"^COM3: {WINDOWS_ERRORS[text]}") as error:
        open_port("COM3")
    assert "\n" not in str(error.value)


def test_no_permission_on_macos(monkeypatch: pytest.MonkeyPatch) -> None:
    """On macOS, the message does not name a command of Linux."""

    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setattr(port, "_WINDOWS", False)
    monkeypatch.setattr(serial, "Serial", refuse)
    with pytest.raises(PortError, match=r"no permission: check owner and mode of the device \(ls -l "):
        open_port(__file__)


@pytest.mark.parametrize("system", ["win32", "darwin"])
def test_the_virtual_board_names_what_it_needs(
    system: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """On Windows and macOS, one line states what the port `sim:` needs."""
    monkeypatch.setattr(sys, "platform", system)
    needs = "the virtual board needs Linux with Verilator, make, g++ and perl; use model: instead"
    for start in (sim.start, sim.start_line):
        with pytest.raises(sim.SimError, match=f"^{re.escape(needs)}$"):
            start("")
    for words in (["info"], ["--part", "pmc006", "scan"], ["--part", "ppmc312-serial", "scan"]):
        assert main(["--port", "sim:", *words]) == 1
        assert capsys.readouterr().err.splitlines() == [f"error: sim: {needs}"]


RESERVED = re.compile(r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\.|$)")
"""Names that Windows opens as a device in every folder, also with a suffix."""


@pytest.mark.parametrize("name", PORTS)
def test_stored_setups(name: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The file of a set-up is in the state folder and is not the port itself (COM3.json)."""
    environment = {"LOCALAPPDATA": str(tmp_path / "Local")}
    monkeypatch.setattr(session, "os", SimpleNamespace(name="nt", environ=environment, getpid=os.getpid))
    session.store_setup(name, {"high": 700}, 2)
    session.store_setup(name, {"high": 900})
    assert session.load_setup(name) == {"high": 900} and session.load_setup(name, 2) == {"high": 700}
    files = list((tmp_path / "Local/openppmc").iterdir())
    assert len(files) == 2 and not [file for file in files if RESERVED.match(file.name)]


def test_the_state_folder_without_variables(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without LOCALAPPDATA, or with an empty one, the folder is below the user's folder."""
    for environment in ({}, {"LOCALAPPDATA": ""}):
        monkeypatch.setattr(session, "os", SimpleNamespace(name="nt", environ=environment))
        assert session.state_folder() == Path.home() / "openppmc"


def test_signals_of_each_system() -> None:
    """Ctrl-C and SIGTERM are handled on every system, and Ctrl-Break or SIGHUP where it exists."""
    names = {number.name for number in stopping.SIGNALS}
    assert names >= {"SIGINT", "SIGTERM"}
    assert names & {"SIGHUP", "SIGBREAK"}
