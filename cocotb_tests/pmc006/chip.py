"""EEPROM of a PMC006 under test: for the RTL, a device in the top of the bench; for the golden model, a
Python model.

Tests describe the EEPROM (`Chip`), load it, read its bytes and its log of writes, and inject faults.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, NamedTuple

from cocotb_tests.harness import DutBench, ModelBench, RtlBench
from openppmc.model.carrier.eeprom import PAGE, SIZE, Eeprom24C32

from .i2c_bus import I2cBus


@dataclass(frozen=True)
class Chip:
    """An EEPROM that was just powered up.

    Attributes:
        content: bytes from address 0 on; all further bytes are FF.
        write_us: time of a write cycle.
        stretch_us: time for which SCL is held low after each acknowledge.
        missing: True if no device responds.
        other: True if the address of the device differs from the one that the part uses.
        stuck: "scl" or "sda", a line that is held low.
        busy_us: time after power-up for which a write cycle is in progress.
    """

    content: bytes = b""
    write_us: int = 5_000
    stretch_us: int = 0
    missing: bool = False
    other: bool = False
    stuck: str = ""
    busy_us: int = 0


class Written(NamedTuple):
    """A page write: address of its first byte, the bytes in the order of arrival."""

    address: int
    data: bytes


class Eeprom(ABC):
    """EEPROM of a test. Faults take effect from the present edge on."""

    @property
    @abstractmethod
    def writes(self) -> list[Written]:
        """All page writes so far."""

    @property
    @abstractmethod
    def memory(self) -> bytes:
        """Content of the memory."""

    @abstractmethod
    def missing(self, on: bool) -> None:
        """Set whether the device ignores the bus and does not respond."""

    @abstractmethod
    def stuck(self, line: str, on: bool) -> None:
        """Set whether the device holds a line low."""

    @abstractmethod
    def stretch(self, clk: int) -> None:
        """Set the number of cycles for which the device holds SCL low after each acknowledge."""


def plug_in(bench: DutBench, chip: Chip, clk_hz: int, device: int) -> Eeprom:
    """Connect a device to a part just out of reset, before edge 0.

    Args:
        device: device address that the part uses.
    """
    address = device ^ chip.other
    if isinstance(bench, ModelBench):
        return _OnModel(bench, chip, clk_hz, address)
    assert isinstance(bench, RtlBench)
    return _OnBench(bench, chip, clk_hz, address)


class _Bussed:
    """The golden model and the devices on its lines, combined in one object."""

    def __init__(self, model: Any, bus: I2cBus) -> None:
        self._model, self._bus = model, bus

    def __getattr__(self, name: str) -> Any:
        return getattr(self._model, name)

    @property
    def next_event(self) -> int | None:
        """Next edge at which the model or the bus has an event; None if there is no such edge."""
        return min((t for t in (self._model.next_event, self._bus.due) if t is not None), default=None)


class _OnModel(Eeprom):
    """The EEPROM as a Python model."""

    def __init__(self, bench: ModelBench, chip: Chip, clk_hz: int, device: int) -> None:
        self._bench = bench
        self._chip = made = Eeprom24C32(
            clk_hz, chip.content, device, chip.write_us, chip.stretch_us, chip.missing
        )
        made.stuck_scl, made.stuck_sda = chip.stuck == "scl", chip.stuck == "sda"
        made.occupy(-(-chip.busy_us * clk_hz // 1_000_000))
        self._bus = I2cBus(bench.model, made)
        bench.model = _Bussed(bench.model, self._bus)

    @property
    def writes(self) -> list[Written]:
        """All page writes so far."""
        return [Written(one.address, one.data) for one in self._chip.writes]

    @property
    def memory(self) -> bytes:
        """Content of the memory."""
        return bytes(self._chip.memory)

    def missing(self, on: bool) -> None:
        """Set whether the device ignores the bus and does not respond."""
        self._chip.missing = on
        if on:
            self._chip.sda = self._chip.scl = 0

    def stuck(self, line: str, on: bool) -> None:
        """Set whether the device holds a line low."""
        setattr(self._chip, f"stuck_{line}", on)
        self._bus.again(self._bench.now)

    def stretch(self, clk: int) -> None:
        """Set the number of cycles for which the device holds SCL low after each acknowledge."""
        self._chip.stretch_clk = clk


class _OnBench(Eeprom):
    """The EEPROM in the top of the bench (tb/pmc006/eeprom_24c32.sv), whose signals are accessed by name."""

    def __init__(self, bench: RtlBench, chip: Chip, clk_hz: int, device: int) -> None:
        self._device = bench.dut.u_eeprom
        self._log: list[Written] = []

        def clk(micros: int) -> int:
            return -(-micros * clk_hz // 1_000_000)

        for place, byte in enumerate(chip.content):
            self._device.memory[place].value = byte
        self._set(
            device=device, write_cycles=clk(chip.write_us), writing=clk(chip.busy_us), missing=chip.missing
        )
        self._set(stuck_scl=chip.stuck == "scl", stuck_sda=chip.stuck == "sda")
        self.stretch(clk(chip.stretch_us))
        bench.set(ee_on=1)

    def _set(self, **options: int) -> None:
        for name, value in options.items():
            getattr(self._device, name).value = int(value)

    @property
    def writes(self) -> list[Written]:
        """All page writes so far."""
        one, log = self._device, self._log
        for n in range(len(log), int(one.writes.value)):
            count = int(one.log_count[n].value)
            data = bytes(int(one.log_data[PAGE * n + place].value) for place in range(count))
            log.append(Written(int(one.log_address[n].value), data))
        return log

    @property
    def memory(self) -> bytes:
        """Content of the memory."""
        return bytes(int(self._device.memory[place].value) for place in range(SIZE))

    def missing(self, on: bool) -> None:
        """Set whether the device ignores the bus and does not respond."""
        self._set(missing=on)

    def stuck(self, line: str, on: bool) -> None:
        """Set whether the device holds a line low."""
        self._set(**{f"stuck_{line}": on})

    def stretch(self, clk: int) -> None:
        """Set the number of cycles for which the device holds SCL low after each acknowledge."""
        self._set(stretch_cycles=clk)
