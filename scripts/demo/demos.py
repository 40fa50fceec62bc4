"""Description of a demo: its test, the wording of host accesses, its waveforms and its picture.

Each part has its own description in scripts/demo/; the column `demo` of the table of parts names it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from cocotb_tests.harness.config import F16, Config
from openppmc.capture.common.mnemonics import CommandDecoder
from openppmc.plot.motion import draw
from openppmc.plot.signals import Run
from scripts.demo.scenes import Changes, access_text, falls


def signals(**groups: str) -> list[tuple[str, list[str]]]:
    """Return (title, signals) of saved views from texts; a name without a scope is a pin.

    An underscore in the name of a group is a space in its title.
    """
    return [
        (title.replace("_", " "), [name if "." in name else f"pins.{name}" for name in text.split()])
        for title, text in groups.items()
    ]


@dataclass(frozen=True)
class View:
    """Content of the VCD.

    Attributes:
        split: names of the bits, lowest first, of each vector that is shown as single bits.
        motors: pin or vector from which `pulses` derives the pulses of a motor, by the motor's scope.
        groups: (title, signals) of the saved views.
        access: function that returns the text of a host access.
    """

    split: Mapping[str, Sequence[str]]
    motors: Mapping[str, str]
    groups: Sequence[tuple[str, Sequence[str]]]
    pulses: Callable[[Changes], list[int]] = falls
    access: Callable[[Any], str] = access_text


@dataclass(frozen=True)
class Demo:
    """A demo: `name` is the value of PART, `part` is the part whose RTL runs.

    `picture` returns the content of the standard picture; `own` draws a special picture instead.

    Attributes:
        config: configuration with which the part is built.
        marks: chapters that are marked in the saved views.
        motors: names of axes in the list of moves.
    """

    name: str
    part: str
    module: str
    test: str
    words: CommandDecoder
    view: View
    marks: Sequence[str]
    picture: Callable[[Any, Sequence[Mapping[str, Any]]], Run] | None = None
    motors: Mapping[str, str] = field(default_factory=dict)
    own: Callable[[Any, Sequence[Mapping[str, Any]], Path], None] | None = None
    config: Config = F16

    def draw(self, comparison: Any, chapters: Sequence[Mapping[str, Any]], path: Path) -> None:
        """Draw the picture of a recorded run to a file."""
        if self.own is not None:
            self.own(comparison, chapters, path)
        elif self.picture is not None:
            draw(self.picture(comparison, chapters), path)
