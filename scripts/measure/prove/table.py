"""The proofs: entries of table/<folder>.yml, one for each proof of tb/formal/<folder>/.

An entry has `says` (the proved properties, one on each line), `rules` (IDs, may be empty), `group` of
rtl/files.yml whose sources it needs, `cover` (number of cycles from reset in which its covers must be
reached), and `breaks`: a change of one RTL file (`file`, `old`, which occurs there once, `new`) that makes
the proof fail, or a list of such changes, each of which makes the proof fail. Optional:

`block`    the module, if its name differs from that of the entry
`wrapper`  the module with the properties, without _fv, if its name differs from that of the entry
`only`     labels or their prefixes: the properties and covers of the wrapper that belong to this proof
`bound`    bounded proof: no counterexample in this number of first cycles; `why` states the reason
`induct`   unbounded proof by induction over this number of cycles, for blocks with large memories
`assumes`  assumptions of the wrapper: label -> the check that guards it where the block is used
`stubs`    files below tb/formal that replace inner blocks; other proofs cover these blocks
`night`    long proof: `make prove NIGHT=1`
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
    """An RTL file whose text is replaced for a run.

    Attributes:
        name: text in the name of the run's folder, which distinguishes the run from others of the proof.
    """

    name: str
    file: str
    text: str


@dataclass(frozen=True)
class Proof:
    """One entry of the tables, which describes a proof; `name` is unique."""

    folder: str
    name: str
    says: tuple[str, ...]
    group: str
    cover: int
    breaks: tuple[dict[str, str], ...]
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
        """File of the module that instantiates the block and contains the properties."""
        return FORMAL / self.folder / f"{self.wrapper or self.name}_fv.sv"

    def sources(self, changed: Mapping[Path, Path] = MappingProxyType({})) -> list[Path]:
        """Return RTL and wrapper in compile order.

        Args:
            changed: for each changed RTL file, its replacement.
        """
        stubs = {Path(stub).name: FORMAL / stub for stub in self.stubs}
        place = {path: stubs[path.name] for path in files(self.group) if path.name in stubs} | dict(changed)
        return [*(place.get(path, path) for path in files(self.group)), self.file]

    def broken(self) -> list[Change]:
        """Return the changes of `breaks`; raise ProjectError unless each old text occurs exactly once."""
        changes = []
        for number, one in enumerate(self.breaks, 1):
            text = (ROOT / one["file"]).read_text(encoding="utf-8")
            if (times := text.count(one["old"])) != 1:
                raise ProjectError(f"{self.name}: {one['file']} has {times} times {one['old']!r}")
            name = f"broken{number}" if len(self.breaks) > 1 else "broken"
            changes.append(Change(name, one["file"], text.replace(one["old"], one["new"])))
        return changes


def proofs() -> Iterator[Proof]:
    """Yield all proofs, in the order of the tables."""
    for path in sorted(HERE.glob("*.yml")):
        for name, entry in (yaml.safe_load(path.read_text(encoding="utf-8")) or {}).items():
            for key in ("says", "rules", "only", "stubs"):
                entry[key] = tuple(entry.get(key, ()))
            breaks = entry["breaks"]
            entry["breaks"] = tuple(breaks) if isinstance(breaks, list) else (breaks,)
            entry.setdefault("block", name)
            yield Proof(path.stem, name, **entry)


def chosen(words: Sequence[str], night: bool) -> list[Proof]:
    """Return the proofs whose names contain one of these words.

    Without words, return all quick proofs or, with `night`, all proofs.

    Raises ProjectError if a word matches no proof.
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
