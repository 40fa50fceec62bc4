"""PMC006B4 on one line: RTL or models, with EEPROM, motor, mechanical load and two switches.

The text after `sim:` or `model:` is, for example, `address=1..3,start=2000,high3=9000,speed=max`. A word with
a number at its end applies to the controller with that address; a word without a number applies to all. The
EEPROM is modelled byte by byte, because a simulation of each bit would need most of the run time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ...model.carrier.carrier import Carrier
from ...model.carrier.eeprom import BLANK, PAGE, SIZE
from ...model.clock import Edge
from ...model.pmc006.memory.eeprom import PROGRAM, Bus, BusError, BusSequence
from ...model.pmc006.part import Pmc006
from ...model.pmc006.pins import Services
from ...model.pmc006.program import assemble
from ...model.pmc006.settings import Settings, page_of
from ...textfile import read_text
from ..common.char_line import CharLine, LineStation
from ..common.lines import LineCapabilities, one_of, parse_speed, positive, split_words, whole


class Eeprom:
    """Model of an EEPROM.

    Args:
        content: bytes from address 0; all other bytes are blank.
        file: file in which the content is stored after each write.
        missing: True if no EEPROM is connected.

    Attributes:
        writes: number of writes.
    """

    def __init__(self, content: bytes, file: Path | None = None, missing: bool = False) -> None:
        self.memory = bytearray(content.ljust(SIZE, bytes([BLANK])))
        self.file, self.missing = file, missing
        self.writes = 0
        self._address = 0
        self._sent: list[int] = []

    def start(self) -> None:
        """Begin a transfer. An address that was sent before remains valid for a read."""
        self._sent = []

    def take(self, byte: int) -> None:
        """Receive the next byte from the controller; the order is device, two address bytes, data."""
        self._sent.append(byte)
        if len(self._sent) == 3:
            self._address = (self._sent[1] << 8 | byte) % SIZE

    def next_byte(self) -> int:
        """Return the next byte for the controller."""
        byte = self.memory[self._address]
        self._address = (self._address + 1) % SIZE
        return byte

    def stop(self) -> None:
        """End the transfer, and write the data bytes that followed the address."""
        data, self._sent = self._sent[3:], []
        for place, byte in enumerate(data):
            self.memory[self._address & -PAGE | self._address + place & PAGE - 1] = byte
        if data:
            self.writes += 1
            if self.file is not None:
                self.file.write_bytes(self.memory)


class QuickBus(Bus):
    """Bus interface of the controller. It transfers a whole byte in a quarter of a bit time."""

    def __init__(self, eeprom: Eeprom, services: Services, levels: Mapping[str, int], hz: int) -> None:
        super().__init__(services, levels, hz)
        self._eeprom = eeprom

    def release(self) -> None:
        """Do nothing, because this bus has no wires."""

    def start(self) -> BusSequence[None]:
        yield
        self._eeprom.start()

    def stop(self) -> BusSequence[None]:
        yield
        self._eeprom.stop()

    def write(self, byte: int | Callable[[], int]) -> BusSequence[bool]:
        yield
        if self._eeprom.missing:
            raise BusError
        self._eeprom.take(byte if isinstance(byte, int) else byte())
        return True

    def read(self, last: bool) -> BusSequence[int]:
        yield
        return self._eeprom.next_byte()


PART = "pmc006"
FACTORY, LAST = 255, 120
FARTHEST = 1 << 27
UNIT = 16
"""Number of position units in a full step.

Positions in the text are in 1/16 full steps, the steps of a factory-new controller.
"""
OWN = ("start", "low", "high", "gpi", "eeprom", "program")
OPTIONS = ("part", "address", "twin", "baud", "ack", "echo", "noise", "seed", "speed", "clk", "unplug")
KNOWN = ", ".join((*(f"{word}[N]" for word in OWN), *OPTIONS))


@dataclass(frozen=True)
class MechanicalLoad:
    """Mechanical load, inputs and EEPROM of a controller.

    Positions are in 1/16 full steps, forward positive.

    EXT1 is 0 at positions <= `low`, EXT2 is 0 at positions >= `high`.

    Attributes:
        start: initial position.
        gpi: levels of GPI5 to GPI1.
        eeprom: file with the content of the EEPROM. For None, the EEPROM is new each time and contains only
            the address.
        no_eeprom: True if no EEPROM is connected.
        program: file with the text of a program that is stored in the EEPROM and starts after power-up, or
            None.
    """

    start: int = 4000
    low: int = 0
    high: int = 40_000
    gpi: int = 0x1F
    eeprom: Path | None = None
    no_eeprom: bool = False
    program: Path | None = None

    def levels(self, position: float) -> dict[str, int]:
        """Return the levels of the switches at a position."""
        return {"ext1": int(position > self.low), "ext2": int(position < self.high)}


@dataclass(frozen=True)
class LineSpec:
    """Requested virtual line.

    Attributes:
        loads: mechanical load of each controller, by the address of the controller.
        twin: address that two controllers have, None if all addresses differ.
        baud: line rate in bit/s.
        step_ack: MANUAL or ECHO.
        echo: True if the master receives its own characters.
        noise: average number of characters, in both directions, of which one is corrupted; 0 for no noise.
        speed: multiple of real time; None for as fast as possible.
        unplug: time in s after which the port disappears.
    """

    loads: dict[int, MechanicalLoad] = field(default_factory=lambda: {FACTORY: MechanicalLoad()})
    twin: int | None = None
    baud: int = 9600
    step_ack: str = "MANUAL"
    echo: bool = False
    noise: int = 0
    seed: int = 1
    speed: float | None = 1.0
    clk_hz: int = 8_000_000
    unplug: float = float("inf")

    @property
    def rate(self) -> float:
        """Line rate in bit/s."""
        return self.baud


def at_rate(text: str, rate: int) -> str:
    """Return the text with the line rate of the host appended, unless it names a rate.

    >>> at_rate("address=5", 19200)
    'address=5,baud=19200'
    """
    return text if "baud=" in text else ",".join(filter(None, [text, f"baud={rate}"]))


def parse_line(text: str) -> LineSpec:
    """Parse `word=value,word=value`. Raise ValueError, which names the word that is wrong."""
    words = split_words(text, OWN, OPTIONS, _address)
    options = words.options
    if options.get("part", PART) != PART:
        raise ValueError(f"part={options['part']}: this line has part={PART}")
    addresses = _addresses(options.get("address", str(FACTORY)))
    for address, own in words.own.items():
        if address not in addresses:
            must_exist = ", ".join(map(str, addresses))
            raise ValueError(
                f"{next(iter(own))}{address}: no controller with this address; address= has {must_exist}"
            )
    carriages = {address: _load(words.shared | words.own.get(address, {})) for address in addresses}
    files = [one.eeprom for one in carriages.values() if one.eeprom is not None]
    if len(set(files)) < len(files):
        raise ValueError(f"eeprom={files[0]}: each controller needs its own file; write eeprom1=…")
    twin = _address("twin", options["twin"]) if "twin" in options else None
    if twin is not None and twin not in addresses:
        raise ValueError(f"twin={twin}: there is no controller {twin} to share the address with")
    return LineSpec(
        carriages,
        twin,
        whole("baud", options.get("baud", "9600"), 1200, 115_200),
        one_of("ack", options.get("ack", "manual").upper(), ("MANUAL", "ECHO")),
        one_of("echo", options.get("echo", "off"), ("on", "off")) == "on",
        whole("noise", options.get("noise", "0"), 0, 10**9),
        whole("seed", options.get("seed", "1"), 0, 1 << 32),
        parse_speed(options.get("speed", "1")),
        whole("clk", options.get("clk", "8000000"), 8_000_000, 200_000_000),
        positive("unplug", options.get("unplug", "inf")),
    )


def _load(words: dict[str, str]) -> MechanicalLoad:
    values = {word: _position(word, words[word]) for word in ("start", "low", "high") if word in words}
    eeprom = words.get("eeprom", "new")
    load = MechanicalLoad(
        **values,
        gpi=_levels(words.get("gpi", "11111")),
        eeprom=None if eeprom in ("new", "none") else _file("eeprom", eeprom, False),
        no_eeprom=eeprom == "none",
        program=_file("program", words["program"], True) if "program" in words else None,
    )
    if load.low >= load.high:
        raise ValueError(f"low={load.low},high={load.high}: EXT2 (high) must lie above EXT1 (low)")
    if load.program is not None and (load.no_eeprom or load.eeprom is not None):
        raise ValueError(f"program={load.program}: is written into a new EEPROM; omit the word eeprom")
    return load


def _addresses(text: str) -> tuple[int, ...]:
    """Parse addresses: `5`, `1..3` or `10+20`. Raise ValueError for any other text."""
    first, dots, last = text.partition("..")
    if dots:
        low, high = _address(text, first), _address(text, last)
        numbers = tuple(range(low, high + 1)) if high <= LAST else ()
    else:
        numbers = tuple(_address(text, piece) for piece in text.split("+"))
    if not numbers or len(set(numbers)) < len(numbers):
        raise ValueError(f"address={text}: write 5, 1..3 or 10+20, with addresses 1 to {LAST} or {FACTORY}")
    return numbers


def _address(item: str, text: str) -> int:
    if not text.isdigit() or not (1 <= int(text) <= LAST or int(text) == FACTORY):
        raise ValueError(f"{item}: controllers have addresses 1 to {LAST}, or {FACTORY}")
    return int(text)


def _position(word: str, text: str) -> int:
    try:
        position = int(text)
    except ValueError:
        raise ValueError(f"{word}={text}: not a whole number of 1/{UNIT} full steps") from None
    if abs(position) > FARTHEST:
        raise ValueError(f"{word}={text}: expected -{FARTHEST} to {FARTHEST}")
    return position


def _levels(text: str) -> int:
    """Parse the levels of GPI5 to GPI1. Raise ValueError for any other text."""
    if len(text) != 5 or set(text) - {"0", "1"}:
        raise ValueError(f"gpi={text}: not five levels; write GPI5 to GPI1, as 11111")
    return int(text, 2)


def _file(word: str, text: str, must_exist: bool) -> Path:
    path = Path(text)
    if path.is_dir() or not path.absolute().parent.is_dir() or (must_exist and not path.is_file()):
        raise ValueError(f"{word}={text}: no such file")
    return path


FULL_STEP = 128
"""Largest number of microsteps in a full step."""


def first_content(address: int, load: MechanicalLoad) -> bytes:
    """Return the initial content of an EEPROM, which is empty for a factory-new controller.

    Raises ValueError if the file has the wrong size, AssemblyError if the program is invalid.
    """
    if load.eeprom is not None and load.eeprom.is_file():
        content = load.eeprom.read_bytes()
        if len(content) > SIZE:
            raise ValueError(f"eeprom={load.eeprom}: {len(content)} bytes, an EEPROM has {SIZE}")
        return content
    if address == FACTORY and load.program is None:
        return b""
    content = page_of(Settings(addr=address, offline=int(load.program is not None)))
    if load.program is not None:
        text = read_text(load.program)
        content = content.ljust(PROGRAM, bytes([BLANK])) + assemble(text, str(load.program)).image()
    return content


class Part(Pmc006):
    """Golden model that accesses its EEPROM byte by byte."""

    def __init__(self, eeprom: Eeprom, spec: LineSpec, gpi: int) -> None:
        self._eeprom = eeprom
        super().__init__(spec.clk_hz, step_ack=spec.step_ack, baud=spec.baud, straps={"gpi": gpi})

    def _bus(self, services: Services, levels: Mapping[str, int]) -> Bus:
        return QuickBus(self._eeprom, services, levels, self._i2c_hz)


class Node(Carrier[Part], LineStation[Part]):
    """Controller with its mechanical load, after boot.

    `position` is the position of the load in 1/16 full steps; the position register of the part counts steps.
    The switches do not bounce.

    Args:
        number: initial address of the controller.
    """

    def __init__(self, load: MechanicalLoad, number: int, spec: LineSpec) -> None:
        self.number, self.load = number, load
        self.eeprom = Eeprom(first_content(number, load), load.eeprom, load.no_eeprom)
        self._microsteps = load.start * FULL_STEP // UNIT
        part = Part(self.eeprom, spec, load.gpi)
        super().__init__(part, [load], lambda: None)
        while part.booting:
            self.run_until(self.t + self.clk_hz // 10_000)

    # ------------------------------------------------------------------ of `Carrier`

    def switch_pins(self, levels: Sequence[dict[str, int]]) -> dict[str, int]:
        return levels[0]

    def straps(self, levels: int) -> None:
        """Do nothing, because the part has no straps."""

    def pins(self) -> int:
        return 0

    def watched_register(self) -> object:
        return None

    def _follow(self, edge: Edge) -> None:
        if edge.signal == "mon_step" and edge.value:
            motion = self.part.motion
            self._microsteps += motion.increment if motion.forward else -motion.increment
            self.positions[0] = self._microsteps * UNIT // FULL_STEP

    # ------------------------------------------------------------------ of a station

    def status_text(self) -> str:
        """Return address, position of the load, state, inputs and outputs as text."""
        context = self.part.context
        flags = context.stop_monitor.latched("ext1") or context.stop_monitor.latched("ext2")
        state = (
            "boot"
            if self.part.booting
            else "moving"
            if self.part.outputs["mon_busy"]
            else "free"
            if context.settings.free
            else "locked"
            if flags
            else "idle"
        )
        gpi, gpo = self.part.inputs["gpi"], self.part.outputs["gpo"]
        return f"{context.settings.addr}:{self.position}:{state}:{gpi:05b}:{gpo:05b}"

    def set_inputs(self, levels: str) -> None:
        """Set the levels of GPI5 to GPI1, as "11111"."""
        self.set_pins(gpi=int(levels, 2))


class NodeLine(CharLine[Node]):
    """Line on which each controller receives all characters and selects its own frames."""

    def __init__(self, spec: LineSpec) -> None:
        numbered = [*spec.loads.items()]
        if spec.twin is not None:
            numbered.append((spec.twin, spec.loads[spec.twin]))
        nodes = [Node(load, number, spec) for number, load in numbered]
        super().__init__(spec, nodes, spec.clk_hz / spec.baud)


def parameters(spec: LineSpec) -> dict[str, int | str]:
    """Return the parameters of tb/pmc006/line/line_node.sv."""
    return {"CLK_HZ": spec.clk_hz, "STEP_ACK": spec.step_ack, "BAUD": spec.baud}


def arguments(spec: LineSpec, files: Path) -> list[str]:
    """Return the arguments of the program in tb/line with tb/pmc006/line/node.h.

    Raises ValueError if a file is unusable.

    Args:
        files: folder into which the contents of the EEPROMs are written.
    """
    addresses = [*spec.loads, *([] if spec.twin is None else [spec.twin])]
    words = [f"stations={len(addresses)}"]
    for place, address in enumerate(addresses):
        its = spec.loads[address]
        image = files / f"eeprom{place}"
        image.write_bytes(first_content(address, its))
        known: dict[str, object] = {"start": its.start, "low": its.low, "high": its.high, "gpi": its.gpi}
        known |= {"no_eeprom": int(its.no_eeprom), "image": image}
        if its.eeprom is not None:
            known["keep"] = its.eeprom.absolute()
        words += [f"{name}{place}={value}" for name, value in known.items()]
    return words


MACHINE = LineCapabilities(
    parse_line, at_rate, KNOWN, NodeLine, parameters, arguments, sources=("pmc006/eeprom_24c32.sv",)
)
