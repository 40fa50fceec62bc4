"""Builds the program of the virtual board when its sources have changed: Verilator, make, g++."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from openppmc import parts, sources

from . import verilator
from .verilator import SimError

BOARDS = "rtl/boards"
KEEP_DAYS = 7
# Assertions would cost a third of the speed, and `make test` has them all.
# One C++ file: the precompiled header of split ones does not work with every Verilator.
VERILATE = (
    "--cc --exe --build -O3 --x-assign fast --x-initial fast --no-assert --threads 1 --output-split 0".split()
)


def find_root() -> Path:
    """The checkout of the project: OPENPPMC_ROOT, where this package lies, or the current folder."""
    named = os.environ.get("OPENPPMC_ROOT")
    here = Path.cwd()
    places = [Path(named)] if named else [Path(__file__).resolve().parents[3], here, *here.parents]
    for place in places:
        if (place / BOARDS).is_dir() and (place / "tb/board/main.cpp").is_file():
            return place.resolve()
    if named:
        raise SimError(f"OPENPPMC_ROOT={named}: no checkout of OpenPPMC there")
    raise SimError(
        "the virtual board is built from the RTL, so it needs a checkout of OpenPPMC: run the command "
        "in one, name one with OPENPPMC_ROOT, or use model: instead"
    )


def build(part: str, params: dict[str, int | str], trace: bool, say: Callable[[str], None]) -> Path:
    """The program for a part with a carrier, built if need be; `say` gets a line when that takes time.
    Raises SimError.

    params: of the board's top, CLK_HZ among them. trace: with waveforms, which makes a slower program. Safe
    against other processes doing the same.
    """
    if not sys.platform.startswith("linux"):
        raise SimError("the virtual board needs Linux (its pseudo-terminals): use model: instead")
    root = find_root()
    rtl, cpp = _rtl(root, part), sorted((root / "tb/board").glob("*.cpp"))
    own = parts.part(part).folder
    version = verilator.version()
    flags = [
        *VERILATE,
        *(["--trace-vcd"] if trace else []),
        *(
            "--top-module",
            f"{parts.part(part).rtl}_carrier",
            "--prefix",
            "Vboard",
            f"-I{root / 'rtl/common'}",
        ),
        *(
            f'-G{name}="{value}"' if isinstance(value, str) else f"-G{name}={value}"
            for name, value in params.items()
        ),
        *(
            "-CFLAGS",
            # pins.h of the part; as seen from the folder of the build, which is free of spaces.
            f"-std=c++17 {_defines(params)} -I../../../tb/{own} -I../../../tb/board",
            "-o",
            "board",
        ),
        # The makefile would append its own -Os for these files.
        *("-MAKEFLAGS", "OPT_FAST=-O2 OPT_GLOBAL=-O2 OPT_SLOW=-O2"),
    ]
    folder = root / "build/board" / _digest([*rtl, *cpp, *_headers(root, own)], [version, *flags], root)
    program = folder / "board"
    with _locked(folder.with_suffix(".lock")):
        if program.is_file():
            os.utime(folder)
            return program
        for tool in ("make", "g++", "perl"):
            if shutil.which(tool) is None:
                raise SimError(
                    f"{tool} is not installed: install it with the package manager (apt install {tool})"
                )
        say("building the virtual board; this takes some 20 s, once …")
        _forget_old(folder.parent)
        work = folder.with_suffix(".part")
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        runtime = folder.parent / f"runtime-{_digest([], [version, str(trace)], root)}"
        copy_runtime(runtime, work)
        words = [*flags, "-j", str(min(4, os.cpu_count() or 1)), "--Mdir", str(work)]
        _run([*words, *map(str, rtl), *map(str, cpp)], work, folder.with_suffix(".log"))
        copy_runtime(work, runtime)
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        (work / "board").rename(program)
        shutil.rmtree(work)
        return program


def _defines(params: dict[str, int | str]) -> str:
    """Numbers among the parameters as words for the compiler: BOARD_CLK_HZ, BOARD_AXES."""
    return " ".join(f"-DBOARD_{name}={value}" for name, value in params.items() if isinstance(value, int))


def copy_runtime(source: Path, target: Path) -> None:
    """Objects of Verilator's run-time library into `target`, unless they are there; compiling them takes
    longer than a design does. They are the same for all builds with the same arguments of compiler and
    Verilator. Both folders lie in the same one."""
    with _locked(target.parent / "runtime.lock"):
        target.mkdir(parents=True, exist_ok=True)
        if not any(target.glob("verilated*.o")):
            # Not verilator.o, cocotb's main program, nor top.o: they are compiled for one design.
            for path in [*source.glob("verilated*.o"), *source.glob("verilated*.d")]:
                shutil.copy(path, target)
                # Newer than the makefile that is yet to be written, or make would compile them again.
                os.utime(target / path.name, (time.time(), time.time() + 3_600))


def _rtl(root: Path, part: str) -> list[Path]:
    """Sources of the part's carrier in compile order, from rtl/files.yml."""
    try:
        return sources.files(sources.groups(root), f"{parts.part(part).rtl}_carrier")
    except sources.SourcesError as error:
        raise SimError(str(error)) from None


def _headers(root: Path, folder: str) -> list[Path]:
    pins = root / "tb" / folder / "pins.h"
    return sorted([pins, *(root / "tb/board").glob("*.h"), *(root / "rtl/common").glob("*.svh")])


def _digest(files: list[Path], words: list[str], root: Path) -> str:
    sha = hashlib.sha256(repr([word.replace(str(root), "") for word in words]).encode())
    for file in files:
        sha.update(file.name.encode() + b"\0" + file.read_bytes() + b"\0")
    return sha.hexdigest()[:16]


def _run(words: list[str], folder: Path, log: Path) -> None:
    command, env = verilator.command(words, folder), verilator.environment(folder)
    with open(log, "w", encoding="utf-8") as out:
        done = subprocess.run(
            command, cwd=folder, env=env, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL
        )
    if done.returncode:
        text = log.read_text(encoding="utf-8", errors="replace")
        first = next((line.strip() for line in text.splitlines() if "rror" in line), "no message")
        raise SimError(f"the virtual board does not build: {first} (the whole log: {log})")


def _forget_old(folder: Path) -> None:
    """Remove builds that nobody has used for a week: every change of the RTL leaves one behind."""
    for program in folder.glob("*/board"):
        if time.time() - program.parent.stat().st_mtime > KEEP_DAYS * 86_400:
            shutil.rmtree(program.parent, ignore_errors=True)


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Exclusive between processes."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle = open(path, "w", encoding="utf-8")
    except OSError as error:
        raise SimError(f"cannot write to {path.parent}: {error.strerror}") from None
    import fcntl  # not on every system; whoever only names a virtual board does not need it

    with handle:
        fcntl.flock(handle, fcntl.LOCK_EX)
        yield
