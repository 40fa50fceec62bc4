"""Captures from real tools: all variants of CSV, VCD and .sr give the same session, or are rejected in one
line.
"""

from __future__ import annotations

import zipfile
from datetime import datetime, timedelta
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from openppmc.capture.common.compare import compare
from openppmc.capture.common.decoding import Decoded, decode
from openppmc.capture.common.errors import CaptureError
from openppmc.capture.common.files import read_capture
from openppmc.capture.common.pinmap import PinMap, read_map
from openppmc.capture.common.signals import US

from ..cli.command_line import Run
from .analyser import Seen, probe, write_sr, write_vcd
from .sessions import CLK_HZ
from .test_compare import session
from .variants import RATE, edited, exact, saleae, sigrok_cli, with_bus

PORT = ""
"""Port for the command line, which opens no board here."""
CORE = {"CLK_HZ": CLK_HZ}


@cache
def seen() -> Seen:
    """Return a ramp of a PPMC-104 at 24 MS/s, with edges at whole multiples of the sample period."""
    return probe(session("ppmc104"), rate=RATE, until=0.016)


def lines_of(path: Path, chosen: PinMap | None = None) -> Decoded:
    """Decode a file as a PPMC-104."""
    return decode(read_capture(path), chosen or PinMap(timing="FAST", parameters=CORE), "ppmc104")


def check(path: Path, notes: int = 0, tolerance: float = 0.5) -> Decoded:
    """Check that the file contains the session: its texts, its pulses, no difference from the golden
    model.
    """
    found = lines_of(path)
    assert [line.text for line in found.lines][1] == "accelerate/decelerate, CW, 200 pulses → BUSY"
    assert found.moves[0].way == 1 and found.moves[0].pulses > 10
    assert len(found.notes) == notes, found.notes
    result = compare(found, round(tolerance * US))
    assert not result.differences and result.compared > 50
    return found


SIGROK: dict[str, dict[str, object]] = {
    "without options": {},
    "label=channel": {"label": "channel"},
    "label=off": {"label": "off"},
    "dedup": {"dedup": True},
    "dedup, label=channel": {"dedup": True, "label": "channel"},
    "time=false": {"time": False},
    "time=false, label=off": {"time": False, "label": "off"},
    "value=;": {"separator": ";"},
    "value=tab": {"separator": "\t"},
    "trigger": {"trigger": True},
}


@pytest.mark.parametrize("name", SIGROK)
def test_csv_of_sigrok(name: str, tmp_path: Path) -> None:
    """Times are derived from sample rate and row number, not from the period of 41 ns that sigrok writes."""
    path = sigrok_cli(seen(), tmp_path / "a.csv", **SIGROK[name])  # type: ignore[arg-type]
    check(path)
    true = exact(seen()).wires["pout_n"][1]
    found = read_capture(path).channels["pout_n"]
    assert [t for t, _ in found.changes] == [t for t, _ in true]


def test_sigrok_without_its_head(tmp_path: Path) -> None:
    """Times without decimals are rejected if the file states neither their unit nor a sample rate."""
    path = sigrok_cli(seen(), tmp_path / "a.csv", label="channel", header=False)
    with pytest.raises(CaptureError, match=r"whole numbers without a unit: write it .* as `Time \[ns\]`"):
        read_capture(path)
    path = sigrok_cli(seen(), tmp_path / "b.csv", names=False)
    assert list(read_capture(path).channels)[:2] == ["logic0", "logic1"]


def test_rate_without_a_unit(tmp_path: Path) -> None:
    """The sample rate of a .sr file may have a unit, with or without a space; without a unit it is in Hz."""
    path = write_sr(seen(), tmp_path / "a.sr")
    with zipfile.ZipFile(path) as archive:
        files = {one: archive.read(one) for one in archive.namelist()}
    for rate in (b"24000000", b"24 MHz", b"24MHz", b"24000000 Hz", b"24.0 MHz"):
        old = files["metadata"].split(b"samplerate=")[1].split(b"\n")[0]
        with zipfile.ZipFile(path, "w") as archive:
            for name, data in files.items():
                text = data.replace(b"samplerate=" + old, b"samplerate=" + rate)
                archive.writestr(name, text if name == "metadata" else data)
        check(path)


def iso(t: Fraction) -> str:
    """Return a time stamp with a resolution of 1 ns."""
    ns = round(t * 10**9)
    second = datetime(2026, 3, 3, 23, 59, 59) + timedelta(seconds=ns // 10**9)
    return f"{second:%Y-%m-%dT%H:%M:%S}.{ns % 10**9:09d}+00:00"


TIMES: dict[str, dict[str, object]] = {
    "trigger at 0": {"shift": -0.002},
    "begins late": {"shift": 7.5},
    "WaveForms": {"head": "Time (s)", "shift": -0.001, "cell": lambda t: f"{float(t):.9g}"},
    "ms": {"head": "Time (ms)", "cell": lambda t: f"{float(t * 1000):.9f}"},
    "µs": {"head": "Time[µs]", "cell": lambda t: f"{float(t * 10**6):.6f}", "shift": -0.001},
    "ns, whole": {"head": "Time [ns]", "cell": lambda t: str(round(t * 10**9)), "shift": -0.001},
    "nanoseconds": {"head": "nanoseconds", "cell": lambda t: str(round(t * 10**9))},
    "time_ns": {"head": "time_ns", "cell": lambda t: str(round(t * 10**9))},
    "t/us": {"head": "t/us", "cell": lambda t: f"{float(t * 10**6):.6f}"},
    "a unit in each cell": {"head": "Time", "cell": lambda t: f"{float(t * 10**6):.6f}us"},
    "exponents": {"head": "Time", "cell": lambda t: f"{float(t):.12E}"},
    "ISO": {"cell": iso},
    "clock": {"head": "Time", "cell": lambda t: f"10:00:00.{round(t * 10**9):09d}"},
    "semicolon, decimal comma": {"separator": ";", "cell": lambda t: f"{float(t):.12f}".replace(".", ",")},
    "tab": {"separator": "\t"},
    "tab, decimal comma": {"separator": "\t", "cell": lambda t: f"{float(t):.12f}".replace(".", ",")},
    "H and L": {"level": "LH".__getitem__},
    "decimals": {"level": lambda level: f"{level}.0"},
    "quoted": {"level": lambda level: f'"{level}"'},
}


@pytest.mark.parametrize("name", TIMES)
def test_columns_of_times(name: str, tmp_path: Path) -> None:
    """Times with units, signs, time stamps and separators are read; the first row is the start of the
    capture.
    """
    found = check(saleae(exact(seen()), tmp_path / "a.csv", **TIMES[name]))  # type: ignore[arg-type]
    assert abs(found.wires.end - exact(seen()).end) < 1000


@pytest.mark.parametrize(
    ("rows", "says"),
    [
        ("Time [min],A\n0,1\n1,0\n", r"line 1: 'Time \[min\]' is not a known unit of time"),
        ("Time,A\n0,1\n1000,0\n", "whole numbers without a unit"),
        ("Sample,A\n0,1\n1000,0\n", "numbers of samples without a sample rate"),
        ("Time [s],A\n0,1\n0.5,5\n", "line 3: '0.5,5' is cut off or no row of levels"),
        ("Time [s],A\n0,1\nabc,0\n", "line 3: 'abc' is no time"),
        ("Time [s],A\n0,1\n0.5,0\n0.2,1\n", "row 3 of the table is earlier than the one before"),
        ("Time [s],A\n0,1\n1e30,0\n", "is the unit of the times right"),
        ("Time [s],A\n0,1\n1e99999,0\n", "is no time"),
        ("Time [s]\n0\n1\n", "neither a column of times nor a sample rate"),
        ("Time [s],A\n0,1\n0.5,0\n0.6,", "line 4: '0.6,' is cut off"),
        ("Time [s],A\n", "there are no samples in it"),
    ],
)
def test_bad_tables(rows: str, says: str, tmp_path: Path) -> None:
    """For an invalid row, one line names the row and the remedy."""
    (tmp_path / "a.csv").write_text(rows)
    with pytest.raises(CaptureError, match=says) as error:
        read_capture(tmp_path / "a.csv")
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "latin-1"])
def test_encodings(encoding: str, run: Run, tmp_path: Path) -> None:
    """Captures and maps may begin with a byte order mark and may be in UTF-16 or Latin-1."""
    for path in (
        saleae(seen(), tmp_path / "a.csv"),
        edited(
            seen(),
            tmp_path / "a.vcd",
            (r"\$timescale", "$date März $end\n$version Gerät é $end\n$timescale"),
        ),
    ):
        path.write_bytes(path.read_text(encoding="utf-8").encode(encoding))
        check(path)
    text = "part: stmc\npins:\n  a0: Prüfung\n"
    (tmp_path / "a.yml").write_bytes(text.encode(encoding))
    assert read_map(tmp_path / "a.yml").pins == {"a0": "Prüfung"}


@pytest.mark.parametrize(
    ("declared", "turned"),
    [("[7:0]", False), ("[8:1]", False), ("[0:7]", True), ("[1:8]", True), ("", False)],
)
def test_declared_ranges(declared: str, turned: bool, tmp_path: Path) -> None:
    """The lowest index of a vector is D0, regardless of the order of its bits in the file; an ascending range
    is reported.
    """
    path = with_bus(seen(), tmp_path / "a.vcd", declared, turned)
    check(path, notes=int(turned))
    low = 1 if declared in ("[8:1]", "[1:8]") else 0
    pins: dict[str, object] = {"d": [f"d[{n + low}]" for n in range(8)]}
    pins |= {name: name for name in ("a0", "cs_n", "rd_n", "wr_n", "pout_n", "dir")}
    found = lines_of(path, PinMap(pins=pins))
    assert found.lines[1].text == "accelerate/decelerate, CW, 200 pulses → BUSY"
    pins["d"] = [f"d[{n + low + 1}]" for n in range(8)]
    with pytest.raises(CaptureError, match=rf"channel d\[{8 + low}\]: a.vcd has its bits"):
        lines_of(path, PinMap(pins=pins))


def test_names_of_variables(tmp_path: Path) -> None:
    """Names with `[0:0]`, escaped names, names with spaces, and scopes of single bits are read."""
    check(edited(seen(), tmp_path / "a.vcd", (r" wr_n \$end", " wr_n [0:0] $end")))
    check(edited(seen(), tmp_path / "a.vcd", (r" d\[(\d)\] \$end", r" d [\1:\1] $end")))
    check(edited(seen(), tmp_path / "a.vcd", (r" d\[(\d)\] \$end", r" d [\1] $end")))
    check(edited(seen(), tmp_path / "a.vcd", (r" d\[(\d)\] \$end", r" \\d[\1] $end")))
    check(edited(seen(), tmp_path / "a.vcd", (r" d\[(\d)\] \$end", r" D\1 $end")))
    path = edited(seen(), tmp_path / "a.vcd", (r" d\[(\d)\] \$end", r" Channel \1 $end"))
    pins: dict[str, object] = {"d": [f"Channel {n}" for n in range(8)]}
    pins |= {name: name for name in ("a0", "cs_n", "rd_n", "wr_n", "pout_n", "dir")}
    assert "200 pulses" in lines_of(path, PinMap(pins=pins)).lines[1].text


def test_duplicate_names(tmp_path: Path) -> None:
    """If one scope has two variables with the same name, the use of this name is rejected."""
    path = edited(seen(), tmp_path / "a.vcd", (r" hold \$end", " dir $end"))
    with pytest.raises(CaptureError, match=r"two channels are dir .*: name the right one with --map"):
        lines_of(path)
    pins: dict[str, object] = {"d": [f"d[{n}]" for n in range(8)], "dir": "dir"}
    with pytest.raises(CaptureError, match="two channels of a.vcd are called 'dir': name the channel by"):
        lines_of(path, PinMap(pins=pins))


SCALES = {
    "missing": ("", 1000, 1),
    "0.001 fs": ("$timescale 0.001 fs $end", Fraction(1, 10**6), 0),
    "100 fs": ("$timescale 100fs $end", Fraction(1, 10), 0),
    "10 ps": ("$timescale\n  10 ps\n$end", 10, 0),
    "s": ("$timescale 1 ps $end", 1, 0),
}


@pytest.mark.parametrize("name", SCALES)
def test_timescales(name: str, tmp_path: Path) -> None:
    """The times of a file without $timescale are read as ns, which is reported; fractions of 1 fs are
    read.
    """
    text, ps, notes = SCALES[name]
    path = write_vcd(
        probe(session("ppmc104"), rate=1e9 if ps == 1000 else 1e8, until=0.016), tmp_path / "a.vcd"
    )
    lines = []
    for line in path.read_text().splitlines():
        if line.startswith("#"):
            line = f"#{round(int(line[1:]) / Fraction(ps))}"
        lines.append(text if line.startswith("$timescale") else line)
    path.write_text("\n".join(lines) + "\n")
    check(path, notes=notes)


INPUTS = ("l1_n", "l2_n", "alm_n", "cnp_n")


def without_values(path: Path, names: tuple[str, ...], level: str | None) -> Path:
    """Replace all values of these variables by this level, or remove them."""
    text = path.read_text()
    codes = [
        line.split()[3] for line in text.splitlines() if line.startswith("$var") and line.split()[4] in names
    ]
    assert len(codes) == len(names)
    lines = []
    for line in text.splitlines():
        if line[:1] in ("0", "1") and line[1:] in codes:
            if level is None:
                continue
            line = level + line[1:]
        lines.append(line)
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize("level", ["x", "z", "X", None])
def test_unknown_inputs(level: str | None, run: Run, tmp_path: Path) -> None:
    """Switches whose level is unknown count as inactive; one line reports this."""
    path = without_values(write_vcd(seen(), tmp_path / "a.vcd"), INPUTS, level)
    found = check(path, notes=1)
    assert found.notes[0].startswith("unknown levels (x, z, none), assumed inactive: ")
    assert all(name in found.notes[0] for name in INPUTS)
    outcome = run("decode", str(path), "--part", "ppmc104", "--compare", "--timing", "FAST")
    assert outcome.err.count("assumed inactive") == 1


def test_unknown_strobes(tmp_path: Path) -> None:
    """A strobe whose level is never known is rejected like a strobe that was not captured."""
    path = without_values(write_vcd(seen(), tmp_path / "a.vcd"), ("wr_n",), "x")
    with pytest.raises(CaptureError, match="wr_n has no known level .*; capture it"):
        lines_of(path)


def test_a_dump_that_is_switched_off(tmp_path: Path) -> None:
    """Between $dumpoff and $dumpon levels are unknown: inputs count as inactive, outputs keep their level."""
    path = write_vcd(seen(), tmp_path / "a.vcd")
    text = path.read_text()
    codes = [line.split()[3] for line in text.splitlines() if line.startswith("$var")]
    levels = dict.fromkeys(codes, "x")
    lines, done = [], False
    for line in text.splitlines():
        if line.startswith("#") and int(line[1:]) > 2_000_000_000 and not done:
            t, done = int(line[1:]), True
            lines += [f"#{t - 3_000_000}", "$dumpoff", *(f"x{code}" for code in codes), "$end"]
            lines += [f"#{t - 2_000_000}", "$dumpon", *(f"{levels[code]}{code}" for code in codes), "$end"]
        if line[:1] in ("0", "1") and line[1:] in levels:
            levels[line[1:]] = line[0]
        lines.append(line)
    path.write_text("\n".join(lines) + "\n")
    check(path, notes=1)


def test_vectors_with_unknown_bits(tmp_path: Path) -> None:
    """The known bits of a vector are used; a vector of x may have the short form that the format permits."""
    path = with_bus(seen(), tmp_path / "a.vcd", "[7:0]")
    text = path.read_text()
    name, code = "l", "LL"
    text = text.replace("$upscope", f"$var wire 4 {code} {name} [3:0] $end\n$upscope", 1)
    text = (
        text.replace("#0\n", f"#0\nbx {code}\n", 1)
        + f"#17000000000\nb1x0z {code}\n#18000000000\nb101 {code}\n"
    )
    path.write_text(text)
    channel = read_capture(path).channels[name]
    assert [channel.bit(n).settled(1, False).changes for n in range(4)] == [
        [],
        [(17_000_000_000, 0)],
        [],
        [(18_000_000_000, 0)],
    ]


def test_cells_without_a_level(tmp_path: Path) -> None:
    """X, Z and empty cells of a table are read as unknown levels."""
    path = saleae(seen(), tmp_path / "a.csv")
    for cell in ("X", "z", "", "-"):
        lines = path.read_text().splitlines()
        place = lines[0].split(",").index("l1_n")
        rows = [line.split(",") for line in lines]
        for row in rows[1:]:
            row[place] = cell
        path.write_text("\n".join(map(",".join, rows)) + "\n")
        assert "l1_n" in check(path, notes=1).notes[0]


def test_comments_anywhere(tmp_path: Path) -> None:
    """Comments, real variables and a final $vcdclose are ignored."""
    path = edited(
        seen(),
        tmp_path / "a.vcd",
        (r"\$upscope", "$var real 64 RR speed $end\n$upscope"),
        (r"^#(\d{10})$", r"#\g<1>\n$comment 0! b1 #5 $end r1.5e3 RR\n$comment\n$end"),
    )
    check(path, notes=1)
    path.write_text(path.read_text() + "$vcdclose #99 $end\n")
    check(path, notes=1)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (r"^#5\d{9}$", "#12a", "damaged at line .*#12a is no time"),
        (r"^#5\d{9}$", "#1", "damaged at line .*time goes back"),
        (r"^1!$", "1!!", "damaged at line .*no variable has the code !!"),
        (r"^1!$", "5!", "damaged at line .*is neither a time nor a level"),
        (r"\$timescale.*", "$timescale 1 min $end", "timescale 1min: expected a number and s, ms"),
        (r"\$var wire 1 ! ", "$var wire ? ! ", "line .*is damaged: export it again"),
    ],
)
def test_damaged_dumps(old: str, new: str, says: str, tmp_path: Path) -> None:
    """For an invalid line, one line names the line and the remedy."""
    with pytest.raises(CaptureError, match=says) as error:
        lines_of(edited(seen(), tmp_path / "a.vcd", (old, new)))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(("level", "begin"), [(0, 0.0), (1, 0.0), (1, 42e-6)])
def test_a_constant_output(level: int, begin: float, run: Run, tmp_path: Path) -> None:
    """If DIR is stuck at the wrong level, one difference is reported; at the correct level, none is."""
    without = ("rst_n",) if begin else ()
    one = probe(session("ppmc104"), rate=1e9, until=0.016, begin=begin, without=without)
    one.wires["dir"] = (level, [])
    found = lines_of(write_vcd(one, tmp_path / "a.vcd"))
    result = compare(found, 2 * US)
    assert [(row.pin, row.level, row.steady) for row in result.differences] == [("dir", 1, True)] * level
    if level:
        outcome = run("decode", str(tmp_path / "a.vcd"), "--part", "ppmc104", "--compare", "--timing", "FAST")
        assert outcome.code == 1 and "dir is 1: the model has 0" in outcome.err


def test_hint_needs_pins_that_differ(run: Run, tmp_path: Path) -> None:
    """If a PPMC-104 was sampled too slowly, the error does not suggest that the capture is from another
    device.
    """
    path = write_vcd(probe(session("ppmc104"), rate=1e6), tmp_path / "slow.vcd")
    outcome = run("decode", str(path), "--part", "ppmc104")
    assert "sampled every 1 µs" in outcome.err and "another part" not in outcome.err
