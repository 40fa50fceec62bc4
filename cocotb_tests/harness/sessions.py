"""Plays the host sessions printed in docs/<part>/examples.md: every byte must equal the printed byte.

A chapter is "## <number> title"; each line of its code blocks is one access:

    c 43    st 10    code byte, then the status register
    d E7    st 10    data byte, then the status register
    w 42    st 1A    code byte written without waiting for IBF = 0, then the status register
    r 83             data read after OBF = 1
            st 00    status register
    p       st 00    poll until the status register has this value
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from .bus import HostBus
from .paths import ROOT
from .rtl_bench import RtlBench

LINE = re.compile(r"^(?:(c|d|w) ([0-9A-F]{2}) +st ([0-9A-F]{2})|r ([0-9A-F]{2})|(p?) +st ([0-9A-F]{2}))\b")


@dataclass(frozen=True)
class Step:
    """One access: c, d, w with its byte and the status after it, r with the byte, s or p with the status."""

    kind: str
    byte: int
    status: int


class Sessions:
    """The sessions of one device.

    Args:
        brief: codes of operations so short that they may end before the status is read.
    """

    def __init__(self, part: str, brief: Collection[int]) -> None:
        self.page = ROOT / "docs" / part / "examples.md"
        self.brief = brief

    def blocks(self, chapter: int) -> list[list[Step]]:
        """Return the code blocks of one chapter.

        Raises ValueError, whose text contains the line, if a line is not an access.
        """
        parts = re.split(r"^## ", self.page.read_text(encoding="utf-8"), flags=re.M)
        body = next(part for part in parts if part.startswith(f"{chapter} "))
        found = []
        for block in re.findall(r"```\n(.*?)```", body, re.S):
            steps = []
            for line in block.splitlines():
                match = LINE.match(line)
                if not match:
                    raise ValueError(f"{self.page.name}, chapter {chapter}: cannot read {line!r}")
                kind, byte, status, read, polled, alone = match.groups()
                if kind:
                    steps.append(Step(kind, int(byte, 16), int(status, 16)))
                elif read:
                    steps.append(Step("r", int(read, 16), 0))
                else:
                    steps.append(Step(polled or "s", 0, int(alone, 16)))
            found.append(steps)
        return found

    async def play(self, bench: RtlBench, host: HostBus, steps: list[Step], where: str) -> None:
        """Play one code block on the bench."""
        for number, step in enumerate(steps, 1):
            at = f"{where} line {number}: {step.kind} {step.byte:02X}"
            if step.kind == "r":
                bench.check(at, "data", f"{await host.read_data():02X}", f"{step.byte:02X}")
                continue
            if step.kind == "p":
                await host.poll(0xFF, step.status, timeout=3_000_000)
                continue
            if step.kind == "c":
                await host.command(step.byte)
            elif step.kind == "d":
                await host.data(step.byte)
            elif step.kind == "w":
                await host.command(step.byte, poll=False)
            status = await host.status()
            if step.kind == "c" and step.byte in self.brief and status == 0x00:
                continue
            bench.check(at, "status", f"{status:02X}", f"{step.status:02X}")


class DemoLog:
    """Chapters of the run, with the edges of `clk` at which each chapter begins and ends.

    The running chapter is the last line of the file `progress`. `save` writes chapters.json and
    recording.json (all pin changes and output edges) to the run's folder.
    """

    def __init__(self, bench: RtlBench) -> None:
        self.bench = bench
        self.chapters: list[dict[str, Any]] = []

    @contextmanager
    def chapter(self, key: str, title: str) -> Iterator[None]:
        """Assign all actions in this context to the chapter."""
        with (self.bench.out / "progress").open("a") as file:
            file.write(title + "\n")
        begin = self.bench.now
        yield
        self.chapters.append({"key": key, "title": title, "begin": begin, "end": self.bench.now})

    def save(self) -> None:
        """Write chapters.json and recording.json."""
        (self.bench.out / "chapters.json").write_text(json.dumps(self.chapters, indent=1))
        (self.bench.out / "recording.json").write_text(self.bench.recording().to_json())
