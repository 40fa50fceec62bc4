"""How fast a large capture is decoded, and how much memory that needs.

Part of `make bench`; alone: `python -m scripts.bench.captures`.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import console
from scripts.flow.machine import machine
from scripts.flow.report import markdown_table

EDGES = 4_000_000
PART = "ppmc104"
HEADS = [
    "capture",
    "edges",
    "million edges / s of processor time",
    "bytes per edge at the peak",
]
_DECLARED = "$var wire 1 {} {} $end"


def write_capture(path: Path, edges: int) -> int:
    """Write a VCD of a PPMC-104 with moves of 20 000 pulses and a poll after every 20; return its edges."""
    names = [*(f"d[{bit}]" for bit in range(8)), "a0", "cs_n", "rd_n", "wr_n", "pout_n", "dir", "rst_n"]
    codes = {name: chr(33 + place) for place, name in enumerate(names)}
    levels = {name: int(name.endswith("_n")) for name in names}
    count = 0
    lines: list[str] = []

    def put(t: int, **changes: int) -> None:
        nonlocal count
        lines.append(f"#{t}")
        for name, level in changes.items():
            if levels[name] != level:
                levels[name] = level
                lines.append(f"{level}{codes[name]}")
                count += 1

    def access(t: int, strobe: str, register: int, byte: int) -> int:
        bus = {f"d[{bit}]": byte >> bit & 1 for bit in range(8)}
        put(t, a0=register, **bus)
        put(t + 100, cs_n=0, **{strobe: 0})
        put(t + 600, cs_n=1, **{strobe: 1})
        return t + 3000

    with path.open("w") as file:
        file.write("$timescale 1 ns $end\n$scope module logic $end\n")
        file.writelines(_DECLARED.format(codes[name], name) + "\n" for name in names)
        file.write("$upscope $end\n$enddefinitions $end\n#0\n")
        file.writelines(f"{level}{codes[name]}\n" for name, level in levels.items())
        put(1000, rst_n=0)
        put(9000, rst_n=1)
        t = 20_000
        for register, byte in ((1, 0x2A), (0, 99), (0, 9), (0, 60), (0, 0)):
            t = access(t, "wr_n", register, byte)
        while count < edges:
            for register, byte in ((1, 0x43), (0, 0x1F), (0, 0x4E), (0, 0)):
                t = access(t, "wr_n", register, byte)
            for pulse in range(20_000):
                put(t, pout_n=0)
                put(t + 5000, pout_n=1)
                t += 10_000
                if pulse % 20 == 19:
                    access(t - 4000, "rd_n", 1, 4)
            t += 3_000_000
            file.write("\n".join(lines) + "\n")
            lines.clear()
    return count


def decode_alone(path: Path) -> None:
    """Decode a file in this process; print its seconds and the bytes above what it had before, as JSON."""
    import time

    from openppmc.capture.common.decoding import decode, decoder
    from openppmc.capture.common.files import read_capture
    from openppmc.capture.common.pinmap import PinMap
    from openppmc.capture.common.signals import numpy

    numpy()
    decoder(PART)
    before = _status("VmRSS")
    Path("/proc/self/clear_refs").write_text("5")
    begin = time.process_time()
    found = decode(read_capture(path), PinMap(), PART)
    seconds = time.process_time() - begin
    print(json.dumps({"seconds": seconds, "bytes": _status("VmHWM") - before, "moves": len(found.moves)}))


def _status(name: str) -> int:
    """A figure of /proc/self/status in bytes."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(f"{name}:"):
            return int(line.split()[1]) * 1024
    raise RuntimeError(f"/proc/self/status has no {name}")


def measure(folder: Path, edges: int = EDGES, runs: int = 3) -> tuple[int, float, float]:
    """Return edges, edges/s of processor time (the best of some runs) and bytes per edge."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "capture.vcd"
    count = write_capture(path, edges)
    words = [sys.executable, "-m", "scripts.bench.captures", str(path)]
    rows = []
    for _ in range(runs):
        done = subprocess.run(words, check=True, capture_output=True, text=True, cwd=project.ROOT)
        rows.append(json.loads(done.stdout))
    path.unlink()
    return count, count / min(row["seconds"] for row in rows), max(row["bytes"] for row in rows) / count


def bench() -> None:
    """Measure, print, write docs/benchmarks.md."""
    count, rate, size = measure(project.BUILD / "bench")
    row = [f"VCD of a {PART}, 1 ns", f"{count:,}", f"{rate / 1e6:.1f}", f"{size:.1f}"]
    console.print(", ".join(f"{head}: {value}" for head, value in zip(HEADS, row, strict=True)))
    text = (
        "`openppmc decode` of a large capture, from the file to bytes, texts and moves, the best of 3 runs. "
        f"{machine()}."
    )
    project.update_benchmarks("bench:captures", f"{text}\n\n{markdown_table(HEADS, [row])}")


def main() -> int:
    """Command line."""
    if len(sys.argv) > 1:
        decode_alone(Path(sys.argv[1]))
    else:
        bench()
    return 0


if __name__ == "__main__":
    sys.exit(main())
