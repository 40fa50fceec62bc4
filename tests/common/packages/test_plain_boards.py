"""Boards in plain Verilog for FuseSoC: the settings for edalize, and the launcher of its tools."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import BUILD, ProjectError
from scripts.fpga.flow.board_table import BOARDS
from scripts.fpga.flow.plain import vendor_attributes, with_attributes
from scripts.fpga.packages import plain_boards

LAUNCHER = ROOT / "scripts" / "fpga" / "flow" / "launcher.py"
TYPES = {".pcf": "PCF", ".lpf": "LPF", ".cst": "CST", ".sdc": "SDC"}


def launched(*words: str, folder: Path = ROOT) -> subprocess.CompletedProcess[str]:
    """Run the launcher as edalize's makefile does."""
    command = [sys.executable, str(LAUNCHER), *words]
    return subprocess.run(command, cwd=folder, text=True, capture_output=True, check=False, timeout=300)


def test_core_has_the_board_tables_options():
    """Each board with a PPMC-104 has a target with its top, pins, flow and device."""
    core = yaml.safe_load(plain_boards.core(BOARDS))
    assert list(core["targets"]) == list(BOARDS) and "icebreaker" in BOARDS
    flows = {"ice40": "icestorm", "ecp5": "trellis", "gowin": "apicula"}
    for name, target in core["targets"].items():
        on = BOARDS[name]
        assert (target["toplevel"], target["flow"]) == (on.top["uart"], flows[on.family])
        words = [*target["flow_options"]["nextpnr_options"], target["flow_options"].get("device")]
        assert on.family == "gowin" or words[:-1] == list(on.route)
        assert on.family != "gowin" or words[-1] == on.route[1] and f"{on.clk_hz / 1e6:g}" in words
        listed = core["filesets"][target["filesets"][0]]["files"]
        files = {path: said["file_type"] for entry in listed for path, said in entry.items()}
        assert files.pop(f"{target['toplevel']}.v") == "verilogSource-2005"
        assert {Path(path).suffix: kind for path, kind in files.items()}.items() <= TYPES.items()
        assert files and all((ROOT / "constraints" / path).is_file() for path in files)


def test_unknown_board():
    """For a board without a PPMC-104, one line lists the boards with one, and no file is written."""
    with pytest.raises(ProjectError, match="^BOARD=tangnano20k: no FuseSoC target .there are icebreaker, "):
        plain_boards.write_library(["tangnano20k"], BUILD / "test" / "nowhere")
    assert not (BUILD / "test" / "nowhere").exists()


def test_verdict(tmp_path, monkeypatch):
    """A missed or wrong clock in the output of FuseSoC is reported as a failure, and so is an empty
    bitstream.
    """
    monkeypatch.setattr(plain_boards, "relative", str)
    line = "Info: Max frequency for clock 'clk': {} MHz ({} at {} MHz)\n"
    log, bitstream = tmp_path / "next.log", tmp_path / "x.bin"

    def judged(reached: str, verdict: str, asked: str) -> plain_boards.Built:
        log.write_text(line.format("20.00", "FAIL", asked) + line.format(reached, verdict, asked))
        return plain_boards.built_result("icebreaker", tmp_path)

    with pytest.raises(ProjectError, match="no bitstream in "):
        judged("27.74", "PASS", "24.00")
    bitstream.write_bytes(b"")
    with pytest.raises(ProjectError, match="no bitstream in "):
        judged("27.74", "PASS", "24.00")
    bitstream.write_bytes(b"\xff")
    assert judged("27.74", "PASS", "24.00") == plain_boards.Built(bitstream, 27.74, 24.0)
    with pytest.raises(ProjectError, match="23.00 MHz, FAIL at 24.00 MHz; clk is 24 MHz"):
        judged("23.00", "FAIL", "24.00")
    with pytest.raises(ProjectError, match="PASS at 12.00 MHz; clk is 24 MHz"):
        judged("27.74", "PASS", "12.00")


def test_attributes_of_vendors_cells():
    """Attributes in capitals are written before the instances of their cells, as texts; others are
    omitted.
    """
    own = {"ICP_CURRENT": "12", "MFG_ENABLE_FILTEROPAMP": "1 ", "src": "a.sv:1.2"}
    cells = {"u_pll": {"type": "PLL", "attributes": own}, "u_x": {"type": "x", "attributes": {"src": "b"}}}
    found = vendor_attributes({"top": {"cells": cells}})
    assert found == {"PLL": {"ICP_CURRENT": "12", "MFG_ENABLE_FILTEROPAMP": "1"}}
    text = with_attributes("  PLL #(\n  ) u_pll (\n  PLLS u_no (\n", found)
    assert text.splitlines()[0] == '  (* ICP_CURRENT = "12", MFG_ENABLE_FILTEROPAMP = "1" *)'
    assert text.count("(*") == 1
    cells["u_b"] = {"type": "PLL", "attributes": {"ICP_CURRENT": "13"}}
    with pytest.raises(ProjectError, match="PLL: two cells with different attributes"):
        vendor_attributes({"top": {"cells": cells}})


@pytest.mark.parametrize(
    ("words", "told"),
    (
        (("icetime",), "icetime: no such tool (there are yosys, nextpnr-ice40, "),
        (("yosys", "-p", "synth"), "yosys -p synth: expected 'tcl SCRIPT'"),
    ),
)
def test_unknown_tool(words, told):
    """An unknown tool or command is reported in one line."""
    done = launched(*words)
    assert done.returncode == 1 and done.stderr.startswith(f"error: {told}")
    assert len(done.stderr.splitlines()) == 1


def test_missing_tool(tmp_path):
    """If a package is missing in the environment, one line names it."""
    python = tmp_path / "python"
    python.symlink_to(Path(sys.executable).resolve())
    done = subprocess.run([python, LAUNCHER, "icepack"], text=True, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (1, "error: yowasp-icepack is not installed: run `make setup`\n")
