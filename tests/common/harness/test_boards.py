"""Board tops agree with their constraint files: ports, pins, pull-ups, clocks."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import pytest

from cocotb_tests.harness import project
from scripts.fpga.flow import boards
from scripts.fpga.flow.boards import BY_PART, HOSTS

CONSTRAINTS = project.ROOT / "constraints"
TOPS = project.RTL / "boards"

# Clock input of each board, and the frequency of this clock in MHz.
OSCILLATORS = {
    "icebreaker": ("clk_12m", 12),
    "icestick": ("clk_12m", 12),
    "ulx3s": ("clk_25m", 25),
    "ulx3s_v31": ("clk_25m", 25),
    "colorlight_v70": ("clk_25m", 25),
    "tangnano4k": ("clk_27m", 27),
    "tangnano9k": ("clk_27m", 27),
    "tangnano20k": ("clk_27m", 27),
    "arty_a7": ("clk", 100),
    "de10nano": ("clk", 50),
    "xyloni": ("clk", 33.33),
}
APART = (".cst", ".qsf", ".isf")  # formats whose clock constraints are in clocks.sdc


def entries() -> list[tuple[str, str, str, str, float]]:
    """Return (top module, pin file, clock file, clock input, frequency of this clock in MHz) for each pin
    file in the tree.
    """
    found = []
    for path in sorted(CONSTRAINTS.glob("*/*/pins.*")):
        board, part = path.parts[-3:-1]
        clocks = path.with_name("clocks.sdc") if path.suffix in APART else path
        names = [file.relative_to(CONSTRAINTS).as_posix() for file in (path, clocks)]
        found.append((f"board_{board}_{part.replace('-', '_')}", *names, *OSCILLATORS[board]))
    return found


ALL = entries()
EVERY = [on for known in BY_PART.values() for on in known.values()]
IDS = [entry[1] for entry in ALL]

# statement of each format that assigns a port to a pin
PIN = {
    ".pcf": re.compile(r"^set_io +(?:-pullup +yes +)?(?P<port>\S+) +(?P<pin>\S+)", re.M),
    ".lpf": re.compile(r'^LOCATE COMP "(?P<port>[^"]+)" SITE "(?P<pin>[^"]+)";', re.M),
    ".cst": re.compile(r'^IO_LOC "(?P<port>[^"]+)" (?P<pin>\w+);', re.M),
    ".xdc": re.compile(r"PACKAGE_PIN (?P<pin>\w+) .*get_ports \{(?P<port>[^}]+)\}", re.M),
    ".qsf": re.compile(r"^set_location_assignment PIN_(?P<pin>\w+) -to \{(?P<port>[^}]+)\}", re.M),
    ".pdc": re.compile(r"^ldc_set_location -site \{(?P<pin>\w+)\} \[get_ports \{(?P<port>[^}]+)\}\]", re.M),
    ".isf": re.compile(r'^design\.assign_pkg_pin\("(?P<port>[^"]+)", "(?P<pin>\w+)"\)', re.M),
}
PULLED_UP = {
    ".pcf": r"^set_io +-pullup +yes +{}\s",
    ".lpf": r'IOBUF PORT "{}" PULLMODE=UP ',
    ".cst": r'^IO_PORT "{}" IO_TYPE=LVCMOS\d+ PULL_MODE=UP',
    ".xdc": r"PULLUP TRUE\}} \[get_ports \{{{}\}}\]",
    ".qsf": r"^set_instance_assignment -name WEAK_PULL_UP_RESISTOR ON -to \{{{}\}}$",
    ".pdc": r"^ldc_set_port -iobuf \{{[^}}]* PULLMODE=100K\}} \[get_ports \{{{}\}}\]",
    ".isf": r'^design\.set_property\("{}", "PULL_OPTION", "WEAK_PULLUP"\)$',
}
MHZ = {
    ".pcf": re.compile(r"^set_frequency (?P<port>\S+) (?P<mhz>[\d.]+)", re.M),
    ".lpf": re.compile(r'^FREQUENCY PORT "(?P<port>[^"]+)" (?P<mhz>[\d.]+) MHZ;', re.M),
}
NS = re.compile(r"^create_clock -name \S+ -period (?P<ns>[\d.]+) \[get_ports \{(?P<port>\S+)\}\]", re.M)


@dataclass(frozen=True)
class Port:
    """A port of a top, with the names of its bits."""

    direction: str
    bits: tuple[str, ...]


def ports_of(text: str) -> dict[str, Port]:
    """Return the ports that a top's source declares, one per line."""
    found = {}
    pattern = r"^ +(input|output|inout) +(?:wire )?logic *(?:\[ *(\d+): *(\d+)\])? +(\w+)"
    for direction, high, low, name in re.findall(pattern, text, re.M):
        assert name not in found, f"{name} is declared twice"
        bits = [f"{name}[{bit}]" for bit in range(int(low), int(high) + 1)] if high else [name]
        found[name] = Port(direction, tuple(bits))
    return found


def source(top: str) -> Path:
    """Return the path of a top."""
    (path,) = TOPS.glob(f"*/{top}.sv")
    return path


def ports(top: str) -> dict[str, Port]:
    """Return the ports of a top in rtl/boards."""
    return ports_of(source(top).read_text())


def pins(text: str, suffix: str) -> list[tuple[str, str]]:
    """Return the (port, pin) pairs of a constraint file's text."""
    return [(match["port"], match["pin"]) for match in PIN[suffix].finditer(text)]


def clocks(text: str, suffix: str) -> dict[str, float]:
    """Return the clock constraints of a file: port and MHz."""
    if suffix in MHZ:
        return {match["port"]: float(match["mhz"]) for match in MHZ[suffix].finditer(text)}
    return {match["port"]: 1000 / float(match["ns"]) for match in NS.finditer(text)}


def test_every_top_has_a_constraint_file() -> None:
    assert {path.stem for path in TOPS.rglob("board_*.sv")} == {entry[0] for entry in ALL}
    used = {name for entry in ALL for name in entry[1:3]} | {f"{board}/board.yml" for board in OSCILLATORS}
    there = [path for path in CONSTRAINTS.rglob("*") if path.is_file()]
    assert {path.relative_to(CONSTRAINTS).as_posix() for path in there} == used


@pytest.mark.parametrize("on", EVERY, ids=[on.stem("uart") for on in EVERY])
def test_files_of_a_board_are_checked_here(on: boards.Board) -> None:
    """The tests of this file cover each constraint file that `make bitstream` uses, with the same
    oscillator.
    """
    for host in on.top:
        (entry,) = (entry for entry in ALL if entry[1] == on.constraints[host])
        assert entry[0] == on.top[host]
        assert entry[3:] == on.oscillator


@pytest.mark.parametrize(("top", "file", "clock_file", "clock", "mhz"), ALL, ids=IDS)
def test_ports_and_pins(top: str, file: str, clock_file: str, clock: str, mhz: float) -> None:
    path = CONSTRAINTS / file
    text = path.read_text()
    pairs = pins(text, path.suffix)
    expected = sorted(bit for port in ports(top).values() for bit in port.bits)
    assert sorted(port for port, _ in pairs) == expected
    sites = [pin for _, pin in pairs]
    assert sorted(set(sites)) == sorted(sites), "a pin is used twice"

    constraints = clocks((CONSTRAINTS / clock_file).read_text(), Path(clock_file).suffix)
    assert list(constraints) == [clock]
    assert constraints[clock] == pytest.approx(mhz, rel=1e-4)


@pytest.mark.parametrize(("top", "file", "clock_file", "clock", "mhz"), ALL, ids=IDS)
def test_open_inputs_are_pulled_up(top: str, file: str, clock_file: str, clock: str, mhz: float) -> None:
    path = CONSTRAINTS / file
    text = path.read_text()
    buttons = {
        "btn",
        "btn_f1",
        "key_n",
    }  # key_n has a resistor and a Schmitt trigger; the other buttons have a pull-down
    for name, port in ports(top).items():
        if name in buttons | {clock}:
            continue
        for bit in port.bits:
            pulled = re.search(PULLED_UP[path.suffix].format(re.escape(bit)), text, re.M) is not None
            assert pulled == (port.direction != "output"), f"{file}: {bit}"


@pytest.mark.parametrize(("top", "file"), [entry[:2] for entry in ALL], ids=IDS)
def test_table_of_the_pins(top: str, file: str) -> None:
    """docs/boards.md lists each port with its pin and direction, once for all tools."""
    page = (project.DOCS / "boards.md").read_text()
    name = file.replace(".pdc", ".pcf")
    table = page.split(f"<!-- pins {name} -->")[1].split(f"<!-- /pins {name} -->")[0]
    told = re.findall(r"^\| `([^`]+)` \| ([a-z, ]+) \| (\w+) \|", table, re.M)
    words = {"input": "in", "output": "out", "inout": "in, out"}
    direction = {bit: words[port.direction] for port in ports(top).values() for bit in port.bits}
    expected = [
        (bit, direction[bit], pin) for bit, pin in pins((CONSTRAINTS / file).read_text(), Path(file).suffix)
    ]
    assert sorted(told) == sorted(expected)


@pytest.mark.parametrize("on", EVERY, ids=[on.stem("uart") for on in EVERY])
def test_clock_of_the_top(on: boards.Board) -> None:
    for top in on.top.values():
        text = source(top).read_text()
        found = re.search(r"localparam int unsigned ClkHz = ([\d_]+);", text)
        assert found
        assert int(found[1].replace("_", "")) == on.clk_hz
    assert on.clk_hz / 1e6 >= on.goal_mhz


@pytest.mark.parametrize("host", HOSTS)
@pytest.mark.parametrize("on", EVERY, ids=[on.stem("uart") for on in EVERY])
def test_sources_of_a_board(on: boards.Board, host: str) -> None:
    if host not in on.top:
        with pytest.raises(
            project.ProjectError, match=f"HOST={host}: {on.name} with {on.part} has only uart"
        ):
            boards.check_host(on, host)
        return
    files = boards.sources(on.top[host])
    assert boards.part_of(on.top[host]) == on.part
    others = {f"{part}_carrier" for part in BY_PART if part != on.part.split("-")[0]}
    assert not others & {path.stem for path in files}
    assert all(path.is_file() for path in files)
    assert [path.stem for path in files if path.stem.startswith("board_")] == [on.top[host]]
