"""Harness settings for sixteen PPMC-312 stations on one line: ports, build, pins of each station."""

from __future__ import annotations

from cocotb_tests.harness import Config, Part
from cocotb_tests.harness.build import Design

from ..bench import PPMC312
from .library import FOLDER, station_library

STATIONS = 16
ALL = (1 << STATIONS) - 1
FASTEST = 0b111
"""Levels of the pins mod for 83 333 bps."""
BIT = 96
"""Number of cycles per bit at 83 333 bps, with a clock of 8 MHz."""
F8L = Config("f8m", clk_hz=8_000_000)

IN_TURN = sum(number << 4 * number for number in range(STATIONS))
"""Levels of adr of stations 0 to 15."""

# Single-bit inputs of each station with their idle levels; address and speed have more bits.
SINGLE = {"evt0_n": 1, "evt1_n": 1, "fl_n": 1, "bl_n": 1, "org_n": 1, "alm_n": 1, "end_n": 1, "run": 1}
SEVERAL = {"adr": 4, "mod": 3}
OUTPUTS = PPMC312.outputs


def repeat(level: int, width: int) -> int:
    """Return a vector with the same level for every station."""
    return sum(level << width * number for number in range(STATIONS))


LINE = Part(
    name="ppmc312_line",
    inputs={
        "master": 1,
        "hear_others": 1,
        "hear_self": 0,
        "noise": 0,
        "adr": IN_TURN,
        "mod": repeat(FASTEST, 3),
        **{pin: repeat(level, 1) for pin, level in SINGLE.items()},
    },
    outputs={
        "line": (1, 1),
        **{name: (width * STATIONS, repeat(level, width)) for name, (width, level) in OUTPUTS.items()},
    },
    widths={"noise": STATIONS, **{pin: width * STATIONS for pin, width in SEVERAL.items()}}
    | dict.fromkeys(SINGLE, STATIONS),
    parameters=("CLK_HZ", "XTAL_HZ", "TIMING", "SUM_MODE"),
)


def design(config: Config, args: tuple[str, ...] | None = None, **params: int | str) -> Design:
    """Return the line with its stations; build their library if it does not exist.

    `args` are Verilator arguments for the stations; `params` replaces or adds parameters of the part.
    """
    chosen = {**LINE.params(config), **params}
    library = station_library(chosen) if args is None else station_library(chosen, args)
    ports = ("clk", "rst_n", *LINE.inputs, *LINE.outputs)
    return Design(LINE.name, [FOLDER / "ppmc312_line.sv"], ports=ports, libraries=[library])
