"""Damaged capture files: one line or a result, no traceback and no hang."""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from openppmc.capture.common.decoding import decode
from openppmc.capture.common.files import read_capture
from openppmc.capture.common.pinmap import PinMap
from openppmc.errors import PpmcError

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
    """Some bytes changed, left out, put in or twice there, or the end cut off."""
    for _ in range(source.choice((1, 1, 2, 5))):
        at = source.randrange(len(data)) if source.random() < 0.6 else source.randrange(min(len(data), 1500))
        size = source.choice((1, 1, 2, 8, 100))
        kind = source.randrange(6)
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
        else:
            data = data[:at] + bytes([source.choice(b"0123456789xzbr#$,; \n")]) + data[at + 1 :]
    return data


@pytest.mark.parametrize("name", FILES)
def test_damaged_files(name: str, tmp_path: Path) -> None:
    """A damaged file is refused in one line or read; a seeded random sample of damages."""
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
