"""Registers in SystemRDL: generated files are fresh, and RTL and pictures have the same numbers (D-126)."""

from __future__ import annotations

import json
import re

import pytest

from cocotb_tests.harness.paths import ROOT

pytest.importorskip("systemrdl", reason="systemrdl-compiler is not installed; run make setup")

from cocotb_tests.harness.project import ProjectError  # noqa: E402
from scripts.fpga.packages import registers  # noqa: E402

BITS = {"ppmc104": "status", "stmc": "status", "ppmc2104": "status", "ppmc312": "csr"}
RTL = {
    "ppmc_bank": ("rtl/bank/ppmc_bank_pkg.sv", r"localparam \S+ \[\d:0\] (?:REG_)?(\w+) = \d'h(\w+);", 16),
    "ppmc312": ("rtl/ppmc312/front/ppmc312_mailbox.sv", r"localparam \S+ \[2:0\] Reg(\w+) = 3'b(\d+);", 2),
}
RTL_NAMES = {"map": "pending", "cr": "control", "ar": "address", "dwr": "write", "drr": "read"}


@pytest.mark.parametrize("path", registers.register_files(), ids=lambda path: path.name)
def test_fresh(path):
    """Constants and tables in a file equal the output of `make packages`."""
    assert path.read_text(encoding="utf-8") == registers.register_files()[path], "run `make packages`"


@pytest.mark.parametrize("part", RTL)
def test_numbers_of_the_rtl(part):
    """Every register number in the RTL is that of the SystemRDL file."""
    path, pattern, base = RTL[part]
    found = re.findall(pattern, (ROOT / path).read_text(encoding="utf-8"))
    rtl = {RTL_NAMES.get(name.lower(), name.lower()): int(value, base) for name, value in found}
    regs = registers.registers(part, part)
    wanted = {reg.inst_name: reg.raw_address_offset for reg in regs}
    wanted |= {name: value for reg in regs for name, value, _ in registers.values(reg)}
    assert len(rtl) >= 5 and {name: wanted.get(name) for name in rtl} == rtl


@pytest.mark.parametrize("part", BITS)
def test_bits_of_the_picture(part):
    """The picture of a register in the manual has the bits of the SystemRDL file."""
    drawing = json.loads((ROOT / f"docs/{part}/wavedrom/bits_{BITS[part]}.json").read_text(encoding="utf-8"))
    drawn, low = set(), 0
    for bit in drawing["reg"]:
        if not bit["name"].startswith("0"):
            drawn.add((bit["name"], low, bit["bits"]))
        low += bit["bits"]
    _, file, top = next(row for row in registers.MANUALS if row[0] == part)
    reg = next(reg for reg in registers.registers(file, top) if reg.inst_name == BITS[part])
    assert {(f.get_property("name").upper(), f.low, f.width) for f in reg.fields()} == drawn


def test_missing_block(tmp_path):
    """If a file lacks the two lines that enclose a generated block, the error contains these lines."""
    file = tmp_path / "empty.h"
    file.write_text("")
    with pytest.raises(ProjectError, match=r"no lines '/\* Registers.*' and '/\* End"):
        registers.replaced(file, registers.c_block(*registers.C_FILES["ppmc104.h"]))
