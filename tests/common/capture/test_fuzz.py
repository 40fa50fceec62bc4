"""Damaged capture files: they end in one line or a result, never in a traceback or an endless loop."""

from __future__ import annotations

import random
import re
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from openppmc.capture.common import csv_file
from openppmc.capture.common.decoding import decode
from openppmc.capture.common.files import read_capture
from openppmc.capture.common.pinmap import PinMap
from openppmc.errors import PpmcError
from openppmc.textfile import chunks

from .analyser import probe, write_sr, write_vcd
from .test_compare import CORE, session
from .variants import saleae, sigrok_cli, with_bus

CASES = 300
LONGEST_S = 10.0
FILES: dict[str, Callable[[Path], Path]] = {
    "vcd": lambda path: write_vcd(probe(session("ppmc104"), rate=24e6, until=0.004), path / "a.vcd"),
    "bus": lambda path: with_bus(probe(session("ppmc104"), rate=24e6, until=0.004), path / "b.vcd", "[7:0]"),
    "saleae": lambda path: saleae(probe(session("ppmc104"), rate=24e6, until=0.004), path / "a.csv"),
    "sigrok": lambda path: sigrok_cli(
        probe(session("ppmc104"), rate=24e6, until=0.0001), path / "b.csv", dedup=True
    ),
    "sr": lambda path: write_sr(probe(session("ppmc104"), rate=24e6, until=0.001), path / "a.sr"),
}
PIECES = (
    b"$end",
    b"$comment",
    b"$var wire 9 a b $end",
    b"#",
    b"#99999999999999999999",
    b"b1010 ",
    b"x",
    b"\0",
    b"\xff",
    b"\n",
    b";",
    b",",
    b"-",
    b"1e308",
    b'"',
)


def damaged(data: bytes, source: random.Random) -> bytes:
    """Return the data with random damage.

    Bytes are changed, removed, inserted or duplicated, the end is cut off, fields or rows are exchanged, or
    the encoding is changed.
    """
    for _ in range(source.choice((1, 1, 2, 5))):
        at = source.randrange(len(data)) if source.random() < 0.6 else source.randrange(min(len(data), 1500))
        size = source.choice((1, 1, 2, 8, 100))
        kind = source.randrange(9)
        if kind == 0:
            data = data[:at] + bytes([source.randrange(256)]) + data[at + 1 :]
        elif kind == 1:
            data = data[:at] + data[at + size :]
        elif kind == 2:
            data = data[:at] + source.choice(PIECES) + data[at:]
        elif kind == 3:
            data = data[: at + size] + data[at:]
        elif kind == 4:
            data = data[: max(1, at)]
        elif kind == 5:
            rows = data.split(b"\n")
            one, other = source.randrange(len(rows)), source.randrange(len(rows))
            rows[one], rows[other] = rows[other], rows[one]
            data = b"\n".join(rows)
        elif kind == 6:
            rows = data.split(b"\n")
            one = source.randrange(len(rows))
            fields = re.split(rb"([,; ])", rows[one])
            source.shuffle(fields)
            rows[one] = b"".join(fields)
            data = b"\n".join(rows)
        elif kind == 7 and source.random() < 0.2:
            name = source.choice(
                ("utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-8-sig", "cp037", "utf-7")
            )
            data = data.decode("latin-1").encode(name)
        else:
            data = data[:at] + bytes([source.choice(b"0123456789xzbr#$,; \n")]) + data[at + 1 :]
    return data


@pytest.mark.parametrize("name", FILES)
def test_damaged_files(name: str, tmp_path: Path) -> None:
    """A randomly damaged file is read, or rejected in one line; the seed of each case is fixed."""
    path = FILES[name](tmp_path)
    data = path.read_bytes()
    source = random.Random(f"captures {name}")
    refused = 0
    for case in range(CASES):
        path.write_bytes(damaged(data, source))
        begin = time.process_time()
        try:
            decode(read_capture(path), PinMap(timing="FAST", parameters=CORE), "ppmc104")
        except PpmcError as error:
            refused += 1
            assert "\n" not in str(error) and len(str(error)) < 1000, (case, str(error))
        except Exception as error:
            raise AssertionError(f"{name}, case {case}: {error!r}") from error
        assert time.process_time() - begin < LONGEST_S, case
    assert refused > CASES // 10


def _levels(path: Path) -> dict[str, tuple[int, list[tuple[int, int]], int]] | None:
    """Return the decoded content of a file; None if it is rejected."""
    try:
        found = read_capture(path)
    except PpmcError:
        return None
    return {name: (one.initial, one.changes, one.unknown_first) for name, one in found.channels.items()}


@pytest.mark.parametrize("name", ["saleae", "sigrok"])
def test_blocks_of_a_table(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A damaged table gives the same levels, or is rejected, with every size of the blocks in which it is
    read.
    """
    data = FILES[name](tmp_path).read_bytes()[:20_000]
    path = tmp_path / "damaged.csv"
    source = random.Random(f"blocks {name}")
    read = 0
    for case in range(CASES // 2):
        path.write_bytes(damaged(data, source))
        whole = _levels(path)
        with monkeypatch.context() as patch:
            patch.setattr(csv_file, "chunks", lambda path: chunks(path, 400))
            assert _levels(path) == whole, case
        read += whole is not None
    assert 3 < read < CASES // 2


def rewritten(rows: list[str], source: random.Random) -> str:
    """Return the same table in another form: with quoted or padded cells, decimals or letters, or additional
    lines.
    """
    found = []
    for row in rows:
        time, *levels = row.split(",")
        kind = source.randrange(12)
        if kind == 0:
            row = ",".join(f'"{cell}"' for cell in (time, *levels))
        elif kind == 1:
            row = ", ".join((time, *levels)) + "  "
        elif kind == 2:
            row = ",".join((time, *("LH"[int(level)] for level in levels)))
        elif kind == 3:
            row = ",".join((time, *(f"{level}.0" for level in levels)))
        elif kind == 4:
            row = ",".join((f"{float(time):.15E}", *levels))
        elif kind == 5:
            found.append(source.choice(("", "# a comment", "; 1,0", "  ")))
        found.append(row)
    return "\n".join(found) + source.choice(("\n", ""))


def test_rewritten_tables(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A table in another form gives the same levels as the plain table, wherever a block ends."""
    path = FILES["saleae"](tmp_path)
    head, *rows = path.read_text().splitlines()[:800]
    path.write_text("\n".join([head, *rows]) + "\n")
    plain = _levels(path)
    assert plain and sum(len(changes) for _, changes, _ in plain.values()) > 200
    source = random.Random("rewritten tables")
    for case in range(30):
        path.write_text(f"{head}\n{rewritten(rows, source)}")
        monkeypatch.setattr(csv_file, "chunks", lambda path, size=10 ** (2 + case % 4): chunks(path, size))
        assert _levels(path) == plain, case
