r"""The table of make targets and their variables; ``python -m scripts.targets`` prints it (`make help`).

A row of TABLE has this form: name | groups of packages that the target needs | line of help. After the row,
there is the command of the target: shell text with the following marks, which scripts/run.py replaces:

    {NAME} {NAME:text}   the value of a variable, quoted; the default `text` if it is not given
    {NAME/or}            the same with " or " in place of commas
    [… {NAME} …]         only if the variable is given; for a flag: only if it is 1, and {NAME} is removed
    {py} and others      abbreviations in SHORT

A row with a variable in its name (`prove NIGHT=1`) applies if the variable has this value; with `NAME=`, if
it has any value. `make` reads this table before the environment exists, so this module needs only the
standard library.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from openppmc import parts, streams

ROOT = Path(__file__).resolve().parents[1]
SHORT = {
    "py": ".venv/bin/python",
    "pytest": ".venv/bin/python -m pytest",
    "on": "-n {J:2} [--scheduler {SCHEDULER}] [--fresh {FRESH}]",
    "folders": " ".join(row.name for row in parts.folders()),
    "top": " ".join(
        f"[-G {name}={{{name}}}]"
        for name in ("XTAL_HZ", "TIMING", "PHASE_IDLE", "PHASE_ON", "READ_MAP", "BAUD", "RECORD")
    ),
    # Exit code 5 of pytest means that it has collected no test.
    "else": "|| { code=$?; test $code != 5 || echo 'error: no test matches' [T={T}] [CLK_HZ={CLK_HZ}] >&2;"
    " exit $code; }",
    "clean": "rm -rf build .pytest_cache .ruff_cache .hypothesis &&"
    " find . -path ./.venv -prune -o -name __pycache__ -type d -print | xargs rm -rf",
}
TABLE = r"""
use
help | | Print this list.
    {python} -m scripts.targets
setup | dev campaign | Make the whole environment; other targets make what they need.
    :
demo | sim | Move a part; show the bus traffic, a plot and waveforms.
    {py} -m scripts.demo --part {PART:ppmc104}
waves | | Open the demo's waveforms in GTKWave or Surfer.
    ./scripts/waves.sh
test | sim | Run all tests.
    [SIM_MAIN={SIM_MAIN}] {pytest} -n {J:2} [-k {T/or}] [--seed {SEED}] [--clk-hz {CLK_HZ}]
    [--waves {WAVES}] [--probe {PROBE}] [--model {MODEL}] [--jitter {JITTER}] {else}
board | sim | Start a virtual board on a pseudo-terminal.
    {py} -m openppmc.sim [part={PART}] [{SIM}]
bitstream | dev | Build the bitstream of a board with a part.
    {py} -m scripts.fpga.bitstream {BOARD:icebreaker} --host {HOST:uart} --part {PART:ppmc104}
    [--seed {SEED}] {top}
flash | sim | Load that bitstream into the board with openFPGALoader.
    {py} -m scripts.fpga.flash {BOARD:icebreaker} --host {HOST:uart} --part {PART:ppmc104}
verilog | dev | Write parts, bridges and boards as plain Verilog-2005.
    {py} -m scripts.fpga.verilog [--top {TOP}] [--params {PARAMS}]
site | site | Build all documents and the playground; needs Node.js.
    {py} -m scripts.site

work
test WITH=campaign | campaign | Test the campaign runner.
    {pytest} tests/*/campaign [-k {T/or}]
test WITH=ophyd | ophyd | Test the EPICS IOC, and openppmc.ophyd with bluesky.
    {pytest} tests/*/lab -n {J:2} [-k {T/or}]
test WITH=linuxcnc | sim | Test openppmc hal in LinuxCNC, if it is installed.
    {pytest} tests/*/linuxcnc -n 0 [-k {T/or}]
test WITH=litex | litex dev | Test openppmc.litex; needs riscv64-unknown-elf-gcc.
    {pytest} tests/*/litex [-k {T/or}]
test WITH=fusesoc | dev | Build the bitstream of a board with FuseSoC and edalize.
    {pytest} tests/*/fusesoc && {py} -m scripts.fpga.packages.plain_boards {BOARD:icebreaker}
test WITH=versions | sim | Test with the lowest and newest dependencies.
    {py} -m scripts.measure.versions [-k {T/or}]
test-board | sim | Test the host package on the virtual board; T=quick: a sample.
    {pytest} tests/*/board -n {J:2} [-k {T/or}]
test-gates | dev campaign | Run the part tests on netlists; T=quick: a sample.
    [SIM_MAIN={SIM_MAIN}] {py} -m scripts.measure.gates {on} [-k {T}] [--seed {SEED}]
test-verilog | dev campaign | Run the part tests on plain Verilog; T=quick: a sample.
    [SIM_MAIN={SIM}] {py} -m scripts.measure.gates --plain {on} [-k {T}] [--seed {SEED}]
test-bits | dev campaign | Run the tests on bitstreams; T=quick: a sample.
    [SIM_MAIN={SIM_MAIN}] {py} -m scripts.measure.gates --bits {on} [-k {T}] [--seed {SEED}]
test-web | site | Test the playground under node and in Chromium; T=quick: a sample.
    rm -f build/site/figures.txt; {pytest} tests/*/web -n {J:2} [-k {T/or}]; code=$?;
    cat build/site/figures.txt 2>/dev/null; exit $code
lint | dev | Check all sources.
    {py} -m scripts.measure.lint
lint VERILATOR= | dev | Check the packages with another Verilator.
    {py} -m scripts.fpga.packages --try --verilator {VERILATOR}
format | dev | Format RTL and Python.
    {py} -m scripts.measure.lint --fix
docs | sim | Write the pictures and tables of the manuals.
    {py} -m scripts.pages
boards | dev | Write tops, constraints and tables of the boards.
    {py} -m scripts.fpga.boards
packages | dev | Write FuseSoC cores, file lists, register constants.
    {py} -m scripts.fpga.packages
rom | dev | Assemble the planner's program of the PMC006B4.
    {py} -m scripts.fpga.rom.calc_rom
trace | sim | List each rule with its tests; a missing test fails.
    { test -d build/trace || {pytest} -n 2; } &&
    for part in {PART:{folders}}; do {py} -m scripts.measure.trace $part || exit 1; done
release | dev site release | Build all files of a release in dist/.
    {py} -m scripts.release [--skip {SKIP}] [--only {ONLY}]
clean | | Remove what was built.
    {clean}
distclean | | Remove the environment, too.
    {clean} && rm -rf .venv site/node_modules site/browser/node_modules

measure
prove | dev | Prove properties of the RTL blocks (docs/proofs.md).
    {py} -m scripts.measure.prove -n {J:2} [--fresh {FRESH}] [--break {BREAK}] [{T}]
prove NIGHT=1 | dev | Run all proofs, with intact and with broken RTL.
    {py} -m scripts.measure.prove --night -n {J:2} && {py} -m scripts.measure.prove --night --break -n {J:2}
report | dev | Measure size and clock rate of changed designs.
    {py} -m scripts.measure.sizes [--part {PART}] [--peers {PEERS}]
size | dev | Compare changed designs with docs/sizes.json; 5 % growth fails.
    {py} -m scripts.measure.sizes --check [--fresh {FRESH}] [--part {PART}]
bench | sim | Measure the speed of all simulations.
    {py} -m scripts.measure.bench --part {PART:ppmc104}
mutate | dev campaign | Count the RTL mutants that a proof or test finds.
    {py} -m scripts.measure.mutants.made {on} [-k {T}] [--count {COUNT}] [--quick {QUICK}]
coverage | campaign | Measure coverage of the RTL and the data sheets.
    {py} -m scripts.measure.coverage {on} [-k {T}]
soak | campaign | Compare random hosts with the golden model; PART=all: each part.
    [SIM_MAIN={SIM_MAIN}] {py} -m scripts.measure.soak {PART:ppmc104}
    --seed {SEED:1} --count {COUNT:1000} {on}
fuzz | campaign | Send random characters to each deframer and its model.
    {py} -m scripts.measure.fuzz [--seed {SEED}] [--count {COUNT}] {on}
fire | campaign | Damage the bytes between host drivers and their boards.
    {py} -m scripts.measure.fire --seed {SEED:0} --count {COUNT:10000} {on}
nightly | dev campaign site | Run all campaigns, and all tests of which CI runs a sample.
    code=0; for work in 'fuzz --count 100000000' 'fire --count 100000'
    'soak all --seed {SEED:1000000} --count {COUNT:2000}' coverage mutants.made gates 'gates --bits'; do
    echo "== nightly: $work"; {py} -m scripts.measure.$work {on} || code=1; done;
    echo '== nightly: jitter'; {pytest} -n {J:2} --jitter || code=1;
    echo '== nightly: boards, playground'; {pytest} tests/*/board tests/*/web -n {J:2} || code=1;
    echo '== nightly: versions'; {py} -m scripts.measure.versions || code=1;
    echo '== nightly: proofs'; {py} -m scripts.measure.prove --night -n {J:2} || code=1; exit $code
replay | sim | Repeat a failed random test on the RTL and the golden model.
    {py} -m scripts.measure.replay {FILE}
scheduler | campaign | Start a scheduler for workers on other machines, port 8786.
    {py} -m scripts.measure.campaign scheduler
worker | campaign | Start workers of this checkout for a scheduler.
    {py} -m scripts.measure.campaign worker --scheduler {SCHEDULER} -n {J:2}
"""
OLD = {
    "test-campaign": "test WITH=campaign",
    "test-lab": "test WITH=ophyd",
    "test-litex": "test WITH=litex",
    "test-fusesoc": "test WITH=fusesoc",
    "prove-night": "prove NIGHT=1",
}
"""Old names of targets; version 1.1.0 removes them."""
OLD_VARIABLES = {"INSIDE": "PROBE"}
"""Old names of variables; version 1.1.0 removes them."""

# Name | values | line of help. PART and BOARD are checked before HOST and the parameters that depend on them.
VARIABLE_TABLE = """
PYTHON | any | Python (3.10 or newer) that makes the environment
PART | part tops | part name
BOARD | board | FPGA board
HOST | host | host interface that the board has for the part: uart, bus or spi
T | tests | parts of test names, separated by commas
SEED | 0..4294967295 | (first) random seed; for bitstream: of place and route
COUNT | 1..1000000000 | number of seeds, sessions, characters, or mutants of a folder
CLK_HZ | 8000000..200000000 | only tests with this clock rate
J | 1..64 | number of workers
WITH | campaign ophyd linuxcnc litex fusesoc versions | tests that need other packages
WAVES | 0..1 | 1: keep the waveforms of passing tests
PROBE | 0..1 | 1: make internal signals visible to tests, and record them in the waveforms
MODEL | 0..1 | 1: run directed tests on the golden model
JITTER | 0..1 | 1: sample each pin change one cycle late at random
SIM_MAIN | own cocotb | main program of the simulations
SCHEDULER | scheduler | use the workers of this scheduler, tcp://host:port
FRESH | 0..1 | 1: ignore results of earlier runs
QUICK | 0..1 | 1: only the first tests of each mutant
BREAK | 0..1 | 1: break the RTL of each proof; the proof must then fail
NIGHT | 0..1 | 1: all proofs, including the long ones
FILE | any | recording of a failed random test
SIM | any | for board: its settings (docs/virtual_board.md); for test-verilog: icarus
VERILATOR | any | another Verilator
TOP | any | only this top module
PARAMS | any | parameters of TOP: NAME=VALUE,…
PEERS | any | folder of other open designs to compare
SKIP | any | steps that a trial release omits
ONLY | any | bitstreams of a trial release
XTAL_HZ | 1000000..16000000 | crystal of the replaced chip in Hz
TIMING | FAST DATASHEET | processing times
PHASE_IDLE | 0..1 | level of the phases before the first initialisation
PHASE_ON | 0..1 | level of an energised phase
READ_MAP | SHEET FAMILY | read codes of the STMC
BAUD | 1200..3000000 | rate of the UART after reset
RECORD | record | 2**RECORD records; 0: no recorder
"""
OTHER_VALUES = {
    **dict.fromkeys(("board", "bitstream", "flash"), ("PART", "part carrier line")),
    **dict.fromkeys(("demo", "bench"), ("PART", "part demo")),
    "soak": ("PART", "part soak"),
    "trace": ("PART", "part folders"),
    "test-verilog": ("SIM", "icarus own cocotb"),
}
"""Variables whose values differ from VARIABLES for one target: target, variable, permitted values."""

FORMS = {
    "any": ("(?s:.*)", ""),
    "scheduler": ("tcp://[A-Za-z0-9_.:-]+:[0-9]+", "tcp://host:port"),
    "record": ("0|[4-9]|1[0-6]", "0, or 4 to 16"),
    "tests": (
        r"(?!(and|or|not)$)[A-Za-z0-9_.:-]+(,[A-Za-z0-9_.:-]+)*",
        "parts of test names (letters, digits and _ . : -), separated by commas",
    ),
}
"""For each form of a value, its pattern, and its description in an error."""


@dataclass(frozen=True)
class Target:
    """A row of the table.

    Attributes:
        kind: section in the list of targets: use, work or measure.
    """

    kind: str
    groups: tuple[str, ...]
    says: str
    command: str

    @property
    def defaults(self) -> dict[str, str]:
        """Variables of the command, with their defaults, which may be empty."""
        found: dict[str, str] = {}
        for name, default in re.findall(r"\{([A-Z_]+)(?:/or|:([^}]*))?\}", self.command):
            found[name] = found.get(name) or default
        return found


@dataclass(frozen=True)
class Variable:
    """A variable of the command line. Its values are a range, words, or a key that `fault` resolves."""

    values: str
    says: str

    @property
    def flag(self) -> bool:
        """True if the variable is a flag: 1 switches an option on."""
        return self.says.startswith("1: ")


def _targets() -> dict[str, Target]:
    found = {}
    for section in TABLE.strip().split("\n\n"):
        kind, _, text = section.partition("\n")
        row = r"^(\S.*?) \|(.*)\| (.*)\n((?:    .*(?:\n|$))+)"
        for name, groups, says, command in re.findall(row, text, re.M):
            for short, full in SHORT.items():
                command = command.replace(f"{{{short}}}", full)
            found[name] = Target(kind, tuple(groups.split()), says, " ".join(command.split()))
    return found


TARGETS = _targets()
VARIABLES = {
    name: Variable(*rest) for name, *rest in (row.split(" | ") for row in VARIABLE_TABLE.strip().split("\n"))
}


def boards() -> dict[str, dict[str, list[str]]]:
    """Return the hosts by board and part, from `devices` in the board descriptions, without PyYAML."""
    found = {}
    for path in sorted(ROOT.glob("constraints/*/board.yml")):
        text = path.read_text(encoding="utf-8")
        sections = dict(re.findall(r"^(\w+):.*\n((?:(?:[ #].*)?\n)*)", text, re.M))
        hosts: dict[str, list[str]] = {}
        for name, body in re.findall(r"^  ([\w-]+):.*\n((?:(?:   .*| *#.*)?\n)*)", sections["parts"], re.M):
            keys = dict(re.findall(r"^    (of|hosts): \[?([^]\n]*)", body, re.M))
            hosts.setdefault(keys.get("of", name), []).extend(keys["hosts"].split(", "))
        for device in re.findall(r"^  ([\w-]+):", sections.get("devices", ""), re.M):
            found[device] = hosts
    return found


def limits(name: str, part: str, default: str) -> list[int]:
    """Return the range of a variable; for a parameter, it is in the header of the part's top."""
    if part in parts.PARTS:
        figure = r"(\d+(?: \d{3})*(?:e\d+)?)"
        for path in ROOT.glob(f"rtl/*/{parts.PARTS[part].top}.sv"):
            line = rf"^ *parameter [^/]*\b{name}\b[^/]*//.*?{figure} \.\. {figure}"
            if found := re.search(line, path.read_text(encoding="utf-8"), re.M):
                return [int(float(text.replace(" ", ""))) for text in found.groups()]
    return [int(text) for text in default.split("..")]


def part_names(columns: list[str]) -> list[str]:
    """Return the parts with an entry in one of these columns.

    `tops` alone selects the parts with their own top module, `folders` alone those with their own folders.
    For `soak` alone, the name `all` is added.
    """
    if columns in (["tops"], ["folders"]):
        return [row.name for row in (parts.tops() if columns == ["tops"] else parts.folders())]
    found = [row.name for row in parts.PARTS.values() if any(getattr(row, column) for column in columns)]
    return [*found, *(["all"] if columns == ["soak"] else [])]


def fault(name: str, values: Mapping[str, str], target: str) -> str:
    """Return what is wrong with the value of a variable, as text; empty if the value is valid.

    Args:
        values: values of all variables.
    """
    value, allowed = values[name], VARIABLES[name].values
    other, there = OTHER_VALUES.get(target, ("", ""))
    kind, *words = (there if other == name else allowed).split()
    if kind in ("part", "board"):
        names = part_names(words) if kind == "part" else list(boards())
        return "" if value in names else f"no such {kind} (known: {','.join(names)})"
    if kind == "host":
        board, part = values["BOARD"], values["PART"]
        # If the board does not support the part, the build reports this.
        hosts = boards()[board].get(part, [value])
        return (
            "" if value in hosts else f"{board} with {part} has only {','.join(hosts)}; choose one of these"
        )
    if ".." in kind:
        low, high = limits(name, values.get("PART", ""), kind)
        good = re.fullmatch("[0-9]{1,12}", value) and low <= int(value) <= high
        return "" if good else f"expected a whole number from {low} to {high}"
    pattern, expected = FORMS.get(kind, ("|".join([kind, *words]), " or ".join([kind, *words])))
    return "" if re.fullmatch(pattern, value) else f"expected {expected}"


def main() -> int:
    """Print targets and variables."""
    print("OpenPPMC: make TARGET [VARIABLE=VALUE …]")
    for kind in ("use", "work", "measure"):
        print(f"\n{kind}:")
        for name, target in TARGETS.items():
            if target.kind == kind:
                shown = (f"{v}={d}" if d and " " not in d else v for v, d in target.defaults.items())
                print(f"  {name:18} {target.says:66} {' '.join(shown)}".rstrip())
    print("\nvariables:", *(f"  {name:18} {row.says}" for name, row in VARIABLES.items()), sep="\n")
    print(f"\nParts: {' '.join(parts.PARTS)}\nBoards: {' '.join(boards())}")
    return 0


if __name__ == "__main__":
    sys.exit(streams.guarded(main))
