"""Data of the project that all scripts use: folders, devices, list of RTL sources, console."""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
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

# Lines in logs are not wrapped, and tables in them are not narrowed.
console = Console(highlight=False, width=None if sys.stdout and sys.stdout.isatty() else 160)


class ProjectError(Exception):
    """A mistake of the user or of the set-up; its text is the line that is shown to the user."""


def part(name: str) -> Row:
    """Return the device called `name` from the table of parts; a ProjectError lists the existing devices."""
    if name not in PARTS:
        raise ProjectError(f"PART={name}: no such part (known: {', '.join(PARTS)})")
    return PARTS[name]


def listed() -> dict[str, Group]:
    """Return the groups of RTL sources in rtl/files.yml, in compile order, with absolute paths."""
    try:
        return rtl_list.groups(ROOT)
    except rtl_list.SourcesError as error:
        raise ProjectError(str(error)) from None


def files(*groups: str) -> list[Path]:
    """Return the RTL of these groups and their dependencies, in compile order.

    Raises ProjectError if a listed file is missing.
    """
    try:
        return rtl_list.files(listed(), *groups)
    except rtl_list.SourcesError as error:
        raise ProjectError(str(error)) from None


def sources(of: Row) -> list[Path]:
    """Return the RTL of a device in compile order; raise ProjectError if a listed file is missing."""
    return files(of.rtl)


def board_files(part_name: str) -> list[Path]:
    """Return the files of a carrier except those of its device, in compile order; empty without a carrier."""
    of = part(part_name)
    if not of.carrier:
        return []
    own = set(sources(of))
    return [path for path in files(f"{of.rtl}_carrier") if path not in own]


def top_file(of: Row) -> Path:
    """Return the file of a device's top module; raise ProjectError if it is not in rtl/files.yml."""
    found = next((path for path in sources(of) if path.stem == of.top), None)
    if found is None:
        raise ProjectError(f"rtl/files.yml: the files of {of.name} lack its top, {of.top}")
    return found


def include_dirs() -> list[Path]:
    """Return the folders in which `include files are searched."""
    return [RTL / "common"]


def relative(path: Path) -> str:
    """Return `path` relative to the project root, for messages and for tools that start there."""
    resolved = path.resolve()
    return resolved.relative_to(ROOT).as_posix() if resolved.is_relative_to(ROOT) else str(path)


def tool(name: str) -> str:
    """Return the path of a program in this Python environment; if it is not there, its name, for PATH."""
    return shutil.which(name, path=str(Path(sys.executable).parent)) or name


def ran(command: Sequence[str], env: Mapping[str, str] | None = None, cwd: Path = ROOT) -> tuple[int, str]:
    """Run a tool without input; return its exit code, and its output and errors as one text."""
    done = subprocess.run(
        command,
        cwd=cwd,
        env=env,
        text=True,
        errors="replace",
        check=False,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    return done.returncode, done.stdout


def fail(message: str) -> int:
    """Print one red line and return the exit code 1."""
    Console(stderr=True, highlight=False, soft_wrap=True).print(f"[bold red]error:[/] {escape(message)}")
    return 1


def run(main: Callable[[], int], arguments: str | None = None) -> int:
    """Run the `main` of a script: a ProjectError or Ctrl-C prints one line and returns a non-zero exit code.

    The stdout of the script may have any encoding, be closed, or lose its reader (`openppmc.streams`).

    Args:
        arguments: for a script without a parser, the names of its arguments: `JOB`, `[JOB]`, or `JOB...` for
            several. Their number is checked, and --help prints them.
    """
    return streams.guarded(lambda: _run(main, arguments))


def _check_arguments(names: str) -> None:
    script = sys.modules["__main__"]
    name = script.__spec__.name.removesuffix(".__main__") if script.__spec__ else sys.argv[0]
    parser = argparse.ArgumentParser(
        prog=f"python -m {name}",
        description=script.__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    for one in names.split():
        count = "?" if one[0] == "[" else "+" if one.endswith("...") else None
        parser.add_argument(one.strip("[].").lower(), metavar=one.strip("[]."), nargs=count)
    parser.parse_args()


def _run(main: Callable[[], int], arguments: str | None) -> int:
    try:
        if arguments is not None:
            _check_arguments(arguments)
        return main()
    except ProjectError as error:
        return fail(str(error))
    except ModuleNotFoundError as error:
        if not error.name or (ROOT / error.name.partition(".")[0]).is_dir():
            raise
        return fail(f"{error.name} is not installed in .venv; `make` installs it unless .venv is a link")
    except KeyboardInterrupt:
        fail("interrupted")
        return 130


def replace_between(text: str, marker: str, body: str) -> str:
    """Replace the text between ``<!-- marker -->`` and ``<!-- /marker -->``, or append the block."""
    start, end = f"<!-- {marker} -->", f"<!-- /{marker} -->"
    block = f"{start}\n{body.strip()}\n{end}"
    if start in text and end in text:
        head, rest = text.split(start, 1)
        return head + block + rest.split(end, 1)[1]
    return text.rstrip() + "\n\n" + block + "\n"


def update_benchmarks(marker: str, body: str) -> None:
    """Replace one generated block of docs/benchmarks.md; create the page if it is missing."""
    page = DOCS / "benchmarks.md"
    page.parent.mkdir(exist_ok=True)
    text = page.read_text() if page.is_file() else "# Benchmarks\n"
    page.write_text(replace_between(text, marker, body))
