"""A logic analyser that samples a session at its own rate, with jitter, and writes files."""

from __future__ import annotations

import csv
import random
import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from vcd import VCDWriter

from openppmc.capture.common.decoding import part_decoder

from .sessions import CLK_HZ, PinLog

PS = 10**12


@dataclass
class Seen:
    """Recorded wires, one bit each, by name: initial level and changes (ps, level).

    Attributes:
        step: sample period in ps.
    """

    wires: dict[str, tuple[int, list[tuple[int, int]]]] = field(default_factory=dict)
    end: int = 0
    step: int = 1


def probe(
    log: PinLog,
    rate: float = 50e6,
    jitter: int = 0,
    begin: float = 0.0,
    until: float = 1.0,
    without: Iterable[str] = (),
    ppm: float = 0.0,
    seed: int = 1,
) -> Seen:
    """Sample the pins of a session.

    Args:
        rate: sample rate in Hz.
        jitter: maximum error of each edge in ps.
        begin, until: start and end of the capture in s.
        without: ports that are not connected.
        ppm: deviation of the analyser's clock in ppm; a positive value makes it too slow.
    """
    step = round(PS / rate)
    stretch = 1 - ppm * 1e-6
    source = random.Random(seed)
    widths, lowest = dict(log.model.WIDTHS), part_decoder(log.part).pins.lowest
    ports: dict[str, tuple[int, list[tuple[int, int]]]] = {}
    for name, level in {**log.inputs, **log.outputs}.items():
        ports[name] = (level, [])
    for t, name, level in log.changes:
        ports[name][1].append((t, level))
    for edge in log.model.edges:
        ports[edge.signal][1].append((edge.t, edge.value))
    if "d_i" in ports:
        ports["d"], widths["d"] = _bus(ports), 8
        del ports["d_i"], ports["d_o"], ports["d_oe"]
    seen = Seen(step=step)
    start, over = round(begin * PS), round(until * PS)
    for name, (initial, changes) in ports.items():
        if name in without:
            continue
        for bit in range(widths.get(name, 1)):
            wire = f"{name}[{bit + lowest.get(name, 0)}]" if widths.get(name, 1) > 1 else name
            level, kept = initial >> bit & 1, list[tuple[int, int]]()
            for t, value in changes:
                at = round(t * PS / CLK_HZ * stretch) - start
                at += source.randint(-jitter, jitter) if jitter else 0
                at = -(-at // step) * step
                if at > over:
                    break
                if at <= 0:
                    level = value >> bit & 1
                elif value >> bit & 1 != (kept[-1][1] if kept else level):
                    kept.append((max(at, kept[-1][0] + step) if kept else at, value >> bit & 1))
            seen.wires[wire] = (level, kept)
    seen.end = min(over, round(log.end * PS / CLK_HZ * stretch - start)) // step * step
    return seen


def _bus(ports: Mapping[str, tuple[int, list[tuple[int, int]]]]) -> tuple[int, list[tuple[int, int]]]:
    """Return the level and changes of the data bus.

    The chip drives the bus while d_oe is 1; otherwise the host drives it.
    """
    rows = sorted(
        (t, order, name, level)
        for order, name in enumerate(("d_i", "d_o", "d_oe"))
        for t, level in ports[name][1]
    )
    levels = {name: ports[name][0] for name in ("d_i", "d_o", "d_oe")}
    changes = []
    for t, _, name, level in rows:
        levels[name] = level
        changes.append((t, levels["d_o"] if levels["d_oe"] else levels["d_i"]))
    return ports["d_i"][0], changes


def _rows(seen: Seen) -> list[tuple[int, str, int]]:
    rows = [(t, name, level) for name, (_, changes) in seen.wires.items() for t, level in changes]
    return sorted(rows)


def write_vcd(seen: Seen, path: Path, comment: str = "") -> Path:
    """Write a VCD as PulseView exports it; the part of a name before a dot becomes a scope."""
    with path.open("w") as file, VCDWriter(file, timescale="1 ps", date="", comment=comment) as writer:
        known = {}
        for full, (level, _) in seen.wires.items():
            scope, _, name = full.rpartition(".")
            known[full] = writer.register_var(scope or "logic", name, "wire", size=1, init=level)
        for t, name, level in _rows(seen):
            writer.change(known[name], t, level)
        writer.close(seen.end)
    return path


def write_saleae(seen: Seen, path: Path) -> Path:
    """Write a CSV file with one row per change, as Saleae Logic 2 exports it."""
    levels = {name: level for name, (level, _) in seen.wires.items()}
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["Time [s]", *levels])
        table.writerow(["0.000000000", *levels.values()])
        last = 0
        for t, name, level in _rows(seen):
            if t != last and last:
                table.writerow([f"{last / PS:.12f}", *levels.values()])
            levels[name], last = level, t
        table.writerow([f"{last / PS:.12f}", *levels.values()])
        if seen.end > last:
            table.writerow([f"{seen.end / PS:.12f}", *levels.values()])
    return path


def samples(seen: Seen) -> Iterable[dict[str, int]]:
    levels = {name: level for name, (level, _) in seen.wires.items()}
    rows, place = _rows(seen), 0
    for at in range(seen.end // seen.step + 1):
        while place < len(rows) and rows[place][0] <= at * seen.step:
            levels[rows[place][1]] = rows[place][2]
            place += 1
        yield levels


def write_sigrok_csv(seen: Seen, path: Path) -> Path:
    """Write a CSV file with one row per sample, as sigrok-cli does."""
    with path.open("w") as file:
        file.write("; CSV generated by libsigrok\n")
        file.write(f"; Channels ({len(seen.wires)}/{len(seen.wires)}): {', '.join(seen.wires)}\n")
        file.write(f"; Samplerate: {1e6 / seen.step:g} MHz\n" + ",".join(seen.wires) + "\n")
        for levels in samples(seen):
            file.write(",".join(map(str, levels.values())) + "\n")
    return path


def write_sr(seen: Seen, path: Path) -> Path:
    """Write a session file of PulseView that stores the samples in two pieces."""
    size = -(-len(seen.wires) // 8)
    data = b"".join(
        sum(level << place for place, level in enumerate(levels.values())).to_bytes(size, "little")
        for levels in samples(seen)
    )
    half = len(data) // size // 2 * size
    head = ["[global]", "sigrok version=0.5.2", "", "[device 1]", "capturefile=logic-1"]
    head += [f"total probes={len(seen.wires)}", f"samplerate={1e6 / seen.step:g} MHz"]
    head += [f"probe{place + 1}={name}" for place, name in enumerate(seen.wires)] + [f"unitsize={size}"]
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("version", "2")
        archive.writestr("metadata", "\n".join(head))
        archive.writestr("logic-1-1", data[:half])
        archive.writestr("logic-1-2", data[half:])
    return path
