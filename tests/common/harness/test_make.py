"""The commands that `make` runs, compared with a stored list, and the error line for each wrong word."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from scripts import env, run
from scripts.fpga.boards.description import load_all
from scripts.targets import OLD, TARGETS, VARIABLES, boards

LIST = re.findall(
    r"^make (.*)\n    (.*)$", (Path(__file__).parent / "make_commands.txt").read_text(encoding="utf-8"), re.M
)
PARTS = "ppmc104,ppmc2104,stmc,ppmc312,ppmc312-serial,bank,pmc006"
WRONG = {
    "tset": "tset: there is no such target; nearest: test (`make help' lists all)",
    "test-litx": "test-litx: there is no such target; nearest: test WITH=litex (`make help' lists all)",
    "demo a:b": "a:b: there is no such target (`make help' lists all)",
    "demo PRT=stmc": "PRT: `make demo' has no such variable; nearest: PART (it has: PART PYTHON)",
    "bitstream CLK_HZ=24000000": "CLK_HZ: `make bitstream' has no such variable (it has: BAUD BOARD HOST",
    "test WITH=ophyd SEED=1": "SEED: `make test WITH=ophyd' has no such variable (it has: J PYTHON T WITH)",
    "test-lab WITH=ophyd": "WITH: `make test WITH=ophyd' has no such variable",
    "prove NIGHT=1 BREAK=1": "BREAK: `make prove NIGHT=1' has no such variable",
    "demo PART=": "PART=: no such part",
    **{
        f"{goal} PART=isa_4axis": f"PART=isa_4axis: no such part (known: {PARTS}{more})"
        for goal, more in (("board", ""), ("bitstream", ""), ("flash", ""), ("demo", ""), ("soak", ",all"))
    },
    "trace PART=ppmc312-serial": "PART=ppmc312-serial: no such part (known: ppmc104,",
    "bitstream BOARD=ulx3s": "BOARD=ulx3s: no such board (known: ",
    "bitstream HOST=spi": "HOST=spi: icebreaker with ppmc104 has only uart,bus; choose one of these",
    "flash HOST=bus BOARD=tangnano9k PART=bank": "HOST=bus: tangnano9k with bank has only uart,spi; choose",
    "demo test T=a,,b": "T=a,,b: expected parts of test names",
    "test T=": "T=: expected parts of test names",
    "prove T=and": "T=and: expected parts of test names",
    "soak SEED=4294967296": "SEED=4294967296: expected a whole number from 0 to 4294967295",
    "fuzz COUNT=0": "COUNT=0: expected a whole number from 1 to 1000000000",
    "test CLK_HZ=16e6": "CLK_HZ=16e6: expected a whole number from 8000000 to 200000000",
    "test J=65": "J=65: expected a whole number from 1 to 64",
    "test J=²": "J=²: expected a whole number from 1 to 64",
    "test WITH=lab": "WITH=lab: expected campaign or ophyd or linuxcnc or litex or fusesoc or versions",
    "test WAVES=yes": "WAVES=yes: expected a whole number from 0 to 1",
    "test PROBE=2": "PROBE=2: expected a whole number from 0 to 1",
    "test JITTER=x": "JITTER=x: expected a whole number from 0 to 1",
    "test MODEL=": "MODEL=: expected a whole number from 0 to 1",
    "test SIM_MAIN=icarus": "SIM_MAIN=icarus: expected own or cocotb",
    "test-verilog SIM=verilator": "SIM=verilator: expected icarus or own or cocotb",
    "worker SCHEDULER=host:8786": "SCHEDULER=host:8786: expected tcp://host:port",
    "worker SCHEDULER=tcp://host:": "SCHEDULER=tcp://host:: expected tcp://host:port",
    "coverage FRESH=2": "FRESH=2: expected a whole number from 0 to 1",
    "mutate QUICK=2": "QUICK=2: expected a whole number from 0 to 1",
    "prove BREAK=2": "BREAK=2: expected a whole number from 0 to 1",
    "prove NIGHT=2": "NIGHT=2: expected a whole number from 0 to 1",
    "bitstream XTAL_HZ=999999": "XTAL_HZ=999999: expected a whole number from 1000000 to 16000000",
    "bitstream XTAL_HZ=20000001 PART=stmc": "XTAL_HZ=20000001: expected a whole number from 1000000 to 2000",
    "bitstream BAUD=3000001": "BAUD=3000001: expected a whole number from 1200 to 3000000",
    "bitstream BAUD=230400 PART=pmc006": "BAUD=230400: expected a whole number from 1200 to 115200",
    "bitstream TIMING=SLOW": "TIMING=SLOW: expected FAST or DATASHEET",
    "bitstream PHASE_IDLE=2": "PHASE_IDLE=2: expected a whole number from 0 to 1",
    "bitstream PHASE_ON=": "PHASE_ON=: expected a whole number from 0 to 1",
    "bitstream READ_MAP=old": "READ_MAP=old: expected SHEET or FAMILY",
    "bitstream RECORD=3": "RECORD=3: expected 0, or 4 to 16",
}
"""Words of a command line -> beginning of the error line."""


@pytest.fixture(autouse=True)
def clean(monkeypatch: pytest.MonkeyPatch) -> None:
    """Remove the variables of a surrounding `make` or shell."""
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)


def make(*words: str, folder: Path = ROOT, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run `make -n` with these words and environment variables."""
    around = {name: value for name, value in os.environ.items() if not name.startswith("MAKE")}
    return subprocess.run(
        ["make", "-n", *words],
        cwd=folder,
        env={**around, **variables},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )


@pytest.mark.parametrize(("line", "command"), LIST, ids=[line for line, _ in LIST])
def test_command(line: str, command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """In a complete environment, a target runs the command of the stored list."""
    monkeypatch.setattr(env, "missing", lambda _: [])
    assert run.plan(line.split()).replace(shlex.quote(sys.executable), "{python}") == command


def test_every_target_and_variable_is_listed() -> None:
    """The stored list contains every target and every variable. The table WRONG has an entry for each
    variable whose values are restricted.
    """
    given = [dict(word.split("=", 1) for word in line.split() if "=" in word) for line, _ in LIST]
    goals = [run.Goal(line.split()[0], values).name for (line, _), values in zip(LIST, given, strict=True)]
    assert set(goals) == set(TARGETS)
    assert {name for values in given for name in values} == set(VARIABLES) - {"PYTHON"}
    wrong = {line.split("=")[0] for line in WRONG.values() if "=" in line.split(":")[0]}
    assert wrong == {name for name, row in VARIABLES.items() if row.values != "any"} | {"SIM"}
    assert set(OLD.values()) <= set(TARGETS)


@pytest.mark.parametrize(("words", "line"), WRONG.items(), ids=WRONG)
def test_wrong_word(words: str, line: str) -> None:
    """A wrong target, variable or value produces its error line, even if it belongs to a later goal of the
    command line.
    """
    with pytest.raises(run.WrongError) as error:
        run.plan(words.split(" "))
    assert str(error.value).startswith(line)
    assert "\n" not in str(error.value)


def test_make_prints_the_line_and_runs_nothing() -> None:
    """make prints only the line of the first fault, and runs no goal before all goals are checked."""
    done = make("demo", "test", "T=a b", "SEED=x")
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    assert re.fullmatch(r"Makefile:\d+: \*\*\* T=a b: expected .*\.  Stop\.", line)


def test_a_value_reaches_the_command_unchanged() -> None:
    """Neither make nor a shell changes a value."""
    value = "a'b\"c`id`  d;e#f|ä\\"
    done = make("replay", f"FILE={value}")
    assert shlex.split(done.stdout)[-1] == value, done.stderr


def test_variables_of_the_environment() -> None:
    """Variables of the environment are used if the target uses them; empty ones are ignored."""
    assert " -n 7 -k a " in make("test", J="7", T="a", COUNT="x", SEED="").stdout
    assert "J=x: expected" in make("test", J="x").stderr


def test_boards_without_yaml() -> None:
    """The boards and hosts that make knows are those of the board descriptions."""
    found: dict[str, dict[str, list[str]]] = {}
    for board in load_all():
        hosts: dict[str, list[str]] = {}
        for on in board.parts:
            hosts.setdefault(on.part, []).extend(on.hosts)
        found |= {device.name: hosts for device in board.devices}
    assert boards() == found


def test_the_old_name_states_the_new_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """`make test-lab` prints a note and runs the command of `make test WITH=ophyd`."""
    monkeypatch.setattr(env, "missing", lambda _: [])
    note, _, command = run.plan(["test-lab", "T=a"]).partition(" >&2; ")
    assert "use `make test WITH=ophyd" in note
    assert command == run.plan(["test", "WITH=ophyd", "T=a"])


def test_the_old_variable_states_the_new_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """`make test INSIDE=1` prints a note and runs the command of `make test PROBE=1`."""
    monkeypatch.setattr(env, "missing", lambda _: [])
    note, _, command = run.plan(["test", "INSIDE=1"]).partition(" >&2; ")
    assert "use PROBE for INSIDE" in note
    assert command == run.plan(["test", "PROBE=1"])


def test_the_environment_is_made_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """Missing groups of packages are installed first; the command runs only if this succeeds."""
    monkeypatch.setattr(env, "missing", lambda groups: [name for name in groups if name != "sim"])
    assert run.plan(["mutate"]).startswith(
        f"{sys.executable} -m scripts.env dev campaign || exit; .venv/bin/"
    )
    assert "scripts.env" not in run.plan(["demo"])


def test_a_tool_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run.shutil, "which", lambda name: None if name == "g++" else name)
    with pytest.raises(run.WrongError, match=r"g\+\+ is not installed: install it with .*apt install g\+\+"):
        run.plan(["demo"])
    assert run.plan(["waves"])


@pytest.mark.parametrize(
    ("python", "said"),
    [("no-such-python", "no-such-python: there is no such program"), ("false", ".venv has Python 3.")],
)
def test_another_python_than_that_of_the_environment(python: str, said: str) -> None:
    """If PYTHON= does not have the version of .venv, this is an error."""
    with pytest.raises(run.WrongError, match=f"PYTHON={python}.*{re.escape(said.split(': ')[-1])}"):
        run.plan(["demo", f"PYTHON={python}"])


@pytest.fixture
def bare(tmp_path: Path) -> Path:
    """Create a folder with only the Makefile and find_python.sh."""
    (tmp_path / "scripts").mkdir()
    for name in ("Makefile", "scripts/find_python.sh"):
        shutil.copy(ROOT / name, tmp_path / name)
    return tmp_path


def test_no_python(bare: Path) -> None:
    """If no Python is new enough, one line states the required version and the program that was requested."""
    (line,) = make("demo", "PYTHON=/no/python3", folder=bare).stderr.splitlines()
    assert "Python 3.10 or newer is needed (/no/python3: not found): install one, or name it with" in line


def test_a_failure_is_not_success(bare: Path) -> None:
    """If run.py itself fails, make fails, too."""
    done = make("test", f"PYTHON={sys.executable}", folder=bare)
    assert done.returncode == 2 and "*** scripts/run.py failed.  Stop." in done.stderr
