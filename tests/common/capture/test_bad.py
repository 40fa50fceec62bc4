"""The command line of `decode`, and invalid captures and maps, which are rejected in one line with advice."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from openppmc.capture.common.errors import CaptureError
from openppmc.capture.common.files import read_capture
from openppmc.capture.common.pinmap import read_map

from ..cli.command_line import Run
from .analyser import probe, write_saleae, write_sigrok_csv, write_sr, write_vcd
from .sessions import CLK_HZ, SESSIONS
from .test_compare import session

PORT = ""
"""Port for the command line, which opens no board here."""
MAP = """\
part: ppmc104
timing: FAST
parameters: {CLK_HZ: 20000000}
pins:
  d: [D0, D1, D2, D3, D4, D5, D6, D7]
  a0: A0
  cs_n: 9
  rd_n: RD
  wr_n: WR
  pout_n: "!PULSE"
  dir: DIR
  l2_n: L2
"""
NAMES = {f"d[{n}]": f"D{n}" for n in range(8)} | {
    **{"a0": "A0", "cs_n": "CS", "rd_n": "RD"},
    **{"wr_n": "WR", "dir": "DIR", "l2_n": "L2"},
}


@pytest.fixture
def wired(tmp_path: Path) -> Path:
    """Write a capture whose channels have other names, and its map."""
    seen = probe(session("ppmc104"), rate=1e12)
    wires = {NAMES[name]: seen.wires[name] for name in NAMES}
    level, changes = seen.wires["pout_n"]
    wires["PULSE"] = (1 - level, [(t, 1 - one) for t, one in changes])
    seen.wires = wires
    (tmp_path / "map.yml").write_text(MAP)
    return write_vcd(seen, tmp_path / "old.vcd")


def test_the_command(wired: Path, run: Run, tmp_path: Path) -> None:
    """With a map, bytes, moves and the comparison are printed; the JSON output contains the same data."""
    words = ("decode", str(wired), "--map", str(tmp_path / "map.yml"), "--compare")
    out = run(*words, "--plot", str(tmp_path / "speed.png")).out
    assert "accelerate/decelerate, CW, 200 pulses" in out and "0 differences" in out
    assert (tmp_path / "speed.png").stat().st_size > 5000
    values = json.loads(run(*words, "--json").out)
    assert values["compare"]["differences"] == [] and values["compare"]["edges"] > 400
    assert [move["pulses"] for move in values["moves"]] == [200, 30]


def test_a_difference_is_an_error(wired: Path, run: Run, tmp_path: Path) -> None:
    """If the map states a wrong crystal frequency, edges differ: the exit status is 1, and the first of these
    edges is printed.
    """
    (tmp_path / "map.yml").write_text(MAP + "crystal: 8000000\n")
    outcome = run("decode", str(wired), "--map", str(tmp_path / "map.yml"), "--compare")
    assert "inputs not captured: " in outcome.err
    assert outcome.code == 1 and "edges differ, the first at 0.00" in outcome.err.splitlines()[-1]


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("a0: A0", "a0: A9", "map.yml: no channel 'A9' in old.vcd (there are D0, D1"),
        ("cs_n: 9", "cs_n: 99", "map.yml: channel 99: old.vcd has channels 0 to"),
        ("a0: A0", "ax: A0", "map.yml: ax is no pin of it (there are"),
        ("dir: DIR", "dir: WR", "map.yml: dir: channel WR is wr_n already"),
        (", D7]", "]", "map.yml: d: 7 channels, it has 8 bits"),
        ("  wr_n: WR\n", "", "old.vcd: wr_n is not in the map: nothing can be read without it"),
        ("D0, D1, D2", "D0, ~, D2", "old.vcd: d[1] is not in the map"),
        ("part: ppmc104", "part: ppmc105", "part ppmc105: there is no such part"),
        ("part: ppmc104\n", "", "which part is this? name it with --part"),
        ("timing: FAST", "timing: SLOW", "map.yml: timing: SLOW: neither FAST nor DATASHEET"),
        ("rd_n: RD\n  wr_n: WR", "rd_n: WR\n  wr_n: RD", "are invalid for a PPMC-104: is the capture"),
        ("pins:", "pens:", "map.yml: no pin map: it needs `pins:`"),
        ("pins:", "pins: [", "map.yml: no pin map"),
        (
            "D0, D1, D2, D3, D4, D5, D6, D7",
            "D7, D6, D5, D4, D3, D2, D1, D0",
            "are invalid for a PPMC-104: is the capture",
        ),
    ],
)
def test_wrong_maps(old: str, new: str, says: str, wired: Path, run: Run, tmp_path: Path) -> None:
    assert old in MAP
    text = MAP.replace(old, new)
    (tmp_path / "map.yml").write_text(text)
    outcome = run("decode", str(wired), "--map", str(tmp_path / "map.yml"))
    assert outcome.code == 1
    assert says in outcome.err.splitlines()[-1] and outcome.err.splitlines()[-1].startswith("error: ")


def test_of_another_part(wired: Path, run: Run, tmp_path: Path) -> None:
    """If a capture of a PPMC-312 is decoded as one of a PPMC-104, the error suggests that the named device is
    wrong.
    """
    seen = probe(SESSIONS["ppmc312"](), rate=1e12)
    names = {"we_n": "wr_n", "oe_n": "rd_n", "rs[0]": "a0"}
    seen.wires = {names.get(name, name): wire for name, wire in seen.wires.items()}
    file = write_vcd(seen, tmp_path / "other.vcd")
    outcome = run("decode", str(file), "--part", "ppmc104")
    assert outcome.code == 1
    assert "commands are invalid for a PPMC-104: is the capture of another part" in outcome.err


def test_a_clock_too_slow(run: Run, tmp_path: Path) -> None:
    file = write_sr(probe(session("ppmc104"), rate=1e6), tmp_path / "slow.sr")
    outcome = run("decode", str(file), "--part", "ppmc104")
    assert outcome.code == 1 and "sampled every 1 µs" in outcome.err and "with 8 MS/s or more" in outcome.err
    slow = write_sr(probe(session("pmc006"), rate=5e4), tmp_path / "line.sr")
    outcome = run("decode", str(slow), "--part", "pmc006")
    assert outcome.code == 1 and "capture again with" in outcome.err


def test_cut_files(tmp_path: Path) -> None:
    """A file that ends in the middle is rejected with advice, and so is a VCD with only its first 300
    bytes.
    """
    seen = probe(session("ppmc104"), rate=4e6, until=0.01)
    for write, name in ((write_saleae, "a.csv"), (write_sigrok_csv, "b.csv"), (write_sr, "c.sr")):
        path = write(seen, tmp_path / name)
        data = path.read_bytes()
        path.write_bytes(data[: len(data) // 2 // 64 * 64 + 1])
        with pytest.raises(CaptureError, match="export it again|save it again"):
            read_capture(path)
    path = write_vcd(seen, tmp_path / "d.vcd")
    path.write_bytes(path.read_bytes()[:300])
    with pytest.raises(CaptureError, match="export it again"):
        read_capture(path)


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("none.vcd", None, "there is no such file"),
        ("a.txt", "x", "captures end in .vcd, .csv, .sr"),
        ("a.csv", "", "there is nothing in it"),
        ("a.csv", "Name,Value\nx,1\n", "neither a column of times nor a sample rate"),
        ("a.csv", "Time [s],A,A\n0,1,1\n", "two channels have the name"),
        ("a.csv", "Time [s],A\n0,1\n1,1\n", "no level ever changes"),
        ("a.csv", "Time [s],A\n0,1\n1,0.53\n", "digital channels only"),
        ("a.sr", "nothing", "no sigrok file"),
        ("a.vcd", "nothing", "a.vcd"),
    ],
)
def test_no_captures(name: str, text: str | None, says: str, tmp_path: Path) -> None:
    if text is not None:
        (tmp_path / name).write_text(text)
    with pytest.raises(CaptureError) as error:
        read_capture(tmp_path / name)
    assert says in str(error.value) and "\n" not in str(error.value)


def test_maps_in_toml(tmp_path: Path) -> None:
    """A map in TOML has the same content as in YAML; Python 3.10 rejects TOML and advises to write YAML."""
    path = tmp_path / "map.toml"
    path.write_text('part = "stmc"\n[pins]\na0 = "A0"\n')
    try:
        assert read_map(path).pins == {"a0": "A0"}
    except CaptureError as error:
        assert "write it as YAML" in str(error)
    assert CLK_HZ == 20_000_000
