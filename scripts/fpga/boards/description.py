"""The descriptions of the boards, constraints/<board>/board.yml: permitted keys and their values.

docs/boards.md explains the keys in chapter 11, Another board or part. An unknown or missing key raises an
error of one line.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import yaml

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError
from openppmc import parts as table

FOLDER = project.ROOT / "constraints"
HOSTS = ("uart", "bus", "spi")
SHOWS = ("link", "moving", "switch", "running")
"""States that an LED can indicate, in the order of the bits of leds_o of ppmc_board_leds."""

LANGUAGES = {
    "ice40": ("pcf", "pdc"),
    "ecp5": ("lpf",),
    "gowin": ("cst",),
    "artix7": ("xdc",),
    "cyclone5": ("qsf",),
    "trion": ("isf",),
}
"""Suffixes of the pin files, by FPGA family. The first suffix is that of the tool in the table of boards."""

# Required keys and optional keys, by section.
KEYS = {
    "board": (
        "title place chip family clock leds uart pads headers parts",
        "revisions code devices vendor suffix loader port reset ties defaults statements buffers",
    ),
    "device": ("title device route", "chip"),
    "vendor": ("tool device", "family grade target"),
    "clock": ("port pin mhz what", "module set"),
    "reset": ("port pin active what", "pull"),
    "leds": ("active pins", ""),
    "led": ("port pin shows what", ""),
    "uart": ("title rxd txd", ""),
    "line": ("pin what", ""),
    "tie": ("pin level what reason", ""),
    "pads": ("standard", "drive exceptions"),
    "buffers": ("level inputs", ""),
    "statements": ("reason lines", ""),
    "part": ("mhz hosts pins", "of goal recipe pll set omit low note leds"),
}


@dataclass(frozen=True)
class Device:
    """One of the FPGAs with which the board is sold, for the tools of `make setup`.

    Attributes:
        name: value of BOARD.
    """

    name: str
    title: str
    device: str
    route: tuple[str, ...]
    chip: str = ""


@dataclass(frozen=True)
class Carried:
    """A part on a board.

    Attributes:
        name: name of the folder of the top: the name of the part, with or without the host.
        part: value of PART.
        mhz: frequency of `clk` in MHz.
        goal: minimum frequency in MHz that the project requires.
        pll, set: parameters of the clock module and of the carrier.
        omit: parameters of the carrier that have no effect on this board.
        low: inputs without a pin that read as 0, with reasons; all other inputs without a pin read as 1.
        pins: header pins, by title of the group and by signal.
    """

    name: str
    part: str
    mhz: float
    goal: float
    hosts: tuple[str, ...]
    pins: dict[str, dict[str, tuple[str, ...]]]
    recipe: str = ""
    pll: Mapping[str, Any] | None = None
    set: Mapping[str, Any] | None = None
    omit: Mapping[str, str] | None = None
    low: Mapping[str, str] | None = None
    note: str = ""
    leds: bool = True

    @property
    def row(self) -> table.Row:
        """The part in the table of parts."""
        return table.part(self.part)


@dataclass(frozen=True)
class Description:
    """A whole board.yml; sections that only one generator reads are kept in their original form."""

    name: str
    path: Path
    title: str
    place: int
    chip: str
    family: str
    devices: tuple[Device, ...]
    vendor: Mapping[str, str]
    clock: Mapping[str, Any]
    leds: Mapping[str, Any]
    uart: Mapping[str, Any]
    ties: Mapping[str, Mapping[str, Any]]
    pads: Mapping[str, Any]
    statements: Mapping[str, Any]
    headers: dict[str, str]
    parts: tuple[Carried, ...]
    reset: Mapping[str, Any] = field(default_factory=dict)  # empty for a board without a button
    revisions: str = ""  # board revisions for which the pins were checked
    code: str = ""
    suffix: str = ""
    loader: str = ""
    port: str = ""
    defaults: Mapping[str, Any] = field(default_factory=dict)
    buffers: Mapping[str, str] = field(default_factory=dict)  # empty if the headers lead to the FPGA

    @property
    def source(self) -> str:
        """The path of the file, for messages and headers of generated files."""
        return f"constraints/{self.name}/board.yml"

    def top(self, on: Carried) -> str:
        """Return the name of the top with this part."""
        return f"board_{self.name}_{on.name.replace('-', '_')}"

    @property
    def languages(self) -> tuple[str, ...]:
        """Suffixes of the pin files, including those of a vendor's tool if such a tool supports the board."""
        return LANGUAGES[self.family][: None if self.vendor else 1]

    def constraints(self, on: Carried, language: str = "") -> str:
        """Return the path, below constraints/, of a pin file for this part; by default, of the first one."""
        return f"{self.name}/{on.name}/pins.{language or self.languages[0]}"


def checked(where: str, section: str, found: Any) -> dict[str, Any]:
    """Return a section; raise ProjectError if a required key is missing or a key is unknown."""
    must, may = (keys.split() for keys in KEYS[section])
    if not isinstance(found, dict):
        raise ProjectError(f"{where}: expected keys ({', '.join(must + may)})")
    for key in found:
        if key not in must + may:
            raise ProjectError(f"{where}: unknown key {key} (known: {', '.join(must + may)})")
    for key in must:
        if key not in found:
            raise ProjectError(f"{where}: {key} is missing")
    return found


def headers(where: str, found: Any) -> dict[str, str]:
    """Return the package pin of each header pin.

    If the entry of a header is a list, the numbers on the header are those of the package pins.
    """
    pins: dict[str, str] = {}
    for header, named in found.items():
        for name, pin in named.items() if isinstance(named, dict) else ((f"pin {n}", n) for n in named):
            if str(name) in pins:
                raise ProjectError(f"{where}: {header}: {name} is there twice")
            pins[str(name)] = str(pin)
    return pins


def carried(where: str, name: str, found: Any) -> Carried:
    """Return one entry below `parts`."""
    keys = dict(checked(where, "part", found))
    part = keys.pop("of", name)
    try:
        table.part(part)
    except table.UnknownPartError as error:
        raise ProjectError(f"{where}: {error}") from None
    for host in keys["hosts"]:
        if host not in HOSTS:
            raise ProjectError(f"{where}: hosts: {host}: expected {', '.join(HOSTS)}")
    keys["pins"] = {
        title: {
            signal: tuple(
                f"pin {pin}" if isinstance(pin, int) else pin
                for pin in (at if isinstance(at, list) else [at])
            )
            for signal, at in group.items()
        }
        for title, group in keys["pins"].items()
    }
    keys["hosts"] = tuple(keys["hosts"])
    return Carried(name=name, part=part, goal=keys.pop("goal", keys["mhz"]), **keys)


def load(path: Path) -> Description:
    """Read one board.yml; the board has the name of its folder."""
    name = path.parent.name
    where = f"constraints/{name}/board.yml"
    try:
        found = yaml.safe_load(path.read_text(encoding="utf-8"))
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        raise ProjectError(f"{where}: line {line}: {error.problem}") from None
    keys = dict(checked(where, "board", found))
    if "devices" not in keys and "vendor" not in keys:
        raise ProjectError(f"{where}: expected devices (built here) or vendor (by the vendor's tool)")
    if keys["family"] not in LANGUAGES:
        raise ProjectError(f"{where}: family {keys['family']}: expected {', '.join(LANGUAGES)}")
    for section in ("clock", "leds", "uart", "pads", *(["reset"] if "reset" in keys else [])):
        checked(f"{where}: {section}", section, keys[section])
    for led in keys["leds"]["pins"]:
        if checked(f"{where}: leds", "led", led)["shows"] not in SHOWS:
            raise ProjectError(f"{where}: leds: shows {led['shows']}: expected {', '.join(SHOWS)}")
    for line in ("rxd", "txd"):
        checked(f"{where}: uart: {line}", "line", keys["uart"][line])
    for tie, found in keys.setdefault("ties", {}).items():
        checked(f"{where}: ties: {tie}", "tie", found)
    for section in ("vendor", "statements", "buffers"):
        keys[section] = checked(f"{where}: {section}", section, keys[section]) if section in keys else {}
    devices = [
        Device(name=str(known), **{**checked(f"{where}: devices: {known}", "device", found)})
        for known, found in keys.pop("devices", {}).items()
    ]
    for key in ("code", "suffix", "loader", "port"):
        if devices and key not in keys:
            raise ProjectError(f"{where}: {key} is missing")
    keys["headers"] = headers(f"{where}: headers", keys["headers"])
    keys["parts"] = tuple(
        carried(f"{where}: parts: {part}", part, found) for part, found in keys["parts"].items()
    )
    return Description(name=name, path=path, devices=tuple(devices), **keys)


@cache
def load_all(folder: Path = FOLDER) -> tuple[Description, ...]:
    """Return every board, sorted by `place`."""
    found = (load(path) for path in sorted(folder.glob("*/board.yml")))
    return tuple(sorted(found, key=lambda board: (board.place, board.name)))
