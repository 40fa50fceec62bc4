"""`make rom`: the planner's ROM and its entries in the package, written from pmc006_calc.asm."""

from __future__ import annotations

import re
import sys
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, relative
from scripts import generated
from scripts.fpga.rom.calc_asm import WORDS, AsmError, Program, assemble, names_of

FOLDER = project.RTL / "pmc006" / "motion"
ASM = FOLDER / "pmc006_calc.asm"
ROM = FOLDER / "pmc006_calc_rom.sv"
PACKAGE = FOLDER / "pmc006_calc_pkg.sv"
BEGIN = "  // ---- written by `make rom` from pmc006_calc.asm: entry points and length of the program "
END = "  // ---- end of the generated lines "
WIDTH = 110

HEAD = f"""\
// SPDX-License-Identifier: Apache-2.0
// pmc006_calc_rom: ROM with the program of the motion planner: planning, update tick, current compensation.
// Rules:  P006-MOT-10..23, P006-MOT-30/31, P006-MOT-40..42, P006-MOT-50/51, P006-EXC-20..23.
// Timing: code_o follows fetch_i by one cycle and is stable until the next fetch_i.
// Note:   written by `make rom` from pmc006_calc.asm; change the program there.
`default_nettype none

module pmc006_calc_rom
  import pmc006_calc_pkg::*;
(
    input  wire logic       clk_i,
    input  wire logic       fetch_i,  // strobe: read the word at addr_i
    input  wire logic [8:0] addr_i,   // word address
    output instr_t          code_o    // word at addr_i of the last fetch_i
);

  (* rom_style = "block" *)
  instr_t rom[{WORDS}];

  initial begin
    for (int unsigned i = CALC_ROM_WORDS; i < {WORDS}; i++) rom[i] = 17'h00010;  // halt
"""
TAIL = """\
  end

  always_ff @(posedge clk_i) if (fetch_i) code_o <= rom[addr_i];

endmodule

`default_nettype wire
"""


def rom_text(program: Program) -> str:
    """Return the ROM module with the program; each word has its source line as a comment."""
    at_label: dict[int, list[str]] = {}
    for name, at in program.labels.items():
        at_label.setdefault(at, []).append(name)
    lines, width = [], len(f"rom[{len(program.words) - 1}]")
    for at, word in enumerate(program.words):
        labels = "".join(f"{name}: " for name in at_label.get(at, []))
        lines.append(f"    {f'rom[{at}]':{width}} = 17'h{word.code:05x};  // {labels}{word.text}")
    return HEAD + "\n".join(lines) + "\n" + TAIL


def constant(label: str) -> str:
    """Return the name of the package constant for a label: EntryPlan is ENTRY_PLAN."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", label).upper()


def package_text(package: str, program: Program) -> str:
    """Return the package with the entries and the length of this program between its two marks."""
    before, begin, rest = package.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ProjectError(f"{relative(PACKAGE)}: the marks of `make rom` are missing")
    body = [f"  localparam logic [8:0] {constant(name)} = 9'd{at};" for name, at in program.entries().items()]
    body.append(f"  localparam int unsigned CALC_ROM_WORDS = {len(program.words)};")
    return "\n".join([before + BEGIN.ljust(WIDTH, "-"), "", *body, "", END]) + after


def expected_files() -> dict[Path, str]:
    """Return the required content of both files."""
    package = PACKAGE.read_text(encoding="utf-8")
    try:
        program = assemble(ASM.read_text(encoding="utf-8"), names_of(package))
    except AsmError as error:
        raise ProjectError(f"{relative(ASM)}:{error}") from None
    return {ROM: rom_text(program), PACKAGE: package_text(package, program)}


def main() -> int:
    """Write both files; return 1 if --check finds an outdated file."""
    check = generated.parser("rom", __doc__).parse_args().check
    return generated.update("rom", expected_files(), check)


if __name__ == "__main__":
    sys.exit(project.run(main))
