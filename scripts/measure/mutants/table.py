"""The mutants of <part>.yml beside this file: one small change of one RTL file each, and who finds it.

An entry has `file`, `old` (stands there exactly once), `new`, `tests` (words with commas; a test is run if
its module or its name holds one), `caught` (the test that must fail) and `by`: *check* (an assertion of the
test itself), *comparison* (only the edges differ from the golden model's) or *assertion* (of the RTL).
Optional: `suite`, the module of pytest items (test_part), and `build`, a configuration's name. No `caught`:
no directed test of that build finds it, and `why` says what that means.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType

import yaml

from cocotb_tests.harness.build import Design, part_design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.paths import BUILD, ROOT

HERE = Path(__file__).parent
MAIN_BUILD = {"pmc006": "f8b", "bank": "b8"}


@dataclass(frozen=True)
class Mutant:
    """One entry; `name` is unique in its part."""

    part: str
    name: str
    file: str
    old: str
    new: str
    tests: str
    caught: str = ""
    by: str = ""
    suite: str = "test_part"
    build: str = ""
    why: str = ""

    @property
    def id(self) -> str:
        """Part and name."""
        return f"{self.part}-{self.name}"

    def source(self) -> str:
        """Text of the changed file; ValueError unless the old text stands in it once."""
        text = (ROOT / self.file).read_text(encoding="utf-8")
        if text.count(self.old) != 1:
            raise ValueError(f"{self.id}: {self.file} has {text.count(self.old)} times {self.old!r}")
        return text.replace(self.old, self.new)

    def items(self, wide: bool = False) -> list[Item]:
        """The tests of one build that the words choose, or, `wide`, all of the suite."""
        build = self.build or MAIN_BUILD.get(self.part, "f16")
        words = [""] if wide else self.tests.split(",")
        every = [param.values[0] for param in self._module().ITEMS]
        return [
            item
            for item in every
            if item.config.name == build
            and any(word in item.full_name for word in words)
            and not item.skipped
        ]

    def whole(self, item: Item) -> Design:
        """What `item` simulates, unchanged."""
        make = getattr(self._module(), "design", lambda config: part_design(item.part, config))
        made: Design = make(item.config)
        return made

    def design(self, item: Item) -> Design:
        """The same with a changed copy in place of the file."""
        copy = BUILD / "mutants" / self.id / Path(self.file).name
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(self.source(), encoding="utf-8")
        whole = self.whole(item)
        return replace(whole, sources=[copy if path == ROOT / self.file else path for path in whole.sources])

    def _module(self) -> ModuleType:
        return importlib.import_module(f"cocotb_tests.{self.part}.{self.suite}")


def mutants() -> Iterator[Mutant]:
    """All of them."""
    for path in sorted(HERE.glob("*.yml")):
        for name, entry in yaml.safe_load(path.read_text(encoding="utf-8")).items():
            yield Mutant(path.stem, name, **entry)
