"""Table of all parts: the places of the modules and files of each part.

Source: docs/architecture.md. This module imports only the standard library, so that `make` can read the table
before the environment is created:

    python3 openppmc/parts.py names                      all parts
    python3 openppmc/parts.py names --with COLUMN …      parts with an entry in each of these columns
    python3 openppmc/parts.py names --any COLUMN …       parts with an entry in at least one of them
    python3 openppmc/parts.py names --folders            parts with their own folders
    python3 openppmc/parts.py names --tops               parts with their own top module
    python3 openppmc/parts.py show NAME                  one row, one column per line

A place in a column of LAYER_OF is "module:name" below the part's folder in that layer, or ":name" if the part
is a module there. `load` imports it when a program calls it.
"""

from __future__ import annotations

import importlib
import sys
from dataclasses import dataclass, fields, replace
from typing import Any


class UnknownPartError(ValueError):
    """A name or number is not in the table, or a part has no entry in a column. The message is one line."""


LAYER_OF = {
    "model": "openppmc.model",
    "predict": "openppmc.model",
    "driver": "openppmc.host",
    "capabilities": "openppmc.host",
    "selftest": "openppmc.host.selftest",
    "presenter": "openppmc.cli",
    "script_commands": "openppmc.cli",
    "machine": "openppmc.sim",
    "decode": "openppmc.capture",
    "soak": "cocotb_tests",
    "gates": "cocotb_tests",
    "crosses": "cocotb_tests",
    "demo": "scripts.demo",
    "bench": "scripts.measure.bench",
}
"""Columns of the table that contain places of objects.

The value of a column is the package in which each part has its folder.
"""


@dataclass(frozen=True)
class Row:
    """One part, or a variant of a part (`of`) with the folder of that part.

    Attributes:
        name: value of `PART=`, `--part` and `part=`, and name of the folder in every layer.
        title: name in messages, on pages and pictures.
        of: part whose folder this variant shares. Where an entry of the variant is empty, the entry of that
            part is used, except for the columns in OWN.
        number: number of the part in IDENT of the UART bridge; 0 if the part is not accessed through the
            bridge.
        axes: largest number of axes on the bridge.
        rules: prefixes of the rule IDs of the part. IDs with the first prefix contain a subject
            (P104-CMD-07); IDs with other prefixes contain only a number (J105-07).
        rtl: group in rtl/files.yml.
        top: top module of the part.
        families: FPGA families for which the part is built.
        presenter: output of the part on the command line.
        script_commands: commands in script files that only this part supports.
        docs: pages in the folder of the part in docs/, in addition to README.md and traceability.md.
        selftest: plan of `openppmc selftest` for a board with the part.
        carrier: True if there is a <part>_carrier, and therefore a virtual board and bitstreams.
        line: True if the part is a station on a serial line, for which the command line has separate
            commands.
        decode: decoder of captures of the part.
        demo: content of `make demo`, or a function that runs the demo.
        bench: function that `make bench` calls; only for parts without a test bench at pin level.
        soak: function that runs a seed for `make soak`.
        gates: tests that `make test-gates` and `make test-verilog` run.
        crosses: coverage crosses that `make coverage` counts in the golden model of the part.
    """

    name: str
    title: str = ""
    of: str = ""
    number: int = 0
    axes: int = 1
    rules: tuple[str, ...] = ()
    rtl: str = ""
    top: str = ""
    families: tuple[str, ...] = ()
    model: str = ""
    predict: str = ""
    driver: str = ""
    capabilities: str = ""
    selftest: str = ""
    presenter: str = ""
    script_commands: str = ""
    machine: str = ""
    decode: str = ""
    docs: tuple[str, ...] = ()
    carrier: bool = False
    line: bool = False
    demo: str = ""
    bench: str = ""
    soak: str = ""
    gates: str = ""
    crosses: str = ""

    @property
    def folder(self) -> str:
        """Name of the folder of the part in every layer."""
        return self.of or self.name

    def load(self, column: str) -> Any:
        """Import and return the object whose place this column contains.

        Raises UnknownPartError if there is no place.
        """
        place: str = getattr(self, column)
        if not place:
            raise UnknownPartError(f"part {self.name} has no {column}")
        module, _, name = place.partition(":")
        package = f"{LAYER_OF[column]}.{self.folder}"
        return getattr(importlib.import_module(f"{package}.{module}".rstrip(".")), name)


BOTH = ("ecp5", "ice40")
ROWS = (
    Row(
        name="ppmc104",
        title="PPMC-104",
        number=104,
        rules=("P104",),
        families=BOTH,
        model=":Ppmc104",
        predict=":predict",
        driver=":Ppmc104",
        capabilities=":CAPABILITIES",
        selftest=":PLAN",
        machine=":MACHINE",
        decode="decode:DECODER",
        docs=("replace.md", "examples.md", "rulings.md"),
        carrier=True,
        demo=":DEMO",
        soak="test_random:random_item",
        gates="gates:PART",
        crosses="crosses:CROSSES",
    ),
    Row(
        name="ppmc2104",
        title="PPMC-2104",
        number=2104,
        axes=2,
        rules=("P2104",),
        families=BOTH,
        model="part:Ppmc2104",
        predict="carrier:predict",
        driver="part:Ppmc2104",
        capabilities="registers:CAPABILITIES",
        selftest=":PLAN",
        presenter=":PRESENTER",
        machine=":MACHINE",
        decode="decode:DECODER",
        docs=("replace.md", "examples.md", "rulings.md", "isa.md"),
        carrier=True,
        demo=":DEMO",
        soak="test_random:random_item",
        gates="gates:PART",
        crosses="crosses:CROSSES",
    ),
    Row(
        name="isa_4axis",
        title="four axes on an ISA bus",
        of="ppmc2104",
        rtl="isa_4axis",
        top="isa_4axis",
        gates="isa.gates:PART",
    ),
    Row(
        name="stmc",
        title="J105 STMC",
        number=105,
        rules=("STMC", "J105"),
        families=BOTH,
        model="part:Stmc",
        predict="carrier:predict",
        driver=":Stmc",
        capabilities=":CAPABILITIES",
        selftest=":PLAN",
        machine=":MACHINE",
        decode="decode:DECODER",
        docs=("replace.md", "examples.md", "rulings.md"),
        carrier=True,
        demo=":DEMO",
        soak="test_random:random_item",
        gates="gates:PART",
        crosses="crosses:CROSSES",
    ),
    Row(
        name="j105_stmc",
        title="J105 STMC board",
        of="stmc",
        rtl="j105_stmc",
        top="j105_stmc",
        model="pc104_board:J105Stmc",
        decode="board:DECODER",
        gates="gates:BOARD",
    ),
    Row(
        name="ppmc312",
        title="PPMC-312",
        number=312,
        rules=("P312",),
        families=("ecp5",),
        model="part:Ppmc312",
        predict="carrier:predict",
        driver="part:Ppmc312",
        capabilities="profile:CAPABILITIES",
        selftest=":PLAN",
        presenter="presenter:PRESENTER",
        script_commands="presenter:SCRIPT_COMMANDS",
        machine="machine:MACHINE",
        decode="decode:DECODER",
        docs=("replace.md", "examples.md", "instructions.md", "serial.md", "design.md", "rulings.md"),
        carrier=True,
        demo="demo:DEMO",
        soak="test_random:random_item",
        gates="gates:PART",
        crosses="crosses:CROSSES",
    ),
    Row(
        name="ppmc312-serial",
        title="PPMC-312 in serial mode",
        of="ppmc312",
        driver="line.bus:Ppmc312Bus",
        capabilities="line.line:CAPABILITIES",
        machine="line:MACHINE",
        decode="line:DECODER",
        line=True,
        demo="line.demo:main",
        bench=":main",
        soak="line.soak:SOAK",
    ),
    Row(
        name="bank",
        title="PPMC bank",
        number=32,
        axes=64,
        rules=("BANK",),
        rtl="ppmc_bank",
        top="ppmc_bank",
        families=("ecp5",),
        model="part:PpmcBank",
        driver="part:PpmcBank",
        capabilities="registers:CAPABILITIES",
        selftest=":PLAN",
        presenter=":PRESENTER",
        machine=":MACHINE",
        docs=("carrier.md", "spi.md"),
        carrier=True,
        demo="demo:main",
        bench=":main",
        soak="test_random:random_item",
        gates="gates:PART",
        crosses="crosses:CROSSES",
    ),
    Row(
        name="pmc006",
        title="PMC006B4",
        rules=("P006",),
        families=BOTH,
        model="part:Pmc006",
        driver="part:Pmc006Bus",
        capabilities="wire:CAPABILITIES",
        machine="line:MACHINE",
        decode="decode:DECODER",
        docs=("design.md", "rulings.md"),
        carrier=True,
        line=True,
        demo=":DEMO",
        soak="test_random:SOAK",
        gates="gates:PART",
        crosses="crosses:CROSSES",
    ),
)
OWN = (
    *("name", "of", "number", "rules", "docs", "carrier", "line", "selftest"),
    *("demo", "bench", "soak", "gates", "crosses", "decode"),
)
"""Columns for which a variant does not use the entries of the part in `of`."""


def _filled(row: Row) -> Row:
    """Return the row, completed with the entries of the part in `of`.

    Group and top module have the name of the row by default.
    """
    if row.of:
        other = _filled(next(known for known in ROWS if known.name == row.of))
        empty = [f.name for f in fields(row) if f.name not in OWN and not getattr(row, f.name)]
        row = replace(row, **{name: getattr(other, name) for name in empty})
    return replace(row, rtl=row.rtl or row.name, top=row.top or row.name)


PARTS: dict[str, Row] = {row.name: _filled(row) for row in ROWS}
"""All rows by name, in the order in which parts are listed."""


def part(name: str) -> Row:
    """Return the row of this name. Raises UnknownPartError, which lists the names."""
    if name not in PARTS:
        raise UnknownPartError(f"part {name}: there is no such part (there are {', '.join(PARTS)})")
    return PARTS[name]


def having(*columns: str) -> tuple[Row, ...]:
    """Return the rows with entries in all of these columns. Raises UnknownPartError."""
    known = [f.name for f in fields(Row)]
    for column in columns:
        if column not in known:
            raise UnknownPartError(f"{column}: there is no such column (there are {', '.join(known)})")
    return tuple(row for row in PARTS.values() if all(getattr(row, column) for column in columns))


def folders() -> tuple[Row, ...]:
    """Return the parts with their own folders."""
    return tuple(row for row in PARTS.values() if not row.of)


def tops() -> tuple[Row, ...]:
    """Return the parts with their own top module, including those in the folder of another part."""
    return tuple(row for row in PARTS.values() if not row.of or row.top != PARTS[row.of].top)


def by_number(number: int) -> Row | None:
    """Return the part with this number on the UART bridge, or `None`."""
    return next((row for row in having("number") if row.number == number), None)


def _chosen(options: list[str]) -> tuple[Row, ...] | None:
    """Return the rows that the options of the command `names` select; `None` for unknown options."""
    if not options:
        return tuple(PARTS.values())
    if options in (["--folders"], ["--tops"]):
        return folders() if options == ["--folders"] else tops()
    if options[0] == "--with" and options[1:]:
        return having(*options[1:])
    if options[0] == "--any" and options[1:]:
        found = [row for column in options[1:] for row in having(column)]
        return tuple(row for row in PARTS.values() if row in found)
    return None


def main(arguments: list[str]) -> int:
    """Run the command line for make and shell scripts; return the exit status."""
    try:
        rows = _chosen(arguments[1:]) if arguments[:1] == ["names"] else None
        if rows is not None:
            print(*(row.name for row in rows))
        elif arguments[:1] == ["show"] and len(arguments) == 2:
            for f in fields(Row):
                value = getattr(part(arguments[1]), f.name)
                print(f"{f.name}: {' '.join(value) if isinstance(value, tuple) else value}")
        else:
            print(
                "expected: names [--with COLUMN… | --any COLUMN… | --folders | --tops] or show NAME",
                file=sys.stderr,
            )
            return 2
    except UnknownPartError as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
