"""Generated files: a script writes them or, with --check, compares them with the existing files."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Mapping
from pathlib import Path

from cocotb_tests.harness.project import ProjectError, console, relative


def parser(target: str, about: str | None) -> argparse.ArgumentParser:
    """Return the command line of `make <target>`, with the option --check."""
    made = argparse.ArgumentParser(prog=target, description=about)
    made.add_argument("--check", action="store_true", help="write nothing, fail if a file is outdated")
    return made


def stale(files: Mapping[Path, str | bytes]) -> list[Path]:
    """Return the files that are missing or have another content."""
    return [
        path for path, content in files.items() if not path.is_file() or path.read_bytes() != raw(content)
    ]


def current(target: str, files: Mapping[Path, str | bytes]) -> None:
    """Raise ProjectError if a file of `make <target>` is outdated."""
    for path in stale(files):
        raise ProjectError(f"{relative(path)} is outdated; run `make {target}`")


def raw(content: str | bytes) -> bytes:
    """Return the content of a file as bytes."""
    return content.encode() if isinstance(content, str) else content


def update(target: str, files: Mapping[Path, str | bytes], check: bool, unused: Iterable[Path] = ()) -> int:
    """Write the files of `make <target>` and remove the files `unused`; return the exit code.

    With `check`, nothing is changed, and the exit code is 1 if a file is outdated.
    """
    changes = dict.fromkeys(stale(files), "written") | dict.fromkeys(unused, "removed")
    for path, change in changes.items():
        console.print(f"{'outdated' if check else change}: {relative(path)}")
        if check:
            continue
        if change == "removed":
            path.unlink()
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(raw(files[path]))
    console.print(f"{len(files)} generated files, {len(changes)} {'outdated' if check else 'changed'}")
    if check and changes:
        console.print(f"run `make {target}`")
    return int(check and bool(changes))
