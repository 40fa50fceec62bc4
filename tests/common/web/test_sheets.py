"""The data sheets as PDF: contents, bookmarks, fonts, margins, links and reproducible bytes."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from typing import Any

import pytest
from pdfminer.high_level import extract_pages, extract_text
from pdfminer.layout import LTChar, LTComponent, LTImage, LTPage
from pdfminer.pdfdocument import PDFDocument
from pdfminer.pdfparser import PDFParser
from pdfminer.pdftypes import resolve1

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import ProjectError
from openppmc import __version__
from scripts.site import sheets
from scripts.site.hooks import PARTS
from tests.common.web.counters import add

MM = 72 / 25.4
LEFT, RIGHT, BOTTOM, TOP = 20 * MM, 190 * MM, 9 * MM, 288 * MM
FONTS = {"LibertinusSerif", "DejaVuSansMono", "NewCMMath"}


@cache
def sheet(part: str) -> bytes:
    """Return the data sheet of a part, with the time of a release."""
    os.environ["SOURCE_DATE_EPOCH"] = "1700000000"
    try:
        return sheets.make(part)
    finally:
        del os.environ["SOURCE_DATE_EPOCH"]


@cache
def document(part: str) -> PDFDocument:
    """Return the data sheet of a part as read by pdfminer."""
    return PDFDocument(PDFParser(io.BytesIO(sheet(part))))


def words(text: str) -> str:
    """Return a text in which one space replaces each run of white space."""
    return " ".join(text.split())


def marks(item: Any) -> Iterator[LTComponent]:
    """Yield all characters and pictures of a page, also those in figures."""
    for child in item:
        if isinstance(child, LTChar | LTImage):
            yield child
        elif hasattr(child, "__iter__"):
            yield from marks(child)


@pytest.mark.parametrize("part", PARTS)
def test_cover(part):
    """The cover has the title, features, version and date, and the contents follow on the next page."""
    first, second = (words(extract_text(io.BytesIO(sheet(part)), page_numbers=[n])) for n in (0, 1))
    title = (ROOT / "docs" / part / "README.md").read_text(encoding="utf-8").splitlines()[0].lstrip("# ")
    for text in (*title.split(": ", 1), f"version {__version__}, 2023-11-14", "Features", "Figure 1"):
        assert text in first
    assert re.search(r"commit (unknown|[0-9a-f]{10})\b", first)
    assert "Contents" in second and "Revision history" in second


@pytest.mark.parametrize("part", PARTS)
def test_bookmarks(part):
    """Each chapter of the manual, each further page of the device and the revision history are bookmarks."""
    found = [words(title) for _, title, *_ in document(part).get_outlines()]
    manual = (ROOT / "docs" / part / "README.md").read_text(encoding="utf-8")
    chapters = re.findall(r"^## (?:\d+ )?(.*)$", re.sub(r"^```.*?^```", "", manual, flags=re.M | re.S), re.M)
    others = [ROOT / "docs" / part / f"{name}.md" for name in sheets.APPENDICES]
    chapters += [
        path.read_text(encoding="utf-8").splitlines()[0].lstrip("# ") for path in others if path.is_file()
    ]
    missing = [name for name in chapters if not any(mark.endswith(name.replace("`", "")) for mark in found)]
    assert missing == [] and found[-1] == "Revision history"


@pytest.mark.parametrize("part", PARTS)
def test_fonts(part):
    """Each font is in the file, and it is a font of Typst."""
    fonts = {}
    for xref in document(part).xrefs:
        for number in xref.get_objids():
            value = document(part).getobj(number)
            if isinstance(value, dict) and value.get("Type") and value["Type"].name == "FontDescriptor":
                fonts[value["FontName"].name] = value
    names = {re.sub(r"^[A-Z]{6}\+|-.*", "", name) for name in fonts}
    assert names <= FONTS and "LibertinusSerif" in names
    assert all({"FontFile", "FontFile2", "FontFile3"} & value.keys() for value in fonts.values())


@pytest.mark.parametrize("part", PARTS)
def test_margins(part):
    """No character and no picture is outside of the margins."""
    outside, pages = [], 0
    for page in extract_pages(io.BytesIO(sheet(part)), laparams=None):
        assert isinstance(page, LTPage)
        pages += 1
        for mark in marks(page):
            text = mark.get_text() if isinstance(mark, LTChar) else "picture"
            inside = LEFT - 1 < mark.x0 and mark.x1 < RIGHT + 1 and BOTTOM < mark.y0 and mark.y1 < TOP
            if text.strip() and not inside:
                outside.append((page.pageid, text, round(mark.x0), round(mark.x1), round(mark.y0)))
    assert outside == []
    add(f"data sheet of {part}: {pages} pages, {len(sheet(part)):,} bytes")


@pytest.mark.parametrize("part", PARTS)
def test_links(part):
    """Each link leads to a web address or to a place in the document, never to a file."""
    targets: list[Any] = []
    for xref in document(part).xrefs:
        for number in xref.get_objids():
            value = document(part).getobj(number)
            if isinstance(value, dict) and value.get("Subtype") and value["Subtype"].name == "Link":
                targets.append(resolve1(value.get("A")) or value["Dest"])
    urls = [target["URI"] for target in targets if isinstance(target, dict) and "URI" in target]
    assert len(targets) > 40 and all(url.startswith(b"http") for url in urls)


def test_same_bytes():
    """A second process, with another time zone and folder, makes the same bytes."""
    program = "import sys; from scripts.site import sheets; sys.stdout.buffer.write(sheets.make(sys.argv[1]))"
    env = {**os.environ, "SOURCE_DATE_EPOCH": "1700000000", "TZ": "Asia/Tokyo", "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-c", program, "bank"]
    done = subprocess.run(command, cwd="/", env=env, capture_output=True, check=True)
    assert done.stdout == sheet("bank")


@pytest.mark.parametrize(
    ("text", "wrong", "message"),
    [
        ("(#rules)", "(#nowhere)", "nowhere"),
        ("(img/group.svg)", "(img/nothing.svg)", "nothing.svg"),
        ("## 2 Pins", "---\n\n## 2 Pins", "no typesetting for hr"),
    ],
)
def test_mistakes_in_a_page(monkeypatch, text, wrong, message):
    """A link without a target, a missing picture and unknown Markdown are reported in one line."""
    parse = sheets.MarkdownIt.parse
    monkeypatch.setattr(sheets.MarkdownIt, "parse", lambda self, page: parse(self, page.replace(text, wrong)))
    with pytest.raises(ProjectError, match=f"^data sheet of bank: .*{re.escape(message)}") as caught:
        sheets.make("bank")
    assert "\n" not in str(caught.value)
