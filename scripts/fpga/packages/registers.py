"""Constants and tables from packages/registers/*.rdl for C, Python and the manuals (D-126)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from textwrap import fill

from systemrdl import RDLCompileError, RDLCompiler
from systemrdl.node import AddrmapNode, FieldNode, RegNode

from cocotb_tests.harness.project import DOCS, ROOT, ProjectError, relative, replace_between
from scripts import markdown

FOLDER = ROOT / "packages" / "registers"
FROM = "Registers, written by `make packages` from packages/registers/{}.rdl."
END = "End of the registers."
C_FILES = {
    "ppmc104.h": ("mailbox", "ppmc104", "PPMC104_", ()),
    "ppmc2104.h": ("ppmc2104", "ppmc2104", "PPMC2104_", ("data", "command")),
    "ppmc312.c": ("ppmc312", "ppmc312", "", ()),
    "ppmc_bank.h": ("ppmc_bank", "ppmc_bank", "PPMC_BANK_", ("data", "status", "command")),
}
"""Headers in drivers/c: SystemRDL file, address map, prefix, and registers that another header defines."""
PYTHON_FILES = {
    "model/motion/codes.py": ("mailbox", "ppmc104"),
    "model/ppmc2104/codes.py": ("ppmc2104", "ppmc2104"),
    "model/ppmc312/front/mailbox.py": ("ppmc312", "ppmc312"),
    "model/bank/window.py": ("ppmc_bank", "ppmc_bank"),
    "host/ppmc312/window.py": ("ppmc312", "ppmc312"),
    "host/bank/registers.py": ("ppmc_bank", "ppmc_bank"),
}
"""Files in openppmc: SystemRDL file and address map."""
MANUALS = (
    ("ppmc104", "mailbox", "ppmc104"),
    ("stmc", "mailbox", "stmc"),
    ("ppmc2104", "ppmc2104", "ppmc2104"),
    ("ppmc312", "ppmc312", "ppmc312"),
    ("bank", "ppmc_bank", "ppmc_bank"),
)
"""Manuals: folder, SystemRDL file, address map."""
WIDTH = 110


def elaborated(file: str, top: str) -> AddrmapNode:
    """Return an address map; raise ProjectError if the SystemRDL file has an error, which is printed."""
    compiler = RDLCompiler()
    try:
        compiler.compile_file(str(FOLDER / f"{file}.rdl"))
        return compiler.elaborate(top).top
    except RDLCompileError as error:
        raise ProjectError(f"{relative(FOLDER)}/{file}.rdl: {error}") from None


def registers(file: str, top: str, without: Iterable[str] = ()) -> list[RegNode]:
    """Return the registers of an address map. An array of registers is returned once."""
    found = [node for node in elaborated(file, top).descendants() if isinstance(node, RegNode)]
    return [reg for reg in found if reg.inst_name not in without]


def flags(reg: RegNode) -> list[FieldNode]:
    """Return the fields of a register, the highest first; empty if the whole byte is one field."""
    fields = sorted(reg.fields(), key=lambda field: -field.low)
    return [] if fields[0].width == 8 else fields


def text(node: RegNode | FieldNode) -> str:
    """Return the description of a register or field as one line."""
    return " ".join((node.get_property("desc") or "").split())


def values(reg: RegNode) -> list[tuple[str, int, str]]:
    """Return (name, value, description) of each named value and of each field (value: its mask)."""
    found = [(f.inst_name, (1 << f.width) - 1 << f.low, text(f)) for f in flags(reg)]
    for field in reg.fields():
        members = field.get_property("encode")
        found += [(f"{reg.inst_name}_{one.name}", one.value, one.rdl_desc or "") for one in members or ()]
    return found


def noted(line: str, note: str, marks: Sequence[str]) -> str:
    """Return a line with its comment (between `marks`) at the end, or above it if the line is too long."""
    after, above, end = marks
    if len(f"{line}{after}{note}{end}") <= WIDTH:
        return f"{line}{after}{note}{end}\n"
    rest = " * " if end else above
    return fill(note + end, WIDTH, initial_indent=above, subsequent_indent=rest) + f"\n{line}\n"


def c_block(file: str, top: str, prefix: str, without: Sequence[str]) -> str:
    """Return the C macros of an address map."""
    marks, lines = (" /**< ", "/** ", " */"), ""
    found = registers(file, top, without)
    for reg in found:
        name = f"{prefix}REG_{reg.inst_name.upper()}"
        lines += noted(f"#define {name} 0x{reg.raw_address_offset:X}u", text(reg), marks)
    for reg in found:
        for name, value, note in values(reg):
            name = name if name.startswith(f"{reg.inst_name}_") else f"{reg.inst_name}_{name}"
            lines += noted(f"#define {prefix}{name.upper()} 0x{value:02X}u", note, marks)
    return f"/* {FROM.format(file)} */\n{lines}/* {END} */\n"


def python_block(file: str, top: str) -> str:
    """Return Python constants with the addresses and bits of an address map."""
    found, marks, lines = registers(file, top), ("  # ", "# ", ""), ""
    for reg in found:
        lines += noted(f"{reg.inst_name.upper()} = 0x{reg.raw_address_offset:X}", text(reg), marks)
    for name, value, note in (value for reg in found for value in values(reg)):
        lines += noted(f"{name.upper()} = 0x{value:02X}", note, marks)
    return f"# {FROM.format(file)}\n{lines}# {END}\n"


def place(high: int, low: int) -> str:
    """Return the numbers of bits, as in 6…4."""
    return f"{high}" if high == low else f"{high}…{low}"


def bits_table(reg: RegNode) -> str:
    """Return the table of a register's bits for a manual."""
    rows, last = [], 8
    for field in [*flags(reg), None]:
        high = field.high if field else -1
        if high + 1 < last:
            rows.append((place(last - 1, high + 1), "", "always 0"))
        if field:
            rows.append((place(field.high, field.low), field.get_property("name").upper(), text(field)))
            last = field.low
    return markdown.table(("Bit", "Name", "1 means"), rows).replace("|  |", "| |")


def meaning(reg: RegNode) -> str:
    """Return description, bits and value after reset of a register."""
    bits = ", ".join(f"{place(one.high, one.low)} {one.inst_name.upper()}" for one in flags(reg))
    reset = sum((one.get_property("reset") or 0) << one.low for one in reg.fields())
    return text(reg) + (f" ({bits})" if bits else "") + (f"; 0x{reset:02X} after reset" if reset else "")


def register_table(found: Sequence[RegNode]) -> str:
    """Return the table of registers for a manual."""
    rows = []
    for reg in found:
        first = reg.raw_address_offset
        last = first + (reg.n_elements - 1) * reg.size if reg.is_array else first
        where = f"0x{first:X}" + (f" … 0x{last:X}" if last > first else "")
        access = ", ".join(
            way for way, there in (("read", reg.has_sw_readable), ("write", reg.has_sw_writable)) if there
        )
        rows.append((where, reg.inst_name.upper(), access, meaning(reg)))
    return markdown.table(("Register", "Name", "Access", "Meaning"), rows)


def manual(name: str, file: str, top: str) -> tuple[Path, str]:
    """Return path and text of a manual, in which the tables between markers are new."""
    path = DOCS / name / "README.md"
    page, found = path.read_text(encoding="utf-8"), registers(file, top)
    tables = {"registers": register_table(found)}
    tables |= {f"{reg.inst_name}-bits": bits_table(reg) for reg in found if flags(reg)}
    for marker, table in tables.items():
        if f"<!-- {marker} -->" in page:
            page = replace_between(page, marker, table)
    return path, page


def replaced(path: Path, block: str) -> tuple[Path, str]:
    """Return path and text of a file with a new block; raise ProjectError if it has no such block."""
    begin, *_, end = block.splitlines(keepends=True)
    head, found, rest = path.read_text(encoding="utf-8").partition(begin)
    if not found or end not in rest:
        raise ProjectError(f"{relative(path)}: no lines {begin.strip()!r} and {end.strip()!r}")
    return path, head + block + rest.partition(end)[2]


def register_files() -> dict[Path, str]:
    """Return the texts of all files with constants or tables of registers, by path."""
    return dict(
        [
            *(replaced(ROOT / "drivers" / "c" / name, c_block(*row)) for name, row in C_FILES.items()),
            *(replaced(ROOT / "openppmc" / name, python_block(*row)) for name, row in PYTHON_FILES.items()),
            *(manual(*row) for row in MANUALS),
        ]
    )
