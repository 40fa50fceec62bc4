"""What every script needs to know of the project: folders, parts, the RTL source list, the console."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from openppmc import sources as rtl_list
from openppmc import streams
from openppmc.parts import PARTS, Row
from openppmc.sources import Group

ROOT = Path(__file__).resolve().parents[2]
RTL = ROOT / "rtl"
BUILD = ROOT / "build"
DOCS = ROOT / "docs"

# Logs get lines as long as they are; tables in them are not squeezed.
console = Console(highlight=False, width=None if sys.stdout and sys.stdout.isatty() else 160)


class ProjectError(Exception):
    """A mistake of the user or of the set-up; its text is the one line that is shown."""


def part(name: str) -> Row:
    """The part called `name`, from the table of parts; ProjectError lists those that there are."""
    if name not in PARTS:
        raise ProjectError(f"PART={name}: no such part (known: {', '.join(PARTS)})")
    return PARTS[name]


def listed() -> dict[str, Group]:
    """rtl/files.yml: the groups of RTL sources, in compile order, with absolute paths."""
    try:
        return rtl_list.groups(ROOT)
    except rtl_list.SourcesError as error:
        raise ProjectError(str(error)) from None


def files(*groups: str) -> list[Path]:
    """The RTL of these groups and of what they need, in compile order; ProjectError for a missing file."""
    try:
        return rtl_list.files(listed(), *groups)
    except rtl_list.SourcesError as error:
        raise ProjectError(str(error)) from None


def sources(of: Row) -> list[Path]:
    """The RTL of a part in compile order; ProjectError when a listed file is not there."""
    return files(of.rtl)


def board_files(part_name: str) -> list[Path]:
    """What a part's carrier is made of besides the part, in compile order; none if it has no carrier."""
    of = part(part_name)
    if not of.carrier:
        return []
    own = set(sources(of))
    return [path for path in files(f"{of.rtl}_carrier") if path not in own]


def top_file(of: Row) -> Path:
    """The file of a part's top module; ProjectError when it is not in rtl/files.yml."""
    found = next((path for path in sources(of) if path.stem == of.top), None)
    if found is None:
        raise ProjectError(f"rtl/files.yml: the files of {of.name} lack its top, {of.top}")
    return found


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
    """Run a script's `main`: a ProjectError and Ctrl-C become one line and a non-zero exit code.

    Its stdout may have any encoding, be closed, or lose its reader (`openppmc.streams`).
    """
    return streams.guarded(lambda: _run(main))


def _run(main: Callable[[], int]) -> int:
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
    text = page.read_text() if page.is_file() else "# Benchmarks\n"
    page.write_text(replace_between(text, marker, body))
