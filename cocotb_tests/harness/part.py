"""`Part`: the pins of a device for test benches; `PARTS`: the devices by name.

A port of several bits is one number, as in the simulator. Each bit also has a name: "pout_n[2]" is bit 2 of a
port declared `[2:1]`, whose lowest bit has number 1.
"""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

from openppmc import parts

if TYPE_CHECKING:
    from .config import Config

_BIT = re.compile(r"^(\w+)\[(\d+)\]$")


@dataclass(frozen=True)
class BusStyle:
    """Pin levels for both strobes of a bus; `address` is the register-select pin."""

    write_on: Mapping[str, int]
    write_off: Mapping[str, int]
    read_on: Mapping[str, int]
    read_off: Mapping[str, int]
    address: str = "a0"

    @property
    def off(self) -> dict[str, int]:
        """Levels with both strobes deasserted."""
        return {**self.write_off, **self.read_off}


STROBES_RD_WR = BusStyle(
    write_on={"cs_n": 0, "wr_n": 0},
    write_off={"cs_n": 1, "wr_n": 1},
    read_on={"cs_n": 0, "rd_n": 0},
    read_off={"cs_n": 1, "rd_n": 1},
)


class PinTable(Protocol):
    """Pins of a golden model: idle levels, levels in reset, and widths other than 1 bit."""

    @property
    def INPUTS(self) -> Mapping[str, int]: ...  # noqa: N802

    @property
    def OUTPUTS(self) -> Mapping[str, int]: ...  # noqa: N802

    @property
    def WIDTHS(self) -> Mapping[str, int]: ...  # noqa: N802


@dataclass(frozen=True)
class Part:
    """One device.

    Attributes:
        name: name of the device in the table of parts, which is also the name of its top module.
        inputs: every input pin except clk and rst_n -> its idle level.
        outputs: every output -> (width, reset level).
        widths: widths of the inputs wider than one bit.
        lowest: port -> number of its lowest bit, if this is not 0.
        parameters: parameters of the top module.
        styles: level of `style_pin` -> style of the host bus. A device with a single style has no
            `style_pin`, and a device without a bus has no style.
        clock: pin of the external base clock.
        unwatched: free-running outputs; only tests that request them record their edges.
        defaults: parameters of a build that sets no parameters.
        idle: one-bit parameter -> output whose level in reset it selects.
        shape: function that returns the pins for parameters that determine the widths of ports (see `built`).

    For `make test JITTER=1`, `stages` lists the synchronisers of the pins: path -> pins from the most
    significant bit on; "stage.<pin>" is the level that the second of two registers samples at a pin
    (`harness/jitter.py`).

    The top of a bench may contain more than the device. Then `fed` lists inputs of the device that the top
    drives (outputs of the bench), and `aside` lists inputs that only the top has.
    """

    name: str
    inputs: Mapping[str, int]
    outputs: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    widths: Mapping[str, int] = field(default_factory=dict)
    parameters: tuple[str, ...] = ("CLK_HZ", "XTAL_HZ", "TIMING")
    styles: tuple[BusStyle, ...] = (STROBES_RD_WR,)
    clock: str = "clock"
    style_pin: str = ""
    lowest: Mapping[str, int] = field(default_factory=dict)
    unwatched: frozenset[str] = frozenset()
    defaults: Mapping[str, object] = field(default_factory=dict)
    idle: Mapping[str, str] = field(default_factory=dict)
    shape: Callable[[Mapping[str, object]], PinTable] | None = None
    fed: frozenset[str] = frozenset()
    aside: frozenset[str] = frozenset()
    stages: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @classmethod
    def of_model(
        cls, name: str, pins: PinTable, more: Mapping[str, tuple[int, int]] | None = None, **rest: Any
    ) -> Part:
        """Return a device with the pins of its golden model, and outputs `more` that the model omits."""
        inputs, outputs, widths = _pins_of(pins)
        return cls(name, inputs, {**outputs, **(more or {})}, widths, **rest)

    @classmethod
    def of_shape(cls, name: str, shape: Callable[[Mapping[str, object]], PinTable], **rest: Any) -> Part:
        """Return a device whose port widths depend on parameters, here with the parameters `defaults`."""
        return cls.of_model(name, shape(rest["defaults"]), shape=shape, **rest)

    def built(self, params: Mapping[str, object]) -> Part:
        """Return the device with the port widths for these parameters of the top module."""
        if self.shape is None:
            return self
        inputs, outputs, widths = _pins_of(self.shape({**self.defaults, **params}))
        return replace(self, inputs=inputs, outputs=outputs, widths=widths)

    @property
    def watched(self) -> tuple[str, ...]:
        """Outputs of which a bench records each edge and compares it with the golden model."""
        return tuple(name for name in self.outputs if name not in self.unwatched)

    def params(self, config: Config) -> dict[str, Any]:
        """Return the parameters of the top module in a build configuration, including its `extra` ones."""
        added = dict(config.extra)
        return {name: v for name, v in config.params.items() if name in self.parameters or name in added}

    def reset_levels(self, params: Mapping[str, object] | None = None) -> dict[str, int]:
        """Return the output levels during reset for these parameters (P104-PORT-01, P104-PHS-02)."""
        levels = {name: level for name, (_, level) in self.outputs.items()}
        for parameter, name in self.idle.items():
            if params and parameter in params:
                levels[name] = (1 << self.width(name)) - 1 if int(str(params[parameter])) else 0
        return levels

    def width(self, pin: str) -> int:
        """Return the width of an input or output in bits."""
        return self.outputs[pin][0] if pin in self.outputs else self.widths.get(pin, 1)

    def locate(self, pin: str) -> tuple[str, int | None]:
        """Return the port of a pin, and the position of the pin in the port (None: `pin` is the whole port).

        Raises KeyError for a bit that the port does not have.
        """
        if "[" not in pin:
            return pin, None
        match = _BIT.match(pin)
        if not match:
            raise KeyError(f"{self.name} has no pin {pin}")
        port, place = match[1], int(match[2]) - self.lowest.get(match[1], 0)
        if not 0 <= place < self.width(port):
            raise KeyError(f"{self.name} has no pin {pin}")
        return port, place

    def style(self, pins: Mapping[str, int]) -> BusStyle:
        """Return the style of the host bus that these input levels select."""
        return self.styles[pins[self.style_pin] if self.style_pin else 0]

    @cached_property
    def bus_pins(self) -> frozenset[str]:
        """Input pins of the host bus; for a device without a bus, its serial line."""
        used = {pin for style in self.styles for pin in (*style.write_on, *style.read_on, style.address)}
        data = ("d_i", "sd_i") if self.styles else ("rxd",)
        return frozenset(used | {pin for pin in data if pin in self.inputs})


def _pins_of(pins: PinTable) -> tuple[dict[str, int], dict[str, tuple[int, int]], dict[str, int]]:
    """Return inputs, outputs and widths of inputs in the format of `Part`."""
    widths = pins.WIDTHS
    inputs = {pin: level for pin, level in pins.INPUTS.items() if pin != "rst_n"}
    outputs = {pin: (widths.get(pin, 1), level) for pin, level in pins.OUTPUTS.items()}
    return inputs, outputs, {pin: width for pin, width in widths.items() if pin in inputs}


class _Benches(Mapping[str, Part]):
    """The devices that have a `bench.py`, loaded on request.

    The `bench.py` in a device's folder below cocotb_tests lists the devices of the folder in PARTS.
    """

    def __getitem__(self, name: str) -> Part:
        row = parts.PARTS[name]
        module = importlib.import_module(f"cocotb_tests.{row.folder}.bench")
        found: dict[str, Part] = {part.name: part for part in module.PARTS}
        return found[name]

    def __iter__(self) -> Iterator[str]:
        for row in parts.folders():
            module = importlib.import_module(f"cocotb_tests.{row.name}.bench")
            yield from (part.name for part in module.PARTS)

    def __len__(self) -> int:
        return sum(1 for _ in self)


PARTS: Mapping[str, Part] = _Benches()


def recorded(name: str, params: Mapping[str, object]) -> Part:
    """Return the device with this name for a build with these parameters, both as stored in recordings."""
    return PARTS[name].built(params)
