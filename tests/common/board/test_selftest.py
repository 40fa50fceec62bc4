"""`openppmc selftest` on the virtual board finds no difference for any device, detects faults in the RTL, and
reports errors.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc import parts
from openppmc.host.link import Link
from openppmc.host.script import Script
from openppmc.host.selftest.plan import REGISTERS, PartAccess, Section
from openppmc.host.selftest.ppmc104 import PLAN
from openppmc.host.selftest.run import TRIES, SelfTest

from ..slow import slow_if
from .fixtures import PATIENCE, CommandLine, StartBoard, Wait, one_line

LONG = 20 * PATIENCE
"""Maximum duration in seconds of a whole self-test with its build on a busy computer."""
OTHERS = [row.name for row in parts.having("selftest") if row.name != "ppmc104"]
FAULTS = {
    "pulse one cycle longer": (
        "rtl/motion/ppmc_pulse_shaper.sv",
        "(WidthCycles - 2, Width)",
        "(WidthCycles - 1, Width)",
        "s",
    ),
    "limit pin turned over": (
        "rtl/ppmc104/ppmc104_carrier.sv",
        ".l1_n (in_l1_n),",
        ".l1_n (!in_l1_n),",
        "d_o",
    ),
}


def selftest(port: str, out: Path, *words: str, root: Path = ROOT) -> tuple[int, str, str]:
    """Run a self-test on the RTL below `root`; return exit status, standard output and standard error."""
    env = {**os.environ, "OPENPPMC_ROOT": str(root), "PYTHONPATH": str(ROOT)}
    command = [
        sys.executable,
        "-m",
        "openppmc.cli",
        "--port",
        port,
        "selftest",
        "--yes",
        "--out",
        str(out),
        *words,
    ]
    done = subprocess.run(command, env=env, text=True, capture_output=True, timeout=LONG, check=False)
    return done.returncode, done.stdout, done.stderr


def changed_tree(root: Path, file: str, old: str, new: str) -> Path:
    """Copy the RTL and the files that the virtual board needs, replace one text in the copy; return
    the copy.
    """
    for folder in ("rtl", "tb"):
        shutil.copytree(ROOT / folder, root / folder)
    text = (root / file).read_text()
    assert text.count(old) == 1
    (root / file).write_text(text.replace(old, new))
    return root


@pytest.mark.slow
def test_whole_and_clean(tmp_path: Path) -> None:
    """On the unchanged RTL, thousands of edges are compared without a difference, and the page
    reports this.
    """
    code, out, err = selftest("sim:speed=max", tmp_path)
    assert code == 0, out + err
    page = json.loads((tmp_path / "selftest.json").read_text())
    last = out.splitlines()[-1]
    assert last == f"{page['edges']} edges compared on your virtual board, 0 differences"
    assert page["edges"] > 5000 and page["differences"] == 0
    assert page["bitstream"]["version"] == page["package"] and page["bitstream"]["source"]
    assert {one["kind"] for one in page["sections"]} == {"registers", "commands", "moves"}
    assert [one for one in page["sections"] if one["result"] != "no difference"] == []
    assert sum(one["pulses"] for one in page["sections"]) > 300
    assert (tmp_path / "selftest.txt").read_text().strip().endswith(last)


@pytest.mark.parametrize("part", slow_if(lambda name: name != "stmc", OTHERS))
def test_other_parts(part: str, tmp_path: Path) -> None:
    """For every other device, registers and moves of each kind agree with the golden model."""
    words = ("--only", "registers", "--only", "moves")
    size = ",axes=4" if part == "bank" else ""
    code, out, err = selftest(f"sim:part={part},speed=max{size}", tmp_path, *words)
    assert code == 0, out + err
    page = json.loads((tmp_path / "selftest.json").read_text())
    assert page["edges"] > 1000
    assert [one for one in page["sections"] if one["result"] != "no difference"] == []


@pytest.mark.slow
def test_datasheet_timing(tmp_path: Path) -> None:
    """With DATASHEET timing, moves of each kind agree with the golden model, also moves with the external
    clock, which the board generates.
    """
    code, out, err = selftest("sim:part=stmc,speed=max,timing=DATASHEET", tmp_path, "--only", "moves")
    assert code == 0 and out.splitlines()[-1].endswith("0 differences"), out + err
    assert "steps by the clock of the board" in out and "the recorder was full" not in out


@pytest.mark.parametrize("fault", slow_if(lambda name: name.startswith("limit"), FAULTS))
def test_fault_is_found(fault: str, tmp_path: Path) -> None:
    """If one line of RTL is wrong, the self-test finds the fault, reports and draws it, and lists it on the
    page.
    """
    file, good, bad, signal = FAULTS[fault]
    root = changed_tree(tmp_path / "tree", file, good, bad)
    words = ("--only", "registers", "--only", "moves")
    code, out, err = selftest("sim:speed=max", tmp_path / "out", *words, root=root)
    assert code == 1 and "differences" in out, out + err
    page = json.loads((tmp_path / "out/selftest.json").read_text())
    wrong = [one for one in page["sections"] if not one["good"]]
    assert wrong and f": {signal}: expected" in wrong[0]["result"]
    assert out.splitlines()[-1].endswith(f"{len(wrong)} difference{'' if len(wrong) == 1 else 's'}")
    folder = tmp_path / "out" / wrong[0]["folder"]
    assert (folder / "compare.png").stat().st_size > 10_000 and (folder / "compare.vcd").is_file()
    assert "golden model:" in (tmp_path / "out/selftest.txt").read_text()


@pytest.mark.slow
def test_jumpers(tmp_path: Path) -> None:
    """With the two jumper wires, limit and origin act as in the model; without them, the self-test reports
    this.
    """
    wires = (
        "cnp_n, l4_n, l3_n, l2_n, l1_n, clock",
        "cnp_n && auxo[0], l4_n, l3_n, l2_n, l1_n && aux_n, clock",
    )
    root = changed_tree(tmp_path / "tree", "rtl/ppmc104/ppmc104_carrier.sv", *wires)
    code, out, err = selftest("sim:speed=max", tmp_path / "out", "--jumpers", "--only", "switches", root=root)
    assert code == 0, out + err
    page = json.loads((tmp_path / "out/selftest.json").read_text())
    assert [one["result"] for one in page["sections"]] == ["no difference"] * 2
    code, out, err = selftest("sim:speed=max", tmp_path / "none", "--jumpers", "--only", "switches")
    assert code == 0 and out.count("no switch has moved: is the wire there?") == 2, out + err


def test_recorder_too_small(tmp_path: Path) -> None:
    """With a recorder of only 32 records, each section reports that the recorder was full and states what to
    do.
    """
    code, out, _ = selftest("sim:speed=max,record=5", tmp_path, "--only", "registers")
    assert code == 1
    assert "the recorder was full after 32 records: build the bitstream with a larger RECORD" in out


@pytest.mark.parametrize("late", [0, TRIES - 1, TRIES])
def test_recorder_filled_by_a_busy_pc(start_board: StartBoard, tmp_path: Path, late: int) -> None:
    """A section that overflows the recorder is repeated, at most three times in total."""
    tries: list[int] = []

    def play(talk: PartAccess) -> None:
        tries.append(1)
        talk.run(Script().read_many(1, 1 if len(tries) > late else 200))

    told: list[str] = []
    with Link(start_board("record=8").port) as link:
        test = SelfTest(link, PLAN, tmp_path, told.append)
        test.recorder()
        outcome = test.play(Section("status", REGISTERS, play))
    assert len(tries) == min(late + 1, TRIES) and len(told) == len(tries)
    assert bool(outcome.difference) == (late == TRIES) and test.results.outcomes == [outcome]
    assert ("the recorder was full" in told[-1]) == (late == TRIES)


def test_what_cannot_be(openppmc: CommandLine, start_board: StartBoard, tmp_path: Path) -> None:
    """For a missing recorder, another device or a missing --yes, one line is printed and no motor moves."""
    board = start_board()
    words = ("selftest", "--out", str(tmp_path))
    for given, hint in (
        ((*words, "--yes"), "RECORD="),
        (("--part", "stmc", *words, "--yes"), "not a J105 STMC"),
        (words, "RECORD="),
    ):
        code, _, err = openppmc.run(board.port, *given)
        assert code == 1 and one_line(err) and hint in err
    recording = start_board("record=8")
    code, _, err = openppmc.run(recording.port, *words)
    assert code == 1 and one_line(err) and "--yes" in err
    assert recording.status().pulses == 0


def test_unplugged(openppmc: CommandLine, start_board: StartBoard, until: Wait, tmp_path: Path) -> None:
    """If the board disappears during the self-test, the program soon prints one line and ends."""
    board = start_board("record=13")
    process = openppmc.begin(board.port, "selftest", "--yes", "--out", str(tmp_path), "--only", "moves")
    until(lambda: board.status().pulses > 3, "the first move")
    board.process.kill()
    begin = time.monotonic()
    _, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1 and one_line(err), err
    assert time.monotonic() - begin < PATIENCE / 2
