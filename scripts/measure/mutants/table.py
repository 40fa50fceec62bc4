"""The mutants in <part>.yml of this folder. A mutant is a small change of one RTL file.

A file of the RTL has its mutants by name. An entry has these keys:
    old     the text to replace, which occurs exactly once in the file
    new     the text that replaces `old`
    caught  the test that must fail
    by      what detects the mutant: *check* (an assertion of the test itself, the default), *comparison*
            (only the edges differ from the golden model's) or *assertion* (of the RTL)
    suite   optional: the module of pytest items (test_part)
    build   optional: the name of a configuration
If no directed test of this build finds the mutant, `caught` and `by` are missing, `why` states the
consequence, and `tests` has words separated by commas: a test runs if its module or its name contains one.
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
    """One entry; no other entry of the same part has this `name`."""

    part: str
    name: str
    file: str
    old: str
    new: str
    tests: str = ""
    caught: str = ""
    by: str = "check"
    suite: str = "test_part"
    build: str = ""
    why: str = ""

    @property
    def id(self) -> str:
        """The part and the name."""
        return f"{self.part}-{self.name}"

    def source(self) -> str:
        """Return the text of the changed file; raise ValueError unless the old text occurs in it once."""
        text = (ROOT / self.file).read_text(encoding="utf-8")
        if text.count(self.old) != 1:
            raise ValueError(f"{self.id}: {self.file} has {text.count(self.old)} times {self.old!r}")
        return text.replace(self.old, self.new)

    def items(self, wide: bool = False) -> list[Item]:
        """Return tests of the mutant's build.

        They are the tests in the module of `caught`; without it, the tests that the entry's words select, or
        all.

        Args:
            wide: True for all tests of the build.
        """
        build = self.build or MAIN_BUILD.get(self.part, "f16")
        every = [param.values[0] for param in self._module().ITEMS]
        built = [item for item in every if item.config.name == build and not item.skipped]
        files = [item.module for item in built if item.test == self.caught]
        words = [""] if wide else files or self.tests.split(",")
        return [item for item in built if any(word in item.full_name for word in words)]

    def unchanged_design(self, item: Item) -> Design:
        """Return the unchanged design that `item` simulates."""
        make = getattr(self._module(), "design", lambda config: part_design(item.part, config))
        made: Design = make(item.config)
        return made

    def design(self, item: Item) -> Design:
        """Return the design with a changed copy in place of the file."""
        copy = BUILD / "mutants" / self.id / Path(self.file).name
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(self.source(), encoding="utf-8")
        unchanged_design = self.unchanged_design(item)
        return replace(
            unchanged_design,
            sources=[copy if path == ROOT / self.file else path for path in unchanged_design.sources],
        )

    def _module(self) -> ModuleType:
        return importlib.import_module(f"cocotb_tests.{self.part}.{self.suite}")


def mutants() -> Iterator[Mutant]:
    """Yield all mutants."""
    for path in sorted(HERE.glob("*.yml")):
        for file, entries in yaml.safe_load(path.read_text(encoding="utf-8")).items():
            for name, entry in entries.items():
                yield Mutant(path.stem, name, file, **entry)
