"""Speed of virtual lines (`sim:`), in which all stations are RTL, by the number of moving stations.

Part of `make bench PART=ppmc312-serial`; alone: `python -m scripts.measure.bench.lines`.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cocotb_tests.harness import project
from openppmc.host import CW, FORWARD, Pmc006Bus, Ppmc312Bus, PpmcError
from openppmc.sim import SimError, SimLine, start_line
from scripts.fpga.flow.machine import machine
from scripts.measure.bench import section

SECONDS = 3.0
CLK_HZ = 8_000_000
FAR = "cw=2000000000,slow_cw=2000000000"
HEADS = [
    "line",
    "moving",
    "line time / wall time",
    "million cycles / s of processor time",
    "polls / s at standstill",
]


@dataclass(frozen=True)
class Case:
    """A virtual line that is measured.

    Attributes:
        stations: number of stations, which all move.
        text: all other settings, in the form of a `sim:` port.
    """

    what: str
    stations: int
    text: str
    opened: Callable[[str], Any]
    begin: Callable[[Any, int], None]
    poll: Callable[[Any, int], object]


def _begin_312(bus: Any, station: int) -> None:
    axis = bus.axis(station)
    axis.initialise(4000, 8000, 600)
    axis.jog(CW)


def _begin_006(bus: Any, address: int) -> None:
    axis = bus.axis(address + 1)
    axis.max_speed = axis.start_speed = axis.stop_speed = 2000
    axis.jog(FORWARD)


def cases() -> list[Case]:
    """Return the lines of both parts that are measured, from one station to a full line."""
    found = []
    for count in (1, 4, 16):
        found.append(
            Case(
                "PPMC-312, 83 333 bit/s",
                count,
                f"part=ppmc312-serial,baud=83333,stations={count},{FAR}",
                lambda port: Ppmc312Bus.open(port, 83_333, patience=30),
                _begin_312,
                lambda bus, station: bus.axis(station).poll(),
            )
        )
    for count in (1, 3):
        found.append(
            Case(
                "PMC006B4, 115 200 bit/s",
                count,
                f"part=pmc006,baud=115200,address=1..{count},high=100000000",
                lambda port: Pmc006Bus.open(port, baud=115_200, patience=30),
                _begin_006,
                lambda bus, address: bus.axis(address + 1).flags(),
            )
        )
    return found


def _now(line: SimLine) -> tuple[float, float, float]:
    """Return the time on the line, the wall time and the processor time, in s."""
    words = Path(f"/proc/{line.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return line.status().seconds, time.perf_counter(), (int(words[11]) + int(words[12])) / 100


def measure(case: Case) -> list[str]:
    """Measure a line and return its row of the table."""
    with start_line(case.text + ",speed=max") as line, case.opened(line.port) as bus:
        case.poll(bus, 0)
        polls, begin = 0, time.perf_counter()
        while time.perf_counter() - begin < SECONDS:
            case.poll(bus, polls % case.stations)
            polls += 1
        rate = polls / (time.perf_counter() - begin)
        for station in range(case.stations):
            case.begin(bus, station)
        before = _now(line)
        time.sleep(SECONDS)
        after = _now(line)
    passed, wall, used = (b - a for a, b in zip(before, after, strict=True))
    clk = passed * CLK_HZ * case.stations / max(used, 0.01)
    return [case.what, str(case.stations), f"{passed / wall:.3f}", f"{clk / 1e6:.2f}", f"{rate:.0f}"]


def main() -> int:
    """Measure, print and write docs/benchmarks.md."""
    rows = []
    for case in cases():
        try:
            rows.append(measure(case))
        except (SimError, PpmcError) as error:
            return project.fail(str(error))
        section.show(HEADS, rows[-1])
    text = (
        "Virtual lines (`sim:`, `make board`), the RTL of each station at 8 MHz, at full speed. A station at "
        "standstill needs no time until it is addressed; moving stations share the processors, which may "
        "have other work. "
        f"{machine()}."
    )
    section.write("lines", text, HEADS, rows)
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main, ""))
