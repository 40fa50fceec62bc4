"""`PartTests`: which tests of a device run on netlists, and why the others do not (its `gates.py`)."""

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
    """Directed and random test modules of one device.

    On netlists, the ITEMS of the directed module run.

    Attributes:
        sample: function that returns the item of a random seed -> seeds that run. All hosts of a sample
            together use every configuration from which random hosts choose.
        builds: names of the configurations that have netlists (empty: all); `why` is the reason why others
            have no netlist.
        simulating: test functions that run simulations.
        not_applicable: test functions that cannot run on a netlist -> reason.
        too_long: directed tests, or modules of them, that would take far too long on a netlist -> reason.
        quick: names of the tests in the quick sample, which runs only in the build `quick_build`.
        four_state: tests that also run on a four-state simulator (with X), which is a hundred times slower.
        netlists: whether the device has netlists; if not, its tests run on plain Verilog only.
        pins: pins of the top, if the `bench.py` of the folder does not list them.
        params: parameters of the top in addition to those of a configuration.
        probes: signals of the top that the tests read, in addition to its ports.
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
    probes: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Name of the device."""
        return str(self._directed[0].part)

    @property
    def _directed(self) -> list[Item]:
        return [param.values[0] for param in self.directed.ITEMS]

    @property
    def items(self) -> list[Item]:
        """The directed tests that run on netlists."""
        return [item for item in self._directed if not self.is_too_long(item) and self.built(item)]

    def built(self, item: Item) -> bool:
        """Return whether there are netlists of the configuration of a test."""
        return not self.builds or item.config.name in self.builds

    def is_quick(self, item: Item) -> bool:
        """Return whether a directed test is in the quick sample."""
        return not self.quick.isdisjoint(names(item)) and item.config.name == self.quick_build

    def is_four_state(self, item: Item) -> bool:
        """Return whether a directed test is in the sample that also runs on a four-state simulator."""
        return item.test in self.four_state and item.config.name == self.quick_build

    def is_too_long(self, item: Item) -> bool:
        """Return whether a directed test would take far too long on a netlist."""
        return not self.too_long.keys().isdisjoint(names(item))

    @property
    def unbuilt(self) -> list[str]:
        """Names of the configurations without netlists."""
        return sorted({item.config.name for item in self._directed if not self.built(item)})

    @property
    def functions(self) -> list[str]:
        """Names of the test functions in the directed and the random module."""
        modules = [module for module in (self.directed, self.random) if module]
        return [name for module in modules for name in vars(module) if name.startswith("test_")]


def names(item: Item) -> tuple[str, str]:
    """Return the names by which `gates.py` can refer to a test: its module and the test itself."""
    return item.module.rpartition(".")[2], item.test
