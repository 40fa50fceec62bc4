"""Build the program of a line from tb/fuzz, send characters, compare with the golden model."""

from __future__ import annotations

import hashlib
import shutil
import struct
import subprocess
from array import array
from collections.abc import Iterator
from functools import cache
from itertools import zip_longest
from pathlib import Path

from cocotb_tests.harness.build import locked
from cocotb_tests.harness.paths import ROOT, SIM_BUILDS
from cocotb_tests.harness.project import ProjectError, files, include_dirs, ran
from openppmc.sim.common.build import verilator_command, verilator_environment, verilator_version
from scripts.measure.fuzz.lines import LINES, Line

FOLDER = ROOT / "tb/fuzz"
ARGS = "--cc --exe --build -O3 --assert --x-assign unique --x-initial unique --threads 1 -Wno-fatal -Wno-lint"
ROW = struct.Struct("<IQ")
SHOWN = 24
"""Maximum number of words in the report of a difference."""


@cache
def program(name: str) -> Path:
    """Return the program of a line, built if its sources changed; raise ProjectError if the build fails."""
    line = LINES[name]
    sources = [*files(line.group), FOLDER / f"{line.top}.sv", FOLDER / "main.cpp"]
    words = [*ARGS.split(), "--prefix", "Vfuzz", "--top-module", line.top, "-o", "fuzz"]
    words += [f"-G{key}={value}" for key, value in line.params.items()]
    words += ["-CFLAGS", "-O2"]
    sha = hashlib.sha256(repr((words, verilator_version())).encode())
    headers = [path for folder in include_dirs() for path in sorted(folder.glob("*.svh"))]
    for path in (*sources, *headers):
        sha.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    folder = SIM_BUILDS / f"fuzz-{name}-{sha.hexdigest()[:16]}"
    made = folder / "fuzz"
    with locked(folder.with_suffix(".lock")):
        if not made.is_file():
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            words += ["--Mdir", str(folder), *(f"-I{path}" for path in include_dirs()), *map(str, sources)]
            code, text = ran(verilator_command(words, folder), verilator_environment(folder), folder)
            if code:
                tail = "\n".join(text.splitlines()[-15:])
                raise ProjectError(f"the bench of line {name} does not build:\n{tail}")
    return made


def rtl_events(name: str, words: array[int]) -> Iterator[tuple[int, int]]:
    """Yield the events of the RTL for these words: (number of the word, event)."""
    done = subprocess.run([str(program(name))], input=words.tobytes(), capture_output=True, check=False)
    if done.returncode:
        said = (done.stdout[-400:] + done.stderr[-400:]).decode(errors="replace")
        raise AssertionError(f"{name}: the bench ended with {done.returncode}: {said}")
    yield from ROW.iter_unpack(done.stdout)


def difference(name: str, line: Line, words: array[int]) -> tuple[int, str] | None:
    """Return the first word whose events in RTL and golden model differ, with both events; else None."""
    for real, ideal in zip_longest(rtl_events(name, words), line.expected(words)):
        if real != ideal:
            place = min(event[0] for event in (real, ideal) if event)
            texts = [f"{event[1]:016x} at {event[0]}" if event else "nothing" for event in (ideal, real)]
            return place, f"expected {texts[0]}, the RTL has {texts[1]}"
    return None


def shrink_report(name: str, line: Line, words: array[int]) -> str:
    """Return a difference as text, with the words up to it.

    Words at the beginning that are not needed to produce a difference are removed.
    """
    found = difference(name, line, words)
    assert found is not None
    words = words[: found[0] + 1]
    size = len(words) // 2
    while size:
        rest = words[size:]
        if rest and difference(name, line, rest) is not None:
            words = rest
            size = min(size, len(words) // 2)
        else:
            size //= 2
    found = difference(name, line, words)
    assert found is not None
    return f"{name}: {' '.join(f'{word:02x}' for word in words[-SHOWN:])}: {found[1]}"
