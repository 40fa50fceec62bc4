"""The descriptions of the boards, constraints/<board>/board.yml: what they may say, and what they say.

Their keys are explained in docs/boards.md, section 11. A key that is unknown or missing is an error of one
line.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
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
"""What a lamp can show, in the order of the bits of ppmc_board_panel's lamps_o."""

LANGUAGES = {"ice40": "pcf", "ecp5": "lpf", "gowin": "cst", "artix7": "xdc", "cyclone5": "qsf"}
"""FPGA family -> how its constraint files end."""

# Section -> keys that it must have, keys that it may have.
KEYS = {
    "board": (
        "title place chip family clock reset lamps uart pads headers parts",
        "revisions code devices vendor suffix loader port ties defaults statements",
    ),
    "device": ("title device route", "chip"),
    "vendor": ("tool target device", "family"),
    "clock": ("port pin mhz what", "module set"),
    "reset": ("port pin active what", "pull"),
    "lamps": ("active pins", ""),
    "lamp": ("port pin shows what", ""),
    "uart": ("title rxd txd", ""),
    "line": ("pin what", ""),
    "tie": ("pin level what reason", ""),
    "pads": ("standard", "drive exceptions"),
    "statements": ("reason lines", ""),
    "part": ("mhz hosts pins", "of goal recipe pll set omit low note lamps"),
}


@dataclass(frozen=True)
class Device:
    """An FPGA that the board is sold with, for the tools of `make setup`. `name`: BOARD=."""

    name: str
    title: str
    device: str
    route: tuple[str, ...]
    chip: str = ""


@dataclass(frozen=True)
class Carried:
    """A part on a board. `name`: its folder, the part's name or that with its host; `part`: PART=.

    `mhz` is that of clk, `goal` the least that the project wants; `pll` and `set` are parameters of the clock
    module and the carrier, `omit` parameters of the carrier without effect here; `low` inputs without a pin
    that read 0 (the others read 1), each with its reason; `pins`: group title -> signal -> header pins.
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
    lamps: bool = True

    @property
    def row(self) -> table.Row:
        """The part in the table of parts."""
        return table.part(self.part)


@dataclass(frozen=True)
class Description:
    """A whole board.yml; sections that are only read by one writer stay as they are written."""

    name: str
    path: Path
    title: str
    revisions: str  # of the board, that the pins were compared for
    code: str
    place: int
    chip: str
    family: str
    devices: tuple[Device, ...]
    vendor: Mapping[str, str]
    suffix: str
    loader: str
    port: str
    clock: Mapping[str, Any]
    reset: Mapping[str, Any]
    lamps: Mapping[str, Any]
    uart: Mapping[str, Any]
    ties: Mapping[str, Mapping[str, Any]]
    pads: Mapping[str, Any]
    defaults: Mapping[str, Any]
    statements: Mapping[str, Any]
    headers: dict[str, str]
    parts: tuple[Carried, ...]

    @property
    def source(self) -> str:
        """Its file, for messages and heads of what is written from it."""
        return f"constraints/{self.name}/board.yml"

    def top(self, on: Carried) -> str:
        """Name of the top with this part."""
        return f"board_{self.name}_{on.name.replace('-', '_')}"

    @property
    def language(self) -> str:
        """How its constraint files end."""
        return LANGUAGES[self.family]

    def constraints(self, on: Carried) -> str:
        """The file of pins with this part, below constraints/."""
        return f"{self.name}/{on.name}/pins.{self.language}"


def checked(where: str, section: str, found: Any) -> dict[str, Any]:
    """A section with all keys that it must have and none that it may not have."""
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
    """Name of each header pin -> package pin; a list has the package pins' numbers printed at it."""
    pins: dict[str, str] = {}
    for header, named in found.items():
        for name, pin in named.items() if isinstance(named, dict) else ((f"pin {n}", n) for n in named):
            if str(name) in pins:
                raise ProjectError(f"{where}: {header}: {name} is there twice")
            pins[str(name)] = str(pin)
    return pins


def carried(where: str, name: str, found: Any) -> Carried:
    """One entry below `parts`."""
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
    """One board.yml; the board is called as its folder."""
    name = path.parent.name
    where = f"constraints/{name}/board.yml"
    try:
        found = yaml.safe_load(path.read_text(encoding="utf-8"))
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        raise ProjectError(f"{where}: line {line}: {error.problem}") from None
    keys = dict(checked(where, "board", found))
    if ("devices" in keys) == ("vendor" in keys):
        raise ProjectError(f"{where}: expected either devices (built here) or vendor (by the vendor's tool)")
    if keys["family"] not in LANGUAGES:
        raise ProjectError(f"{where}: family {keys['family']}: expected {', '.join(LANGUAGES)}")
    for section in ("clock", "reset", "lamps", "uart", "pads"):
        checked(f"{where}: {section}", section, keys[section])
    for lamp in keys["lamps"]["pins"]:
        if checked(f"{where}: lamps", "lamp", lamp)["shows"] not in SHOWS:
            raise ProjectError(f"{where}: lamps: shows {lamp['shows']}: expected {', '.join(SHOWS)}")
    for line in ("rxd", "txd"):
        checked(f"{where}: uart: {line}", "line", keys["uart"][line])
    for tie, found in keys.setdefault("ties", {}).items():
        checked(f"{where}: ties: {tie}", "tie", found)
    for section in ("vendor", "statements"):
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
    optional: dict[str, Any] = {
        "revisions": "",
        "code": "",
        "suffix": "",
        "loader": "",
        "port": "",
        "defaults": {},
    }
    return Description(name=name, path=path, devices=tuple(devices), **{**optional, **keys})


@cache
def load_all(folder: Path = FOLDER) -> tuple[Description, ...]:
    """Every board, in the order of its `place`."""
    found = (load(path) for path in sorted(folder.glob("*/board.yml")))
    return tuple(sorted(found, key=lambda board: (board.place, board.name)))
