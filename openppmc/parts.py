"""The one table of parts: where the things of each are, never how they work. Source: docs/architecture.md.

Needs the standard library only and imports nothing of the project, so that `make` can ask it before there is
an environment:

    python3 openppmc/parts.py names                      all parts; those …
    python3 openppmc/parts.py names --with COLUMN …      … that have something in each of these columns
    python3 openppmc/parts.py names --any COLUMN …       … in one of them at least
    python3 openppmc/parts.py names --folders            … with folders of their own
    python3 openppmc/parts.py names --tops               … with a top module of their own
    python3 openppmc/parts.py show NAME                  one row, a column a line

Places in the columns of LAYER_OF are "module:name" below the part's folder in that layer, or ":name" if the
part is a module there; `load` imports them
when they are asked for. view: what it shows on the command line; words: those of its own in script files.
"""

from __future__ import annotations

import importlib
import sys
from dataclasses import dataclass, fields, replace
from typing import Any


class UnknownPartError(ValueError):
    """A name or number that is not in the table, or a part without what was asked for. One line."""


LAYER_OF = {
    "model": "openppmc.model",
    "predict": "openppmc.model",
    "driver": "openppmc.host",
    "kind": "openppmc.host",
    "selftest": "openppmc.host.selftest",
    "view": "openppmc.cli",
    "words": "openppmc.cli",
    "machine": "openppmc.sim",
    "decode": "openppmc.capture",
    "soak": "cocotb_tests",
    "gates": "cocotb_tests",
    "crosses": "cocotb_tests",
    "manual": "scripts.pages",
    "demo": "scripts.demo",
    "bench": "scripts.measure.bench",
}
"""Column with places -> package in which each part has its folder."""


@dataclass(frozen=True)
class Row:
    """One part, or another one in a frame (`of`), which lives in that one's folder.

    name: `PART=`, `--part`, `part=` and the folder in every layer. title: in messages, on pages and pictures.
    of: the part whose folder it shares and whose columns it takes over where it has none of its own (but for
    those in OWN). number: of the part behind the UART bridge (IDENT), 0: not behind it. axes: how many it has
    there, at most. rules: prefixes of its rule IDs; the first has subjects (P104-CMD-07), another only
    numbers (J105-07).
    rtl: group in rtl/files.yml. top: its top module. families: FPGA families it is made for.
    docs: pages of its folder in docs/ beside README.md and traceability.md. manual: what is drawn and
    computed for them. selftest: what `openppmc selftest` makes its board do.
    carrier: there is a <part>_carrier, so a virtual board and bitstreams. line: stations
    on a serial line, with commands of its own.
    decode: how captures of it are read.
    demo: what `make demo` plays, or a function that plays it. bench: plays it for `make bench`, if not one
    on the pins of a part. soak: who plays a seed for `make soak`.
    gates: which tests `make test-gates` and `make test-verilog` run. crosses: what `make coverage`
    counts in its golden model.
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
    kind: str = ""
    selftest: str = ""
    view: str = ""
    words: str = ""
    machine: str = ""
    decode: str = ""
    docs: tuple[str, ...] = ()
    manual: str = ""
    carrier: bool = False
    line: bool = False
    demo: str = ""
    bench: str = ""
    soak: str = ""
    gates: str = ""
    crosses: str = ""

    @property
    def folder(self) -> str:
        """Folder in every layer."""
        return self.of or self.name

    def load(self, column: str) -> Any:
        """What the place in this column names; UnknownPartError if the part has none."""
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
        kind=":KIND",
        selftest=":PLAN",
        machine=":MACHINE",
        decode="decode:DECODER",
        docs=("replace.md", "examples.md", "rulings.md"),
        manual="manual:MANUAL",
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
        kind="words:KIND",
        selftest=":PLAN",
        view=":VIEW",
        machine=":MACHINE",
        decode="decode:DECODER",
        docs=("replace.md", "examples.md", "rulings.md", "isa.md"),
        manual="manual:MANUAL",
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
        kind=":KIND",
        selftest=":PLAN",
        machine=":MACHINE",
        decode="decode:DECODER",
        docs=("replace.md", "examples.md", "rulings.md"),
        manual="manual:MANUAL",
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
        kind="profile:KIND",
        selftest=":PLAN",
        view="view:VIEW",
        words="view:WORDS",
        machine="machine:MACHINE",
        decode="decode:DECODER",
        docs=("replace.md", "examples.md", "instructions.md", "serial.md", "design.md", "rulings.md"),
        manual="manual:MANUAL",
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
        kind="line.line:KIND",
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
        kind="words:KIND",
        selftest=":PLAN",
        view=":VIEW",
        machine=":MACHINE",
        docs=("carrier.md", "spi.md"),
        manual="manual:MANUAL",
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
        kind="wire:KIND",
        machine="line:MACHINE",
        decode="decode:DECODER",
        docs=("design.md", "rulings.md"),
        manual="manual:MANUAL",
        carrier=True,
        line=True,
        demo=":DEMO",
        soak="test_random:SOAK",
        gates="gates:PART",
        crosses="crosses:CROSSES",
    ),
)
OWN = (
    *("name", "of", "number", "rules", "docs", "manual", "carrier", "line", "selftest"),
    *("demo", "bench", "soak", "gates", "crosses", "decode"),
)
"""Columns that a row does not take from the one it is `of`."""


def _filled(row: Row) -> Row:
    """The row with what it takes from the part it is `of`, and group and top module by its name."""
    if row.of:
        other = _filled(next(known for known in ROWS if known.name == row.of))
        empty = [f.name for f in fields(row) if f.name not in OWN and not getattr(row, f.name)]
        row = replace(row, **{name: getattr(other, name) for name in empty})
    return replace(row, rtl=row.rtl or row.name, top=row.top or row.name)


PARTS: dict[str, Row] = {row.name: _filled(row) for row in ROWS}
"""Every row by its name, in the order in which parts are listed."""


def part(name: str) -> Row:
    """The row of this name; UnknownPartError lists the names that there are."""
    if name not in PARTS:
        raise UnknownPartError(f"part {name}: there is no such part (there are {', '.join(PARTS)})")
    return PARTS[name]


def having(*columns: str) -> tuple[Row, ...]:
    """The rows that have something in all of these columns. UnknownPartError for an unknown column."""
    known = [f.name for f in fields(Row)]
    for column in columns:
        if column not in known:
            raise UnknownPartError(f"{column}: there is no such column (there are {', '.join(known)})")
    return tuple(row for row in PARTS.values() if all(getattr(row, column) for column in columns))


def folders() -> tuple[Row, ...]:
    """The parts with folders of their own."""
    return tuple(row for row in PARTS.values() if not row.of)


def tops() -> tuple[Row, ...]:
    """The parts with a top module of their own, those in another one's folder among them."""
    return tuple(row for row in PARTS.values() if not row.of or row.top != PARTS[row.of].top)


def by_number(number: int) -> Row | None:
    """The part that tells this number over the UART bridge, or None."""
    return next((row for row in having("number") if row.number == number), None)


def _chosen(options: list[str]) -> tuple[Row, ...] | None:
    """The rows that the options of `names` choose; None for options that there are not."""
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
    """Command line, for make and shell scripts; returns the exit code."""
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
