"""Reads the parameters of a module from its header, the only place that lists them."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

_HEADER = re.compile(r"^module (\w+)\b(.*?)\)\s*\(", re.S | re.M)
_LINE = re.compile(
    r"^ *parameter +(?:(?P<type>\w[\w ]*?) +)?(?P<name>\w+) *= *(?P<value>[^,/\n]+?) *,? *"
    r"(?://+ *(?P<about>.*))?$",
    re.M,
)
_NUMBER = re.compile(r"(?:\d*'(?P<base>[hdb]))?(?P<digits>[0-9A-Fa-f]+)")
RADIX = {"h": 16, "d": 10, "b": 2, None: 10}


@dataclass(frozen=True)
class Parameter:
    """One parameter: type ("" if none), default as text, and the comment on its line ("" if none)."""

    name: str
    type: str
    value: str
    about: str

    @property
    def is_text(self) -> bool:
        """Whether the value is a string instead of a number."""
        return self.value.startswith('"')

    @property
    def default(self) -> int | str:
        """Default as a Python value. Raises ValueError if it is not a plain literal."""
        if self.is_text:
            return self.value.strip('"')
        literal = _NUMBER.fullmatch(self.value.replace("_", ""))
        if not literal:
            raise ValueError(f"{self.name} = {self.value}: expected a plain number")
        return int(literal["digits"], RADIX[literal["base"]])


def parameters(path: Path) -> dict[str, Parameter]:
    """Return the parameters of the module in a file, in order; empty if it has no parameters."""
    match = _HEADER.search(path.read_text(encoding="utf-8"))
    if not match:
        return {}
    rows = _LINE.finditer(match[2])
    return {
        row["name"]: Parameter(row["name"], row["type"] or "", row["value"], (row["about"] or "").strip())
        for row in rows
    }
