"""What a module says before anything runs: which parameters it accepts, which ports it has."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Mapping, Sequence

from openppmc.sim.common import verilator

from .build import Design
from .paths import ROOT

# Parameter: legal values (its extremes), values just outside; as SystemVerilog literals.
Ranges = Mapping[str, tuple[Sequence[str], Sequence[str]]]

_PORT = re.compile(
    r"^ {4}(input|output)\s+(?:wire\s+)?logic\s*(?:\[\s*([^:\]]+):(\d+)\])?\s*(\w+)\s*,?\s*(?://.*)?$"
)
_DEFAULT = re.compile(r"^ {4}parameter .*?(\w+)\s*=\s*([\d_]+)\b", re.MULTILINE)
_BITS = re.compile(r"(?:(\d+)\s*\*\s*)?([A-Z]\w*)\s*-\s*1")


def check_ranges(rule: str, design: Design, ranges: Ranges) -> None:
    """Elaborate a design with each value; AssertionError unless exactly the legal ones are accepted."""
    files = [f"-I{folder}" for folder in design.includes] + [str(path) for path in design.sources]
    for name, (good, bad) in ranges.items():
        for value in (*good, *bad):
            words = ["--lint-only", "-Wno-WIDTH", "--top-module", design.top, f"-G{name}={value}", *files]
            done = subprocess.run(
                verilator.command(words, ROOT),
                cwd=ROOT,
                env=verilator.environment(ROOT),
                capture_output=True,
                text=True,
                check=False,
            )
            accepted = done.returncode == 0
            assert accepted == (value in good), (
                f"{rule}: {name} = {value} accepted: {accepted}\n{done.stderr}"
            )


def ports(design: Design) -> dict[str, tuple[str, int, int]]:
    """Ports of the top module: name -> (direction, highest bit, lowest bit), from its source."""
    (source,) = [path for path in design.sources if path.stem == design.top]
    head = source.read_text(encoding="utf-8").split(");", 1)[0]
    values = {name: int(text) for name, text in _DEFAULT.findall(head)} | dict(design.params)

    def highest(text: str) -> int:
        match = _BITS.fullmatch(text)
        return int(match[1] or 1) * int(values[match[2]]) - 1 if match else int(text)

    found = [match for line in head.splitlines() if (match := _PORT.match(line))]
    return {m[4]: (m[1], highest(m[2] or "0"), int(m[3] or 0)) for m in found}
