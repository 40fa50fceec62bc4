"""Short moves per second of a host: one by one with `move`, and several per frame with `moves`.

Part of `make bench`; alone: `python -m scripts.measure.bench.moves`.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any

from cocotb_tests.harness import project
from openppmc.host import Pmc006, Ppmc312Bus, PpmcError, open_part
from openppmc.sim import SimError
from scripts.fpga.flow.machine import machine
from scripts.measure.bench import section

TURNS = 5
MOVES = 240
PULSES = (1, -2, 3, -1, 2, -3)
BAUD = 2_000_000
CLK_HZ = 10_000_000
BANK_CLK_HZ = 12_000_000
COMPUTED = (1_000_000, 3_000_000)
ADAPTER_MS = 1.0
"""Time in ms that a USB adapter is assumed to add to a frame and its answer."""
SETUPS: dict[str, tuple[int, int, int]] = {
    "ppmc104": (100_000, 200_000, 4),
    "ppmc2104": (100_000, 200_000, 4),
    "stmc": (9_000, 9_700, 4),
    "bank": (100_000, 200_000, 4),
    "ppmc312": (40_000, 400_000, 1_400),
}
"""For each part: start speed and high speed in pulses/s, ramp length."""
HEADS = [
    "part",
    "way",
    "moves / s, virtual board",
    "time, one by one = 1",
    "frames a move",
    "bytes a move",
    "moves / s, 1 Mbaud",
    "moves / s, 3 Mbaud",
]


@dataclass
class Traffic:
    """Traffic of a port: frames and bytes in both directions."""

    frames: int = 0
    size: int = 0

    def count(self, port: Any) -> None:
        """Count all further traffic of a port."""
        read, write = port.read, port.write

        def reading(timeout: float) -> bytes:
            data: bytes = read(timeout)
            self.size += len(data)
            return data

        def writing(data: bytes) -> None:
            self.frames += 1
            self.size += len(data)
            write(data)

        port.read, port.write = reading, writing


def computed(traffic: Traffic) -> list[str]:
    """Return frames and bytes of a move, and the moves per second that are possible at two line rates."""
    frames, size = traffic.frames / MOVES, traffic.size / MOVES
    rates = [1 / (10 * size / baud + ADAPTER_MS / 1000 * frames) for baud in COMPUTED]
    return [f"{frames:.2f}", f"{size:.0f}", *(f"{rate:,.0f}" for rate in rates)]


def measure(part: str) -> list[list[str]]:
    """Return the rows of a part: moves one by one, and several moves per frame."""
    pulses = [PULSES[n % len(PULSES)] for n in range(MOVES)]
    seconds: dict[str, list[float]] = {"move": [], "moves": []}
    traffic = {}
    clk_hz = BANK_CLK_HZ if part == "bank" else CLK_HZ
    with open_part(f"sim:speed=max,part={part},clk={clk_hz}", BAUD) as opened:
        axis: Any = opened.axes[0]
        axis.initialise(*SETUPS[part])
        ways: dict[str, Callable[[], Sequence[Any]]] = {
            "move": lambda: [axis.move(one) for one in pulses],
            "moves": lambda: list(axis.moves(pulses)),
        }
        port: Any = opened.link.port
        plain = port.read, port.write
        for _ in range(TURNS):
            for way, work in ways.items():
                traffic[way] = Traffic()
                traffic[way].count(port)
                begin = time.perf_counter()
                ends = work()
                seconds[way].append(time.perf_counter() - begin)
                port.read, port.write = plain
                assert [end.pulses for end in ends] == pulses
    ratio = median(new / old for old, new in zip(seconds["move"], seconds["moves"], strict=True))
    return [
        [part, f"`{way}`", f"{MOVES / min(seconds[way]):,.0f}", f"{relative:.2f}", *computed(traffic[way])]
        for way, relative in (("move", 1.0), ("moves", ratio))
    ]


def line_times() -> tuple[float, float]:
    """Return the time of a move of 2 pulses in ms on the fastest serial lines of PPMC-312 and PMC006B4."""
    with Ppmc312Bus.open("model:speed=max,stations=1", 83_333) as bus:
        bus.axis(0).initialise(*SETUPS["ppmc312"])
        of_312 = _milliseconds(bus.axis(0))
    with Pmc006.open("model:speed=max,baud=115200", 255, baud=115_200) as motor:
        motor.start_speed = motor.stop_speed = motor.max_speed = 3000
        return of_312, _milliseconds(motor)


def _milliseconds(axis: Any) -> float:
    begin = axis.link.clock()
    for _ in range(10):
        axis.move(2)
    return 1000 / 10 * float(axis.link.clock() - begin)


def bench() -> None:
    """Measure all parts, print the rows and write docs/benchmarks.md."""
    rows = []
    for part in SETUPS:
        rows += measure(part)
        for row in rows[-2:]:
            section.show(HEADS, row)
    of_312, of_006 = line_times()
    text = (
        f"Moves of 1 to 3 pulses. Virtual board at {CLK_HZ / 1e6:g} MHz (bank: {BANK_CLK_HZ / 1e6:g} MHz) "
        f"and {BAUD:,} baud with `speed=max`: the fastest of {TURNS} turns, and the median of the ratios in "
        "one turn. The last two columns are computed from the frames and bytes of a move, with "
        f"{ADAPTER_MS:g} ms of a USB adapter for each frame and its answer; they were not measured on a "
        "board. On a serial line, one frame starts one move: it needs "
        f"{of_312:.0f} ms with a PPMC-312 at 83 333 bit/s and {of_006:.0f} ms with a PMC006B4 at "
        f"115 200 bit/s (golden models). {machine()}."
    )
    section.write("moves", text, HEADS, rows)


def main() -> int:
    """Run the command line."""
    try:
        bench()
    except (SimError, PpmcError) as error:
        return project.fail(str(error))
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main, ""))
