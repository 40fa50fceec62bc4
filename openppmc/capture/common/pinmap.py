"""Assignment of the channels of a capture to pins.

A YAML or TOML file contains the assignment. Without a file, each channel must have the name of its pin.

part: ppmc104            # or --part
crystal: 16000000        # of the original chip, Hz
timing: DATASHEET        # FAST for a capture of our own core
scope: station3          # of a VCD that has the same names in several scopes
pins:
  d: [D0, D1, D2, D3, D4, D5, D6, D7]      # a port: bit 0 first
  a0: "ch 8"
  cs_n: 9                # place of the channel in the file, from 0 on
  alm_n: "!ALARM"        # inverted
  s[1]: PH1              # one bit of a port
"""

from __future__ import annotations

import importlib
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from ...errors import needs
from ...textfile import read_text
from .errors import CaptureError
from .signals import Bits, Capture, Channel

NUMBERS = frozenset(("CLK_HZ", "XTAL_HZ", "BAUD", "ADR"))
"""Parameters in a pin map that must be numbers."""
WORDS = ("part", "crystal", "timing", "scope", "parameters", "pins")
_PLACE = re.compile(r"(\w+)\[(\d+)\]")
_INDEXED = re.compile(r"(.+?)\s*\[(-?\d+)\]")
_PIECE = re.compile(r"(.+?)\[(-?\d+):(-?\d+)\]")


@dataclass(frozen=True)
class Pins:
    """Pins of a part that a map may contain.

    Attributes:
        widths: bits by name.
        lowest: number of the lowest bit if it is not 0.
        aliases: other names.
    """

    widths: Mapping[str, int]
    lowest: Mapping[str, int] = field(default_factory=dict)
    aliases: Mapping[str, str] = field(default_factory=dict)

    def place(self, pin: str) -> tuple[str, int]:
        """Return port and bit of a text such as `s[1]` or `cs_n`.

        Raises ValueError for any other text.
        """
        pin = self.aliases.get(pin, pin)
        match = _PLACE.fullmatch(pin)
        port, number = (match[1], int(match[2])) if match else (pin, -1)
        if port not in self.widths:
            raise ValueError(f"{pin} is no pin of it (there are {', '.join(self.widths)})")
        if match is None:
            if self.widths[port] > 1:
                raise ValueError(
                    f"{pin} has {self.widths[port]} bits: give a list, bit {self.low(port)} first"
                )
            return port, 0
        bit = number - self.low(port)
        if not 0 <= bit < self.widths[port]:
            last = self.low(port) + self.widths[port] - 1
            raise ValueError(f"{pin}: {port} has bits {self.low(port)} to {last}")
        return port, bit

    def text_of(self, port: str, bit: int) -> str:
        """Return the name of a pin as in the manual."""
        return f"{port}[{bit + self.low(port)}]" if self.widths[port] > 1 else port

    def low(self, port: str) -> int:
        """Return the number of the lowest bit of this port in the data sheet."""
        return self.lowest.get(port, 0)


@dataclass
class PinMap:
    """Pin map from a file.

    Attributes:
        pins: channel of each pin as written in the file; `None` if the names of the channels are used.
        scope: scope of a VCD; its channels have priority over channels of the same name in other scopes.
    """

    name: str = "the channels' names"
    part: str | None = None
    crystal: int | None = None
    timing: str | None = None
    parameters: dict[str, object] = field(default_factory=dict)
    pins: dict[str, Any] | None = None
    scope: str = ""


def _yaml(text: str, name: str) -> Any:
    """Parse YAML. Raises ValueError if the text is not YAML."""
    needs("decode", f"{name}: a pin map in YAML", "yaml")
    import yaml

    try:
        return yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(str(error)) from None


def read_map(path: Path) -> PinMap:
    """Read a pin map. Raises CaptureError for any other file."""
    try:
        text = read_text(path)
        values = _toml(text) if path.suffix.lower() == ".toml" else _yaml(text, path.name)
    except OSError as error:
        raise CaptureError(f"{path}: the pin map cannot be read ({error.strerror})") from None
    except ValueError as error:
        raise CaptureError(f"{path.name}: no pin map ({' '.join(str(error).split())})") from None
    if not isinstance(values, dict) or not isinstance(values.get("pins"), dict) or not values["pins"]:
        raise CaptureError(f"{path.name}: no pin map: it needs `pins:` with a channel for each pin")
    for word in values:
        if word not in WORDS:
            raise CaptureError(f"{path.name}: {word}: there are {', '.join(WORDS)}")
    crystal, timing = values.get("crystal"), values.get("timing")
    if crystal is not None and not (isinstance(crystal, int) and 1_000_000 <= crystal <= 20_000_000):
        raise CaptureError(f"{path.name}: crystal: {crystal}: expected 1000000 to 20000000 Hz")
    if timing not in (None, "FAST", "DATASHEET"):
        raise CaptureError(f"{path.name}: timing: {timing}: neither FAST nor DATASHEET")
    part, parameters = values.get("part"), values.get("parameters") or {}
    if part is not None and not isinstance(part, str):
        raise CaptureError(f"{path.name}: part: {part}: expected a name, as ppmc104")
    if not isinstance(parameters, dict):
        raise CaptureError(f"{path.name}: parameters: {parameters}: expected a name and a value for each")
    parameters = {str(name).upper(): value for name, value in parameters.items()}
    for name in NUMBERS & set(parameters):
        value = parameters[name]
        if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value <= 10**10:
            raise CaptureError(f"{path.name}: {name}: {value}: expected a whole number")
    return PinMap(
        path.name,
        part,
        crystal,
        timing,
        parameters,
        values["pins"],
        str(values.get("scope") or ""),
    )


def _toml(text: str) -> Any:
    try:
        reader = importlib.import_module("tomllib")
    except ImportError:
        raise ValueError("TOML needs Python 3.11: write it as YAML") from None
    return reader.loads(text)


def wired(capture: Capture, chosen: PinMap, pins: Pins) -> dict[str, Mapping[int, Channel]]:
    """Return the channel of each pin, by port and bit.

    Raises CaptureError if the map does not match the capture or the part.
    """
    found: dict[str, Mapping[int, Channel]] = {}
    used: dict[str, str] = {}
    capture = _scoped(capture, chosen.scope)
    if chosen.pins is None:
        _by_name(capture, pins, found)
        return found
    for pin, what in chosen.pins.items():
        try:
            if isinstance(what, list):
                port = str(pin)
                if port not in pins.widths or len(what) != pins.widths[port]:
                    raise ValueError(
                        f"{port}: {len(what)} channels, it has {pins.widths.get(port, 'no')} bits"
                    )
                places = [(port, bit, one) for bit, one in enumerate(what)]
            else:
                places = [(*pins.place(str(pin)), what)]
            for port, bit, one in places:
                if one is None:
                    continue
                name, channel = _channel(capture, one)
                if name in used and name != "":
                    raise ValueError(f"{pin}: channel {name} is {used[name]} already")
                used[name] = str(pin)
                own = found.setdefault(port, {})
                assert isinstance(own, dict)
                own[bit] = channel
        except ValueError as error:
            raise CaptureError(f"{chosen.name}: {error}") from None
    return found


def _scoped(capture: Capture, scope: str) -> Capture:
    """Return the capture, with the channels of this scope also under their names without the scope.

    Raises:
        CaptureError: the capture has no such scope.
    """
    if not scope:
        return capture
    own = {
        name.removeprefix(f"{scope}."): channel
        for name, channel in capture.channels.items()
        if name.startswith(f"{scope}.")
    }
    if not own:
        scopes = dict.fromkeys(name.rpartition(".")[0] for name in capture.channels if "." in name)
        there = f"there are {', '.join(scopes)}" if scopes else "there is nothing to choose from"
        raise CaptureError(f"{capture.name}: no scope {scope} in it ({there})")
    return replace(capture, channels={**capture.channels, **own})


def _channel(capture: Capture, what: object) -> tuple[str, Channel]:
    """Return a channel by its name or its place in the file; a leading `!` inverts the channel."""
    names = list(capture.channels)
    if isinstance(what, int) and not isinstance(what, bool):
        if not 0 <= what < len(names):
            raise ValueError(f"channel {what}: {capture.name} has channels 0 to {len(names) - 1}")
        return names[what], capture.channels[names[what]]
    text = str(what)
    inverted = text.startswith("!") and text not in capture.channels
    name = text.removeprefix("!").strip() if inverted else text
    name = name if name in capture.channels else name.strip()
    place = _INDEXED.fullmatch(name)
    if name not in capture.channels and place:
        channel = _indexed(capture, place[1], int(place[2]))
    elif name in capture.channels:
        channel = capture.channels[name]
    else:
        raise ValueError(f"no channel {name!r} in {capture.name} (there are {', '.join(names)})")
    if name in capture.doubled:
        raise ValueError(f"two channels of {capture.name} are called {name!r}: name the channel by its place")
    if channel.width > 1:
        low = channel.indices[0]
        raise ValueError(f"channel {name!r} has {channel.width} bits: name one, as {name}[{low}]")
    return text, channel.inverted() if inverted else channel


def _indexed(capture: Capture, name: str, index: int) -> Channel:
    """Return a bit of a vector by its declared index. Raises ValueError if there is no such bit."""
    ranges = []
    for key, channel in capture.channels.items():
        piece = _PIECE.fullmatch(key)
        if (piece[1] if piece else key) != name:
            continue
        if channel.width > 1 and index in channel.indices:
            return channel.bit(channel.indices.index(index))
        if channel.width == 1 and index == 0:
            return channel
        ranges.append(f"{channel.indices[0]} to {channel.indices[-1]}")
    names = ", ".join(capture.channels)
    if ranges:
        raise ValueError(f"channel {name}[{index}]: {capture.name} has its bits {' and '.join(ranges)}")
    raise ValueError(f"no channel '{name}[{index}]' in {capture.name} (there are {names})")


def _by_name(capture: Capture, pins: Pins, found: dict[str, Mapping[int, Channel]]) -> None:
    """Add each channel that has the name of a pin."""
    used: dict[tuple[str, int], str] = {}
    for name, channel in capture.channels.items():
        plain = name.strip().lower()
        try:
            if channel.width > 1:
                piece = _PIECE.fullmatch(plain)
                port = piece[1] if piece else plain
                width = pins.widths.get(port, 0)
                if channel.width == width and not piece:
                    # The lowest declared index is the lowest bit of the port. For example, [8:1] matches a
                    # bus that the manual numbers from 7 to 0.
                    found[port] = Bits(channel)
                elif width and piece:
                    own = found.setdefault(port, {})
                    low = min((one.indices[0] for key, one in _pieces(capture, port)), default=0)
                    assert isinstance(own, dict)
                    own.update(
                        (index - low, channel.bit(n))
                        for n, index in enumerate(channel.indices)
                        if 0 <= index - low < width
                    )
                continue
            port, bit = pins.place(_numbered(plain, pins))
        except ValueError:
            continue
        if name in capture.doubled or used.get((port, bit), name) != name:
            other = used.get((port, bit), name)
            raise CaptureError(
                f"{capture.name}: two channels are {pins.text_of(port, bit)} ({other}, {name}): name the "
                "right one with --map FILE"
            )
        one = found.setdefault(port, {})
        if isinstance(one, dict):
            used[port, bit] = name
            one[bit] = channel
    if not found:
        raise CaptureError(
            f"{capture.name}: no channel is called like a pin of this part ({', '.join(capture.channels)}): "
            "name them with --map FILE"
        )


def _pieces(capture: Capture, port: str) -> list[tuple[str, Channel]]:
    """Return the vectors whose names state which bits of the port they contain."""
    rows = [(_PIECE.fullmatch(name.strip().lower()), name) for name in capture.channels]
    return [(name, capture.channels[name]) for piece, name in rows if piece and piece[1] == port]


def _numbered(name: str, pins: Pins) -> str:
    """Return the name with its index in brackets: `s[1]` for `s1`, `pout_n[1]` for `pout1_n`."""
    match = re.fullmatch(r"([a-z]+?)_?(\d+)(_n)?", name)
    if match is None:
        match = re.fullmatch(r"([a-z]+\d*)\s*\[(\d+)\]()", name) or re.fullmatch(r"([a-z]+) (\d+)(_n)?", name)
    if name in pins.widths or name in pins.aliases or match is None:
        return name
    return f"{match[1]}{match[3] or ''}[{match[2]}]"
