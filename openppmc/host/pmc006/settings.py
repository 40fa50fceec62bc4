"""Settings of a PMC006B4: instruction codes, ranges, units, and whether `save` stores a setting.

Each setting is a property of `Settings`.
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass
from functools import partial
from typing import overload

from ..check import whole
from ..errors import OutOfRange
from .station_link import StationLink
from .wire import STATUS_1_BITS, STATUS_2_BITS, Code, SettingRefused

MICROSTEPS = (1, 2, 4, 8, 16, 32, 64, 128)
DRIVE_FIRST, DRIVE_STEP = 400, 150
LEAST_ACCELERATION = 1700
NO_WRITE = 1 << 30
"""Value that no setting accepts. An instruction with this value only returns the active value."""


def mean_acceleration(coefficient: int) -> int:
    """Return the mean acceleration in steps/s² for a ramp coefficient from 0 to 5.

    >>> mean_acceleration(3)
    13600
    """
    return LEAST_ACCELERATION << coefficient


def coefficient(acceleration: float) -> int:
    """Return the highest coefficient that is not above this acceleration in steps/s². Raises OutOfRange."""
    for found in reversed(range(6)):
        if mean_acceleration(found) <= acceleration * (1 + 1e-9):
            return found
    raise OutOfRange(f"acceleration {acceleration:g} steps/s² is below {LEAST_ACCELERATION}")


def drive_current(milliamperes: int) -> int:
    """Return the motor current for a setting in mA: the nearest of the levels 400, 550, …, 4000.

    >>> drive_current(800), drive_current(1500)
    (850, 1450)
    """
    return DRIVE_FIRST + (milliamperes - DRIVE_FIRST + DRIVE_STEP // 2) // DRIVE_STEP * DRIVE_STEP


@dataclass(frozen=True)
class Setting:
    """Setting of the part, as a property that reads and writes it.

    Attributes:
        write: instruction that writes the setting.
        read: instruction that reads the setting; `None` if a write with an invalid value is used to read it.
        accepts: valid values, as users specify them.
        span: valid values as text.
        text: purpose of the setting.
        unit: unit of the value.
        saved: True if `save` stores it.
        shift: position of the lowest bit of the setting in the reply.
        bits: number of bits of the setting.
        word: number of bits of the reply that are used.
    """

    write: Code
    read: Code | None
    accepts: Container[int]
    span: str
    text: str
    unit: str = ""
    saved: bool = True
    shift: int = 0
    bits: int = 32
    word: int = 32

    def __set_name__(self, owner: type, name: str) -> None:
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "__doc__", f"{self.text}: {self.span}{self.unit and ' ' + self.unit}.")

    name = ""
    hint = ""

    @overload
    def __get__(self, node: None, owner: type) -> Setting: ...
    @overload
    def __get__(self, node: StationLink, owner: type) -> int: ...
    def __get__(self, node: StationLink | None, owner: type) -> Setting | int:
        if node is None:
            return self
        if self.read is None:
            return self.known(node.execute(self.write, NO_WRITE))
        got = node.execute(self.read, good=self._plausible)
        return self.known(got >> self.shift & (1 << self.bits) - 1)

    def __set__(self, node: StationLink, value: int) -> None:
        if isinstance(value, bool) and self.accepts == range(2):
            value = int(value)
        value = whole(value, self.name)
        if value not in self.accepts:
            unit = self.unit and f" {self.unit}"
            raise OutOfRange(f"{self.name} {value}: there are {self.span}{unit}{self.hint}")
        data = self.data(value)
        got = node.execute(self.write, data, good=lambda reply: reply == data, sure=False)
        if got != data:
            raise SettingRefused(
                got, f"{node._message_prefix}{self.name} {value} was rejected; it is still {self.known(got)}"
            )
        if self.name in _SHOW_A_RESET:
            node.unsaved[self.name] = value

    def _plausible(self, data: int) -> bool:
        """Return True if a reply can have this value.

        The reply contains the value of the setting, or a word in which some bits are the setting.
        """
        return data == 0 or (data in self.accepts if self.word == 32 else 0 < data < 1 << self.word)

    def data(self, value: int) -> int:
        """Return the data that are sent to set this value."""
        return value

    def known(self, data: int) -> int:
        """Return the value of the setting for data that were read."""
        return data


class FullSteps(Setting):
    """Number of microsteps per full step. For full steps, the part uses 0, but users write 1."""

    hint = "; 1 is the full step"

    def data(self, value: int) -> int:
        return 0 if value == 1 else value

    def known(self, data: int) -> int:
        return data or 1


_InStatus1 = partial(Setting, word=STATUS_1_BITS, bits=1)
_InStatus2 = partial(Setting, word=STATUS_2_BITS, saved=False)
_SPEED = (range(65, 3001), "65 to 3000")
_SHOW_A_RESET = ("direction", "stops", "max_speed")
"""Settings that a reset changes, because `save` does not store them; each has an instruction to read it."""


class Settings(StationLink):
    """Settings of a controller. Each assignment is checked against the reply.

    A value out of range raises OutOfRange before it is sent. A value that the part rejects raises
    SettingRefused.
    """

    def remember(self, name: str) -> None:
        """Read a setting and store its value for `was_reset`, unless a value is already stored."""
        if name not in self.unsaved:
            self.unsaved[name] = getattr(self, name)

    def was_reset(self) -> bool:
        """Return True if one of the settings that a reset changes differs from its stored value.

        If all these settings had their factory values before a reset, the method cannot detect the reset.
        """
        return any(getattr(self, name) != value for name, value in self.unsaved.items())

    microsteps = FullSteps(
        Code.MICROSTEPS,
        Code.READ_MICROSTEPS,
        MICROSTEPS,
        "1, 2, 4, 8, 16, 32, 64, 128",
        "steps that a full step is divided into, from the next motion on",
    )
    current = Setting(
        Code.CURRENT, Code.READ_CURRENT, range(400, 4001), "400 to 4000", "peak phase current", "mA"
    )
    max_speed = Setting(
        Code.MAX_SPEED,
        Code.READ_MAX_SPEED,
        range(1, 16_001),
        "1 to 16000",
        "top speed of moves and speed of free runs, effective immediately",
        "steps/s",
        saved=False,
    )
    start_speed = Setting(Code.START_SPEED, None, *_SPEED, "speed of the first step", "steps/s")
    stop_speed = Setting(Code.STOP_SPEED, None, *_SPEED, "speed of the last step", "steps/s")
    acceleration = Setting(
        Code.ACCELERATION, Code.READ_ACCELERATION, range(6), "0 to 5", "coefficient n: 1700 x 2^n steps/s²"
    )
    deceleration = Setting(
        Code.DECELERATION, Code.READ_DECELERATION, range(6), "0 to 5", "coefficient n, as for acceleration"
    )
    auto_decay = _InStatus1(
        Code.AUTO_DECAY,
        Code.STATUS_1,
        range(2),
        "0 or 1",
        "1: less current 100 ms after a motion",
        shift=3,
    )
    attenuation = Setting(
        Code.ATTENUATION,
        Code.READ_ATTENUATION,
        range(1, 5),
        "1 to 4",
        "n: reduced current at standstill is 1/2^n of the peak",
    )
    current_compensation = Setting(
        Code.CURRENT_COMPENSATION, None, range(100, 1201), "100 to 1200", "additional current at speed"
    )
    speed_compensation = Setting(
        Code.SPEED_COMPENSATION, None, range(300, 2001), "300 to 2000", "phase lead at speed"
    )
    trigger = Setting(
        Code.TRIGGER,
        Code.READ_TRIGGER,
        range(4),
        "0 to 3",
        "edge that stops the motor, bit 0 EXT1, bit 1 EXT2: 0 falling, 1 rising",
    )
    offline = Setting(
        Code.OFFLINE,
        Code.STATUS_2,
        range(2),
        "0 or 1",
        "run the program after power-up; 0 also halts it",
        word=STATUS_2_BITS,
        shift=5,
        bits=1,
    )
    stops = _InStatus2(
        Code.EXT_ENABLE,
        Code.STATUS_2,
        range(4),
        "0 to 3",
        "enabled emergency stops, bit 0 EXT1, bit 1 EXT2",
        shift=1,
        bits=2,
    )
    direction = _InStatus2(
        Code.DIRECTION,
        Code.STATUS_2,
        range(2),
        "0 or 1",
        "direction of the next motion: 1 forward, 0 backward",
        shift=4,
        bits=1,
    )
    free = _InStatus2(Code.FREE, Code.STATUS_2, range(2), "0 or 1", "motor off-line, without current", bits=1)
    stall_length = Setting(
        Code.STALL_LENGTH, None, range(64), "0 to 63", "consecutive samples that mean a stall", saved=False
    )
    stall_config = Setting(
        Code.STALL_CONFIG, None, range(8), "0 to 7", "bit 0 detect, 1 stop, 2 raise GPO5", saved=False
    )
    stall_level = Setting(
        Code.STALL_LEVEL, None, range(512), "0 to 511", "back-EMF below which a sample counts", saved=False
    )


SETTINGS: dict[str, Setting] = {
    name: value for name, value in vars(Settings).items() if isinstance(value, Setting)
}
"""All settings by name."""


def setting(name: str) -> Setting:
    """Return the setting of this name. Raises OutOfRange if it does not exist."""
    try:
        return SETTINGS[name.replace("-", "_").lower()]
    except KeyError:
        raise OutOfRange(f"no setting {name!r}: there are {', '.join(SETTINGS)}") from None
