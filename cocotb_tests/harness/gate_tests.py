"""`PartTests`: which tests of a part run on netlists, and why others do not; see each part's `gates.py`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import ModuleType

from .collect import Item
from .part import Part

OTHER_BUILDS = "other clocks or times; netlists of the sister part have such clocks in the same blocks"
COSTLY_BUILDS = "other clocks or times; synthesis of another netlist takes minutes"
PARAMETERS = "elaborates illegal parameters; those of a netlist are fixed"
NO_NETLISTS = (
    "tested as plain Verilog; synthesis of it takes minutes, and its parts have netlists of their own"
)
GENERATOR = "checks the generator of the random hosts; no simulation"


@dataclass(frozen=True)
class PartTests:
    """The tests of one part: its directed and random test modules, of which netlists run the ITEMS.

    sample: of its random tests, what makes the item of a seed, and the seeds. Together the hosts of a sample
    use every configuration they choose from. builds: names of the configurations that netlists are made of,
    for the reason in `why`; none: all. simulating: test functions that run simulations. not_applicable: those
    that do not, with what a netlist has to do with them. too_long: directed tests, or modules of them, that a
    netlist would take far too long for, with the reason. quick: those of the quick sample, which runs in the
    build `quick_build`; four_state: those of them that a simulator a hundred times as slow runs. netlists: it
    has any; without, its tests run on plain Verilog alone. pins: of its top, if its folder's `bench.py` does
    not tell. params: of its top, beside those of a configuration. inside: signals of the top that the tests
    read, beside its ports.
    """

    directed: ModuleType
    simulating: frozenset[str]
    random: ModuleType | None = None
    sample: Mapping[Callable[[int], Item], Sequence[int]] = field(default_factory=dict)
    builds: frozenset[str] = frozenset()
    why: str = OTHER_BUILDS
    not_applicable: Mapping[str, str] = field(default_factory=dict)
    too_long: Mapping[str, str] = field(default_factory=dict)
    quick: frozenset[str] = frozenset()
    quick_build: str = "f16"
    four_state: frozenset[str] = frozenset()
    netlists: bool = True
    pins: Part | None = None
    params: Mapping[str, int] = field(default_factory=dict)
    inside: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The part's name."""
        return str(self._directed[0].part)

    @property
    def _directed(self) -> list[Item]:
        return [param.values[0] for param in self.directed.ITEMS]

    @property
    def items(self) -> list[Item]:
        """The directed tests that run on netlists."""
        return [item for item in self._directed if not self.is_too_long(item) and self.built(item)]

    def built(self, item: Item) -> bool:
        """Whether there are netlists of its configuration."""
        return not self.builds or item.config.name in self.builds

    def is_quick(self, item: Item) -> bool:
        """Whether a directed test is in the quick sample."""
        return not self.quick.isdisjoint(names(item)) and item.config.name == self.quick_build

    def is_four_state(self, item: Item) -> bool:
        """Whether a directed test is in the sample for a simulator with X."""
        return item.test in self.four_state and item.config.name == self.quick_build

    def is_too_long(self, item: Item) -> bool:
        """Whether a directed test would take a netlist far too long."""
        return not self.too_long.keys().isdisjoint(names(item))

    @property
    def unbuilt(self) -> list[str]:
        """Names of the configurations without netlists."""
        return sorted({item.config.name for item in self._directed if not self.built(item)})

    @property
    def functions(self) -> list[str]:
        """The test functions of its modules."""
        modules = [module for module in (self.directed, self.random) if module]
        return [name for module in modules for name in vars(module) if name.startswith("test_")]


def names(item: Item) -> tuple[str, str]:
    """How a part's `gates.py` may name a test: by its module or by itself."""
    return item.module.rpartition(".")[2], item.test
