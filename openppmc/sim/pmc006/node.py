"""A modelled PMC006B4 with its EEPROM, and a motor with a carriage between two switches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...model.carrier.carrier import Carrier
from ...model.carrier.eeprom import BLANK, SIZE
from ...model.clock import Edge
from ...model.pmc006.memory.eeprom import PROGRAM, Bus
from ...model.pmc006.part import Pmc006
from ...model.pmc006.pins import Shared
from ...model.pmc006.program import assemble
from ...model.pmc006.settings import Settings, page_of
from ...textfile import read_text
from ..common.char_line import LineStation
from .eeprom import Eeprom, QuickBus
from .line_spec import FACTORY, UNIT, Carriage, LineSpec

FULL_STEP = 128
"""Units of a full step: the finest microsteps."""


def first_content(address: int, carriage: Carriage) -> bytes:
    """What an EEPROM holds at first: nothing at all in a factory-new controller. ValueError for a file that
    is none, AssemblyError for a program with a mistake."""
    if carriage.eeprom is not None and carriage.eeprom.is_file():
        content = carriage.eeprom.read_bytes()
        if len(content) > SIZE:
            raise ValueError(f"eeprom={carriage.eeprom}: {len(content)} bytes, an EEPROM has {SIZE}")
        return content
    if address == FACTORY and carriage.program is None:
        return b""
    content = page_of(Settings(addr=address, offline=int(carriage.program is not None)))
    if carriage.program is not None:
        text = read_text(carriage.program)
        content = content.ljust(PROGRAM, bytes([BLANK])) + assemble(text, str(carriage.program)).image()
    return content


class Part(Pmc006):
    """The model, with an EEPROM that is spoken to byte by byte."""

    def __init__(self, eeprom: Eeprom, spec: LineSpec, gpi: int) -> None:
        self._eeprom = eeprom
        super().__init__(spec.clk_hz, step_ack=spec.step_ack, baud=spec.baud, straps={"gpi": gpi})

    def _bus(self, shared: Shared, levels: Mapping[str, int]) -> Bus:
        return QuickBus(self._eeprom, shared, levels, self._i2c_hz)


class Node(Carrier[Part], LineStation[Part]):
    """number: its address at first. `position` is the carriage's in 1/16 full steps, the part itself counts
    steps. The switches are optical: they do not bounce. It has been on for a while: it has booted."""

    def __init__(self, carriage: Carriage, number: int, spec: LineSpec) -> None:
        self.number, self.carriage = number, carriage
        self.eeprom = Eeprom(first_content(number, carriage), carriage.eeprom, carriage.no_eeprom)
        self._way = carriage.start * FULL_STEP // UNIT
        part = Part(self.eeprom, spec, carriage.gpi)
        super().__init__(part, [carriage], lambda: None)
        while part.booting:
            self.run_until(self.t + self.clk_hz // 10_000)

    # ------------------------------------------------------------------ of `Carrier`

    def switch_pins(self, levels: Sequence[dict[str, int]]) -> dict[str, int]:
        return levels[0]

    def straps(self, levels: int) -> None:
        """None."""

    def pins(self) -> int:
        return 0

    def shown(self) -> object:
        return None

    def _follow(self, edge: Edge) -> None:
        if edge.signal == "mon_step" and edge.value:
            motion = self.part.motion
            self._way += motion.increment if motion.forward else -motion.increment
            self.positions[0] = self._way * UNIT // FULL_STEP

    # ------------------------------------------------------------------ of a station

    def words(self) -> str:
        """Address, position of the carriage, state, inputs, outputs."""
        desk = self.part.desk
        flags = desk.guard.latched("ext1") or desk.guard.latched("ext2")
        state = (
            "boot"
            if self.part.booting
            else "moving"
            if self.part.outputs["mon_busy"]
            else "free"
            if desk.settings.free
            else "locked"
            if flags
            else "idle"
        )
        gpi, gpo = self.part.inputs["gpi"], self.part.outputs["gpo"]
        return f"{desk.settings.addr}:{self.position}:{state}:{gpi:05b}:{gpo:05b}"

    def set_inputs(self, levels: str) -> None:
        """Levels of GPI5 to GPI1, as "11111"."""
        self.set_pins(gpi=int(levels, 2))
