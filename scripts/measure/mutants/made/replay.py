"""Replay of recorded tests into all mutants of a folder, which is much faster than the tests themselves.

A test compares every output with the golden model, and its host acts only on what it has read. Up to the
first difference, a mutant therefore receives the inputs that the RTL received: a mutant that differs from the
recording of a passed test fails this test. A mutant that differs in no replay is tried with proofs and tests.
"""

from __future__ import annotations

import hashlib
import json
import shutil
import struct
import subprocess
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import accumulate, chain
from pathlib import Path

from cocotb_tests.harness import build
from cocotb_tests.harness.compare import RECORDINGS
from cocotb_tests.harness.part import Part, recorded
from cocotb_tests.harness.project import BUILD, ROOT, ProjectError, include_dirs, sources
from cocotb_tests.harness.project import part as rtl_part
from cocotb_tests.harness.variants import MUTANT_WARNINGS
from openppmc import parts
from openppmc.check.records import Recording
from scripts.measure.campaign.jobs import Result
from scripts.measure.campaign.tree import SIMULATED, tree
from scripts.measure.coverage.work import pytest
from scripts.measure.mutants.made import killed
from scripts.measure.mutants.made.layout import registers
from scripts.measure.mutants.made.schema import EVERY
from scripts.measure.mutants.made.work import KILLED, Bulk, digest, noting_copy_of

BUDGET, LONG = 60_000_000, 300_000
"""Numbers of cycles: for which one mutant of a design is simulated at most; of a very long recording."""
FEWEST = 50
"""Minimum number of recordings of a design, because the design is built for each folder."""
ARGS = ("-Wno-SIDEEFFECT", "--no-assert", "--flatten", "-fno-lift-expr", "-CFLAGS", "-DVL_USER_FATAL -O2")
"""Arguments of Verilator. A lifted expression would be evaluated outside its condition, and slowly."""
_WORD = 64
_MANY = 1_000
"""Maximum number of mutants of a file."""


def folder() -> Path:
    """Return the folder of the recordings of the present sources."""
    return BUILD / "mutants" / f"recordings-{tree(SIMULATED)}"


def record(workers: int) -> None:
    """Run the tests of all parts once; store a recording of each test that agrees with the golden model."""
    done = folder() / "done"
    if done.is_file():
        return
    for old in folder().parent.glob("recordings-*"):
        shutil.rmtree(old)
    folder().mkdir(parents=True)
    tests = [f"cocotb_tests/{row.name}" for row in parts.folders()]
    code, text = pytest({RECORDINGS: str(folder())}, "-n", str(workers), *tests)
    if code:
        raise ProjectError("a test fails without a mutant:\n" + "\n".join(text.strip().splitlines()[-9:]))
    done.touch()


@cache
def designs() -> dict[tuple[str, str], list[Path]]:
    """Return the recordings of each design (part and parameters), the very long ones last.

    The others have a pseudo-random order, so that the first ones are of different kinds. The design with most
    recordings is first.
    """
    found: dict[tuple[str, str], list[tuple[bool, Path]]] = {}
    for path in folder().glob("*.json"):
        recording = json.loads(path.read_text(encoding="ascii"))
        design = recording["part"], json.dumps(recording["params"])
        found.setdefault(design, []).append((recording["end"] > LONG, path))
    kept = {
        design: [path for _, path in sorted(rows)] for design, rows in found.items() if len(rows) >= FEWEST
    }
    return dict(sorted(kept.items(), key=lambda one: -len(one[1])))


def replayed(work: Bulk) -> Result:
    """Replay recordings into the mutants of a folder; return the digest of the one that kills each mutant.

    Each killed mutant is also stored at once, because a replay takes up to some hours.
    """
    found: dict[str, str] = {}
    for file, _ in work.mutants:
        digest(file)  # of the present text; killed.note uses it, even if the file changes during the replay
    for (part, params), recordings in designs().items():
        every = sources(rtl_part(part))
        left = [(file, n) for file, n in work.mutants if f"{file} {n}" not in found and ROOT / file in every]
        for key, recording in _killed(left, part, params, recordings) if left else ():
            found[key] = f"recording {recording}"
            killed.note(key, KILLED, found[key])
    return Result(True, {"found": found})


def _killed(
    mutants: Sequence[tuple[str, int]], part: str, params: str, recordings: Sequence[Path]
) -> Iterator[tuple[str, str]]:
    """Yield each mutant that the recordings of one design kill, and the digest of the recording."""
    row, values = rtl_part(part), json.loads(params)
    pins, every = recorded(part, values), sources(rtl_part(part))
    files: dict[str, set[int]] = {}
    for file, number in sorted(mutants):
        files.setdefault(file, set()).add(number)
    copies = {
        ROOT / file: noting_copy_of(file, numbers, place * _MANY)
        for place, (file, numbers) in enumerate(files.items())
    }
    design = build.Design(
        row.top,
        [copies.get(path, path) for path in every],
        include_dirs(),
        values,
        (*MUTANT_WARNINGS, *ARGS),
        ("clk", "rst_n", *pins.inputs, *pins.watched),
        main=str(Path(__file__).with_suffix(".cpp")),
    )
    built = build.build(design)
    header = (built / "Vtop___024root.h").read_text(encoding="utf-8")
    places = " ".join(map(str, registers(header, [path.read_text(encoding="utf-8") for path in every])))
    packed = folder() / f"{hashlib.sha256(f'{part} {params}'.encode()).hexdigest()[:12]}.bin"
    with build.locked(packed.with_suffix(".lock")):
        if not packed.is_file():
            packed.write_bytes(_packed(pins, values, recordings))
    chosen = [str(place * _MANY + n) for place, numbers in enumerate(files.values()) for n in sorted(numbers)]
    command = [built / row.top, packed, str(EVERY), str(BUDGET), *chosen]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdin is not None and process.stdout is not None
        with process.stdin:
            process.stdin.write(places)
        for line in process.stdout:
            number, place = map(int, line.split())
            yield f"{list(files)[number // _MANY]} {number % _MANY}", recordings[place].stem
    if process.returncode:
        raise subprocess.CalledProcessError(process.returncode, command)


def _packed(pins: Part, params: Mapping[str, object], recordings: Sequence[Path]) -> bytes:
    """Return ports and recordings in the format of replay.cpp."""
    words = {name: -(-pins.width(name) // _WORD) for name in ("clk", "rst_n", *pins.inputs, *pins.watched)}
    first = dict(zip(words, accumulate(words.values(), initial=0), strict=False))
    start = {"clk": 0, "rst_n": 1, **pins.inputs, **pins.reset_levels(params)}

    def split(name: str, level: int) -> list[int]:
        return [level >> _WORD * n & (1 << _WORD) - 1 for n in range(words[name])]

    def rows(changes: Iterable[tuple[int, str, int]]) -> bytes:
        found = [
            (t, first[name] + n, word)
            for t, name, level in changes
            if name in first
            for n, word in enumerate(split(name, level))
        ]
        return _numbers(len(found), *chain.from_iterable(found))

    inputs = sum(words[name] for name in ("clk", "rst_n", *pins.inputs))
    parts = [_numbers(inputs, len(words))]
    parts += [_numbers(count, len(name)) + name.encode() for name, count in words.items()]
    levels = _numbers(*chain.from_iterable(split(name, start[name]) for name in words))
    texts = [path.read_text(encoding="ascii") for path in recordings]
    for place, one in enumerate(map(Recording.from_json, texts)):
        parts.append(_numbers(place, one.end) + levels + rows(one.stimulus) + rows(one.edges))
    return b"".join(parts)


def _numbers(*values: int) -> bytes:
    return struct.pack(f"={len(values)}Q", *values)
