"""The EEPROM of a modelled PMC006B4, byte by byte: bit by bit it would cost most of the time there is."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from ...model.carrier.eeprom import BLANK, PAGE, SIZE
from ...model.pmc006.memory.eeprom import Bus, BusError, Course
from ...model.pmc006.pins import Shared


class Eeprom:
    """content: from address 0; the rest is blank. file: gets the content after each write. missing: there is
    none. writes: how many there were."""

    def __init__(self, content: bytes, file: Path | None = None, missing: bool = False) -> None:
        self.memory = bytearray(content.ljust(SIZE, bytes([BLANK])))
        self.file, self.missing = file, missing
        self.writes = 0
        self._address = 0
        self._sent: list[int] = []

    def start(self) -> None:
        """What comes next begins anew; an address that was sent is kept for reading."""
        self._sent = []

    def take(self, byte: int) -> None:
        """A byte of the controller: device, address, then data."""
        self._sent.append(byte)
        if len(self._sent) == 3:
            self._address = (self._sent[1] << 8 | byte) % SIZE

    def give(self) -> int:
        """The next byte for the controller."""
        byte = self.memory[self._address]
        self._address = (self._address + 1) % SIZE
        return byte

    def stop(self) -> None:
        """What was sent behind the address is written."""
        data, self._sent = self._sent[3:], []
        for place, byte in enumerate(data):
            self.memory[self._address & -PAGE | self._address + place & PAGE - 1] = byte
        if data:
            self.writes += 1
            if self.file is not None:
                self.file.write_bytes(self.memory)


class QuickBus(Bus):
    """The controller's side of the two wires: a byte a quarter bit."""

    def __init__(self, eeprom: Eeprom, shared: Shared, levels: Mapping[str, int], hz: int) -> None:
        super().__init__(shared, levels, hz)
        self._eeprom = eeprom

    def let_go(self) -> None:
        """There are no wires."""

    def start(self) -> Course[None]:
        yield
        self._eeprom.start()

    def stop(self) -> Course[None]:
        yield
        self._eeprom.stop()

    def write(self, byte: int | Callable[[], int]) -> Course[bool]:
        yield
        if self._eeprom.missing:
            raise BusError
        self._eeprom.take(byte if isinstance(byte, int) else byte())
        return True

    def read(self, last: bool) -> Course[int]:
        yield
        return self._eeprom.give()
