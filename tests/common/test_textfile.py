"""One reader for scripts, programs, maps and curves reads text files in all encodings of editors."""

from __future__ import annotations

from pathlib import Path

import pytest

from openppmc.capture.common.pinmap import read_map
from openppmc.cli.common.script import read_file, read_program
from openppmc.cli.pmc006.script import _read
from openppmc.host.ppmc312.profile import read_stages
from openppmc.textfile import NotTextError, chunks, decode_text, read_text

ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1")
TEXT = "# größer als 5 µs\nposition\n"


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_all_encodings(encoding: str, tmp_path: Path) -> None:
    """The text is the same for each encoding and for both line endings."""
    path = tmp_path / "a.txt"
    for end in ("\n", "\r\n"):
        path.write_bytes(TEXT.replace("\n", end).encode(encoding))
        assert read_text(path) == TEXT
    assert [step.word for step in read_program(*reversed(read_file(path)))] == ["position"]
    path.write_bytes(("; größer\n" + "\n" * 10 + "END\n").encode(encoding))
    text = b"".join(chunks(path, 64))
    assert text.endswith(b"END\n") and not text.startswith(b"\xef\xbb\xbf")


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_curves_and_maps(encoding: str, tmp_path: Path) -> None:
    """A curve and a map can have any of the encodings."""
    path = tmp_path / "curve.csv"
    path.write_bytes("# Rampe für µ\n100,20\n200,30\n".encode(encoding))
    assert [stage.up for stage in read_stages(path)] == [20, 30]
    pytest.importorskip("tomllib")
    path = tmp_path / "map.toml"
    path.write_bytes('part = "stmc"\n[pins]\na0 = "Prüf"\n'.encode(encoding))
    assert read_map(path).pins == {"a0": "Prüf"}


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_programs(encoding: str, tmp_path: Path) -> None:
    """A program of a PMC006B4 can have any of the encodings."""
    plain, path = tmp_path / "a.asm", tmp_path / "b.asm"
    plain.write_text("; für\nOUT gpo3, 1\n", encoding="utf-8")
    path.write_bytes(plain.read_text(encoding="utf-8").encode(encoding, errors="replace"))
    assert _read(path).image() == _read(plain).image()


@pytest.mark.parametrize("data", [b"\xff\xfe", b"a\nb\0c", b"\xff\xfea", b"\x7fELF\x02"])
def test_no_text(data: bytes) -> None:
    """If the bytes are not text, the error names the line."""
    with pytest.raises(NotTextError, match=r"^line \d: .*save it as UTF-8$"):
        decode_text(data)
