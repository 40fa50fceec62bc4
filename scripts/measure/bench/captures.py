"""`make bench`, or `python -m scripts.measure.bench.captures`: speed, memory of decoding a large capture."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
import time
from operator import itemgetter
from pathlib import Path
from typing import Any, NamedTuple

from cocotb_tests.harness import project
from openppmc.model.ppmc104 import Ppmc104
from scripts.fpga.flow.machine import machine
from scripts.measure.bench import section

EDGES = 4_000_000
PART = "ppmc104"
HEADS = [
    "capture",
    "edges",
    "million edges / s of processor time",
    "time, plain pass = 1",
    "bytes per edge at the peak",
]
CLK_HZ = 20_000_000
"""Clock rate of the chip in the capture that is compared with the golden model."""
NS = 10**9 // CLK_HZ
COMPARED = "compared.vcd"
FILES = {
    "moves.vcd": "VCD, bus and pulses",
    "bus.vcd": "VCD, bus only",
    "moves.csv": "CSV of Saleae Logic, bus and pulses",
    COMPARED: "VCD, `--compare`",
}
_DECLARED = "$var wire 1 {} {} $end"


class _Writer:
    """Writer of changes in the format VCD, or CSV of Saleae Logic with a row for each time.

    Attributes:
        edges: number of edges written so far.
    """

    def __init__(self, path: Path, names: list[str]) -> None:
        self.file, self.csv, self.edges = path.open("w"), path.suffix == ".csv", 0
        self._codes = {name: chr(33 + place) for place, name in enumerate(names)}
        self._levels = {name: str(int(name.endswith("_n"))) for name in names}
        self._lines: list[str] = []
        if self.csv:
            self.file.write(f"Time [s],{','.join(names)}\n")
            self.put(0)
        else:
            self.file.write("$timescale 1 ns $end\n$scope module logic $end\n")
            self.file.writelines(_DECLARED.format(self._codes[name], name) + "\n" for name in names)
            self.file.write("$upscope $end\n$enddefinitions $end\n#0\n")
            self.file.writelines(f"{level}{self._codes[name]}\n" for name, level in self._levels.items())

    def put(self, t: int, **changes: int) -> None:
        """Set the levels of wires at this time, in ns."""
        if not self.csv:
            self._lines.append(f"#{t}")
        for name, level in changes.items():
            if self._levels[name] != str(level):
                self._levels[name] = str(level)
                self.edges += 1
                if not self.csv:
                    self._lines.append(f"{level}{self._codes[name]}")
        if self.csv:
            self._lines.append(f"{t / 1e9:.9f},{','.join(self._levels.values())}")
        if len(self._lines) > 10_000:
            self.flush()

    def access(self, t: int, strobe: str, register: int, byte: int) -> int:
        """Make a register access at a time; return the time at which the next access may begin."""
        self.put(t, a0=register, **{f"d[{bit}]": byte >> bit & 1 for bit in range(8)})
        self.put(t + 100, cs_n=0, **{strobe: 0})
        self.put(t + 600, cs_n=1, **{strobe: 1})
        return t + 3000

    def flush(self) -> None:
        """Write the data in the buffer to the file."""
        self.file.write("\n".join(self._lines) + "\n" * bool(self._lines))
        self._lines.clear()


def write_capture(path: Path, edges: int, pulses: int = 20_000) -> int:
    """Write a capture of a PPMC-104 and return the number of its edges.

    The capture has moves of `pulses` with a poll after every 20 pulses; if `pulses` is 0, it has commands
    with 20 polls each.
    """
    names = [*(f"d[{bit}]" for bit in range(8)), "a0", "cs_n", "rd_n", "wr_n"]
    out = _Writer(path, names + ["pout_n", "dir", "rst_n"] * bool(pulses))
    if pulses:
        out.put(1000, rst_n=0)
        out.put(9000, rst_n=1)
    t = 20_000
    for register, byte in ((1, 0x2A), (0, 99), (0, 9), (0, 60), (0, 0)):
        t = out.access(t, "wr_n", register, byte)
    while out.edges < edges:
        for register, byte in ((1, 0x43), (0, 0x1F), (0, 0x4E), (0, 0)):
            t = out.access(t, "wr_n", register, byte)
        for pulse in range(pulses):
            out.put(t, pout_n=0)
            out.put(t + 5000, pout_n=1)
            t += 10_000
            if pulse % 20 == 19:
                out.access(t - 4000, "rd_n", 1, 4)
        for _ in range(0 if pulses else 20):
            t = out.access(t, "rd_n", 1, 4)
        t += 3_000_000 if pulses else 0
    out.flush()
    out.file.close()
    return out.edges


def write_compared(path: Path, edges: int) -> int:
    """Write a VCD of the golden model with moves at a constant speed and a poll every 200 µs."""
    model = Ppmc104(CLK_HZ)
    phases = [f"s[{bit + 1}]" for bit in range(5)]
    names = [*(f"d[{bit}]" for bit in range(8)), "a0", "cs_n", "rd_n", "wr_n", "rst_n", "pout_n", "dir"]
    out = _Writer(path, [*names, "hold", *phases])
    events: list[tuple[int, dict[str, int]]] = []

    def access(t: int, strobe: str, register: int, byte: int = 0) -> int:
        if strobe == "rd_n":
            byte = model.read(t, register, strobe=11)
        else:
            model.write(t, register, byte, strobe=11)
        data = {f"d[{bit}]": byte >> bit & 1 for bit in range(8)}
        events.extend(((t, {"cs_n": 0, strobe: 0, "a0": register, **data}), (t + 11, {"cs_n": 1, strobe: 1})))
        return byte

    def flush() -> None:
        for one in model.edges:
            if one.signal == "s":
                events.append((one.t, {name: one.value >> bit & 1 for bit, name in enumerate(phases)}))
            elif one.signal in ("pout_n", "dir", "hold"):
                events.append((one.t, {one.signal: one.value}))
        for t, levels in sorted(events, key=itemgetter(0)):
            out.put(t * NS, **levels)
        events.clear()
        model.edges.clear()

    out.put(0, hold=1, **dict.fromkeys(phases, 1))
    t = 400
    for level in (0, 1):
        model.pins(t, rst_n=level)
        events.append((t, {"rst_n": level}))
        t += 400
    for register, byte in ((1, 0x2A), (0, 99), (0, 9), (0, 60), (0, 0)):
        access(t, "wr_n", register, byte)
        t += 60_000
    while out.edges < edges:
        for register, byte in ((1, 0x44), (0, 9), (0, 0x1F), (0, 0x4E), (0, 0)):
            access(t, "wr_n", register, byte)
            t += 200
        while access(t, "rd_n", 1) & 4:
            t += 4000
            flush()
        t += 60_000
    out.flush()
    out.file.close()
    return out.edges


def decode_alone(path: Path) -> None:
    """Decode a file in this process and print the result as JSON.

    The result contains the seconds of the decoding and of a plain numpy pass, and the additional memory in
    bytes. A file for the golden model is also compared with it.
    """
    from openppmc.capture.common.compare import compare
    from openppmc.capture.common.decoding import decode, part_decoder
    from openppmc.capture.common.files import read_capture
    from openppmc.capture.common.pinmap import PinMap
    from openppmc.capture.common.signals import US, numpy

    numpy()
    part_decoder(PART)
    before = _status("VmRSS")
    Path("/proc/self/clear_refs").write_text("5")
    begin = time.process_time()
    chosen = PinMap(timing="FAST", parameters={"CLK_HZ": CLK_HZ})
    found = decode(read_capture(path), chosen, PART)
    if path.name == COMPARED:
        result = compare(found, US)
        if result.differences or not result.compared:
            raise RuntimeError(f"{len(result.differences)} differences of {result.compared} edges")
    seconds, size = time.process_time() - begin, _status("VmHWM") - before
    plain = min(_plain(path) for _ in range(3))
    print(json.dumps({"seconds": seconds, "plain": plain, "bytes": size}))


def _plain(path: Path) -> float:
    """Return the seconds that numpy needs to find the bounds of all words of a file, block by block."""
    np: Any = importlib.import_module("numpy")
    begin = time.process_time()
    with path.open("rb") as file:
        while data := file.read(1 << 19):
            space = np.frombuffer(data, np.uint8) <= ord(",")
            np.flatnonzero(space[1:] != space[:-1])
    return time.process_time() - begin


def _status(name: str) -> int:
    """Return a figure of /proc/self/status in bytes."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(f"{name}:"):
            return int(line.split()[1]) * 1024
    raise RuntimeError(f"/proc/self/status has no {name}")


class Figures(NamedTuple):
    """Figures of a file.

    Attributes:
        rate: edges per second of processor time.
        plain: processor time divided by the processor time of a plain numpy pass over the file.
        size: peak memory in bytes per edge.
    """

    edges: int
    rate: float
    plain: float
    size: float


def measure(folder: Path, name: str, edges: int = EDGES, runs: int = 3) -> Figures:
    """Decode one of FILES `runs` times; return the highest speed, the lowest ratio, the largest size."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / name
    if name == COMPARED:
        count = write_compared(path, edges)
    else:
        count = write_capture(path, edges, pulses=0 if name.startswith("bus") else 20_000)
    words = [sys.executable, "-m", "scripts.measure.bench.captures", str(path)]
    rows = []
    for _ in range(runs):
        done = subprocess.run(words, check=True, capture_output=True, text=True, cwd=project.ROOT)
        rows.append(json.loads(done.stdout))
    path.unlink()
    return Figures(
        count,
        count / min(row["seconds"] for row in rows),
        min(row["seconds"] / row["plain"] for row in rows),
        max(row["bytes"] for row in rows) / count,
    )


def bench() -> None:
    """Measure, print and write docs/benchmarks.md."""
    rows = []
    for name, text in FILES.items():
        # A comparison spends most of its time in the golden model.
        found = measure(project.BUILD / "bench", name, runs=1 if name == COMPARED else 3)
        figures = (f"{found.rate / 1e6:.2f}", f"{found.plain:.1f}", f"{found.size:.1f}")
        rows.append([text, f"{found.edges:,}", *figures])
        section.show(HEADS, rows[-1])
    text = (
        f"`openppmc decode` of large captures of a {PART}, from the file to bytes, texts and moves, the best "
        "of 3 runs; with `--compare`, one run that includes the golden model. The plain pass finds the "
        f"bounds of all words of the file with numpy. {machine()}."
    )
    section.write("captures", text, HEADS, rows)


def main() -> int:
    """Run the command line."""
    if len(sys.argv) > 1:
        decode_alone(Path(sys.argv[1]))
    else:
        bench()
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main, "[CAPTURE]"))
