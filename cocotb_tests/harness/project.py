"""What every script needs to know of the project: folders, parts, the RTL source list, the console."""

from __future__ import annotations

import re
import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import yaml
from rich.console import Console
from rich.markup import escape

ROOT = Path(__file__).resolve().parents[2]
RTL = ROOT / "rtl"
BUILD = ROOT / "build"
DOCS = ROOT / "docs"

BENCHMARKS_HEAD = """# Benchmarks

Figures between the markers are written by scripts: size and clock rate by `make synth PART=ppmc104` and
`make report`, other designs by `make yardsticks`, simulation speed by `make bench`.
"""

# Logs get lines as long as they are; tables in them are not squeezed.
console = Console(highlight=False, width=None if sys.stdout.isatty() else 160)


class ProjectError(Exception):
    """A mistake of the user or of the set-up; its text is the one line that is shown."""


@dataclass(frozen=True)
class Part:
    """One part of the family: its top module and the groups of rtl/files.yml that it is built of.

    `phase_idle`: the top has the parameter PHASE_IDLE. `families`: what it is made for; an iCE40 is too small
    for some.
    """

    name: str
    groups: tuple[str, ...]
    clk_hz: int = 16_000_000
    phase_idle: bool = False
    families: tuple[str, ...] = ("ecp5", "ice40")


SHARED = ("common", "motion", "host")
SINGLE = (*SHARED, "single")  # what the parts with one axis share
PARTS = {
    "ppmc104": Part("ppmc104", (*SINGLE, "ppmc104"), phase_idle=True),
    "ppmc2104": Part("ppmc2104", (*SHARED, "ppmc2104")),
    "isa_4axis": Part("isa_4axis", (*SHARED, "ppmc2104", "isa_4axis")),
    "stmc": Part("stmc", (*SINGLE, "stmc"), phase_idle=True),
    "ppmc312": Part("ppmc312", (*SHARED, "stage", "ppmc312"), families=("ecp5",)),
    "pmc006": Part("pmc006", ("common", "motion", "pmc006")),
    "j105_stmc": Part("j105_stmc", (*SINGLE, "stmc", "j105_stmc")),
}


def part(name: str) -> Part:
    """The part called `name`; ProjectError lists the known ones when there is no such part."""
    try:
        return PARTS[name]
    except KeyError:
        raise ProjectError(f"PART={name}: no such part (known: {', '.join(PARTS)})") from None


def file_groups() -> dict[str, list[Path]]:
    """rtl/files.yml: the groups of RTL sources, each in compile order, as absolute paths."""
    listing = RTL / "files.yml"
    if not listing.is_file():
        raise ProjectError("rtl/files.yml is missing: there is no list of RTL sources")
    groups: dict[str, list[str]] = yaml.safe_load(listing.read_text()) or {}
    return {group: [RTL / name for name in names or []] for group, names in groups.items()}


def sources(of: Part) -> list[Path]:
    """The RTL sources of a part in compile order; ProjectError when a listed file is not there."""
    groups = file_groups()
    files = [path for group in of.groups for path in groups.get(group, [])]
    missing = [path.relative_to(ROOT).as_posix() for path in files if not path.is_file()]
    if missing:
        raise ProjectError(f"rtl/files.yml lists files that do not exist: {', '.join(missing)}")
    return files


def board_files(part_name: str) -> list[Path]:
    """The carrier of a part and what it is built from; none if the part has no carrier."""
    return built_from(f"{part_name}_carrier")


def built_from(module: str) -> list[Path]:
    """A module of the group `boards` and what it is built from there, in compile order; none if unknown."""
    files = file_groups().get("boards", [])
    found = {path for path in files if path.stem == module}
    while True:
        text = "\n".join(path.read_text(encoding="utf-8") for path in found)
        more = {path for path in files if re.search(rf"^\s*{path.stem}\s", text, re.M)} - found
        if not more:
            return [path for path in files if path in found]
        found |= more


def include_dirs() -> list[Path]:
    """Folders searched for `include files."""
    return [RTL / "common"]


def relative(path: Path) -> str:
    """`path` as seen from the project's root, for messages and for tools that start there."""
    resolved = path.resolve()
    return resolved.relative_to(ROOT).as_posix() if resolved.is_relative_to(ROOT) else str(path)


def tool(name: str) -> str:
    """Path of a program of this Python environment, which PATH may lack; the name if it has none such."""
    return shutil.which(name, path=str(Path(sys.executable).parent)) or name


def fail(message: str) -> int:
    """Print one red line and return the exit code 1."""
    Console(stderr=True, highlight=False, soft_wrap=True).print(f"[bold red]error:[/] {escape(message)}")
    return 1


def run(main: Callable[[], int]) -> int:
    """Run a script's `main`: a ProjectError and Ctrl-C become one line and a non-zero exit code."""
    try:
        return main()
    except ProjectError as error:
        return fail(str(error))
    except KeyboardInterrupt:
        fail("interrupted")
        return 130


def replace_between(text: str, marker: str, body: str) -> str:
    """Put `body` between ``<!-- marker -->`` and ``<!-- /marker -->``; append the block if there is none."""
    start, end = f"<!-- {marker} -->", f"<!-- /{marker} -->"
    block = f"{start}\n{body.strip()}\n{end}"
    if start in text and end in text:
        head, rest = text.split(start, 1)
        return head + block + rest.split(end, 1)[1]
    return text.rstrip() + "\n\n" + block + "\n"


def update_benchmarks(marker: str, body: str) -> None:
    """Renew one generated block of docs/benchmarks.md, which is made when it is not there."""
    page = DOCS / "benchmarks.md"
    page.parent.mkdir(exist_ok=True)
    text = page.read_text() if page.is_file() else BENCHMARKS_HEAD
    page.write_text(replace_between(text, marker, body))
