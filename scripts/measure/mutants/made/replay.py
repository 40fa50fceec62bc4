"""Replay of recorded tests into all mutants of a file, which is much faster than the tests themselves.

A test compares every output with the golden model, and its host acts only on what it has read. Up to the
first difference, a mutant therefore receives the inputs that the RTL received: a mutant that differs from the
recording of a passed test fails this test. A mutant that differs from no recording is tried with proofs and
tests.
"""

from __future__ import annotations

import hashlib
import json
import shutil
import struct
import subprocess
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
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
from scripts.measure.mutants.made.schema import EVERY
from scripts.measure.mutants.made.work import copy_of

TOTAL, BUDGET = 5_000_000, 500_000
"""Maximum numbers of cycles: of all recordings of a design, and of those replayed into one mutant."""
FEWEST = 20
"""Minimum number of recordings of a design, because the design is built for each file."""
_WORD = 64


@dataclass(frozen=True)
class Work:
    """Mutants of one file, by number."""

    file: str
    numbers: tuple[int, ...]


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
    """Return the shortest recordings of each design (part and parameters), the shortest first.

    The design with most recordings is first.
    """
    found: dict[tuple[str, str], list[tuple[int, Path]]] = {}
    for path in folder().glob("*.json"):
        recording = json.loads(path.read_text(encoding="ascii"))
        design = recording["part"], json.dumps(recording["params"])
        found.setdefault(design, []).append((recording["end"], path))
    kept = {}
    for design, recordings in found.items():
        sums = accumulate(end for end, _ in sorted(recordings))
        short = [path for (_, path), total in zip(sorted(recordings), sums, strict=True) if total <= TOTAL]
        if len(short) >= FEWEST:
            kept[design] = short
    return dict(sorted(kept.items(), key=lambda one: -len(one[1])))


def replayed(work: Work) -> Result:
    """Replay recordings into the mutants of a file; return the digest of the one that kills each mutant."""
    killed: dict[int, str] = {}
    for (part, params), recordings in designs().items():
        left = [number for number in work.numbers if number not in killed]
        if left and ROOT / work.file in sources(rtl_part(part)):
            killed |= _killed(work.file, left, part, params, recordings)
    return Result(True, {"killed": {str(number): name for number, name in killed.items()}})


def _killed(
    file: str, numbers: Sequence[int], part: str, params: str, recordings: Sequence[Path]
) -> Iterator[tuple[int, str]]:
    """Yield each mutant that the recordings of one design kill, and the digest of the recording."""
    row, values = rtl_part(part), json.loads(params)
    pins = recorded(part, values)
    design = build.Design(
        row.top,
        [copy_of(file, notes=True) if path == ROOT / file else path for path in sources(row)],
        include_dirs(),
        values,
        (*MUTANT_WARNINGS, "-Wno-SIDEEFFECT", "--no-assert"),
        ("clk", "rst_n", *pins.inputs, *pins.watched),
        main=str(Path(__file__).with_suffix(".cpp")),
    )
    program = build.build(design) / row.top
    packed = folder() / f"{hashlib.sha256(f'{part} {params}'.encode()).hexdigest()[:12]}.bin"
    with build.locked(packed.with_suffix(".lock")):
        if not packed.is_file():
            packed.write_bytes(_packed(pins, values, recordings))
    left = list(numbers)
    while left:
        command = [str(program), str(packed), str(EVERY), str(BUDGET), *map(str, left)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        rows = [tuple(map(int, line.split())) for line in done.stdout.splitlines()]
        yield from ((number, recordings[place].stem) for number, place in rows if place >= 0)
        # The program ends at a mutant whose levels do not become stable; its tests show whether they fail.
        left = left[len(rows) + 1 :]


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
