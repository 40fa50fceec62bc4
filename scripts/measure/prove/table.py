"""The proofs: entries of table/<folder>.yml beside this file, one for each proof of tb/formal/<folder>/.

An entry has `says` (what is proved, a line a property), `rules` (IDs, may be empty), `group` of rtl/files.yml
whose sources it needs, `cover` (clk in which its covers must be reached from reset), and `breaks`: a change
of one RTL file (`file`, `old`, which stands there once, `new`) that makes the proof fail. Optional:

`block`    the module, if it is not the name
`wrapper`  the module that holds the properties, without _fv, if it is not the name
`only`     labels or their beginnings: the properties and covers of the wrapper that this proof is about
`bound`    not proved without end, but none of the first so many clk has a counterexample; `why` tells why
`induct`   by induction over so many clk, also without end: for blocks with much memory
`assumes`  what the wrapper takes for granted: label -> what guards it where the block is driven
`stubs`    files below tb/formal that stand for blocks inside; other proofs say what those blocks do
`night`    takes long: `make prove NIGHT=1`
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

import yaml

from cocotb_tests.harness.project import ROOT, ProjectError, files

HERE = Path(__file__).parent / "table"
FORMAL = ROOT / "tb" / "formal"


@dataclass(frozen=True)
class Change:
    """A file of the RTL with another text. name: tells the run's folder from others of the proof."""

    name: str
    file: str
    text: str


@dataclass(frozen=True)
class Proof:
    """One entry; `name` is unique."""

    folder: str
    name: str
    says: tuple[str, ...]
    group: str
    cover: int
    breaks: dict[str, str]
    rules: tuple[str, ...] = ()
    block: str = ""
    bound: int = 0
    induct: int = 0
    why: str = ""
    assumes: dict[str, str] = field(default_factory=dict)
    night: bool = False
    wrapper: str = ""
    only: tuple[str, ...] = ()
    stubs: tuple[str, ...] = ()

    @property
    def file(self) -> Path:
        """The module that instantiates the block and holds the properties."""
        return FORMAL / self.folder / f"{self.wrapper or self.name}_fv.sv"

    def sources(self, changed: Mapping[Path, Path] = MappingProxyType({})) -> list[Path]:
        """RTL and wrapper in compile order. changed: file of the RTL -> what takes its place."""
        stubs = {Path(stub).name: FORMAL / stub for stub in self.stubs}
        place = {path: stubs[path.name] for path in files(self.group) if path.name in stubs} | dict(changed)
        return [*(place.get(path, path) for path in files(self.group)), self.file]

    def broken(self) -> Change:
        """What `breaks` says; ProjectError unless the old text is there once."""
        text = (ROOT / self.breaks["file"]).read_text(encoding="utf-8")
        if (times := text.count(self.breaks["old"])) != 1:
            raise ProjectError(f"{self.name}: {self.breaks['file']} has {times} times {self.breaks['old']!r}")
        return Change("broken", self.breaks["file"], text.replace(self.breaks["old"], self.breaks["new"]))


def proofs() -> Iterator[Proof]:
    """All of them, in the order of the tables."""
    for path in sorted(HERE.glob("*.yml")):
        for name, entry in (yaml.safe_load(path.read_text(encoding="utf-8")) or {}).items():
            for key in ("says", "rules", "only", "stubs"):
                entry[key] = tuple(entry.get(key, ()))
            entry.setdefault("block", name)
            yield Proof(path.stem, name, **entry)


def chosen(words: Sequence[str], night: bool) -> list[Proof]:
    """Those that hold one of these words, else all (`night`) or all quick ones.

    ProjectError if a word fits none.
    """
    every = list(proofs())
    if not words:
        return [one for one in every if night or not one.night]
    exact = {one.name for one in every}
    for word in words:
        if not any(word in one.name for one in every):
            raise ProjectError(f"T={word}: no such proof (known: {', '.join(one.name for one in every)})")

    def fits(one: Proof, word: str) -> bool:
        return one.name == word if word in exact else word in one.name

    return [one for one in every if any(fits(one, word) for word in words)]
