"""Every link within the pages has a target: the file exists, and so does the heading."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from cocotb_tests.harness.project import DOCS, ROOT
from scripts.measure.trace import at_home

PAGES = sorted([*DOCS.rglob("*.md"), *ROOT.glob("*.md"), *(ROOT / "drivers").rglob("*.md")])
LINK = re.compile(r"\]\(([^)\s]+)\)")
FENCE = re.compile(r"^(```|~~~).*?^\1", re.MULTILINE | re.DOTALL)


def prose(page: Path) -> str:
    """Return the text of a page without blocks of code."""
    return FENCE.sub("", page.read_text(encoding="utf-8"))


@cache
def anchors(page: Path) -> frozenset[str]:
    """Return the anchors that GitHub makes of headings.

    An anchor has lower-case letters, dashes, no punctuation, and a number after repeated headings.
    """
    found: set[str] = set()
    for heading in re.findall(r"^#{1,6} +(.+?) *#*$", prose(page), re.MULTILINE):
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        base = slug = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
        number = 0
        while slug in found:
            number += 1
            slug = f"{base}-{number}"
        found.add(slug)
    return frozenset(found | set(re.findall(r'<a (?:id|name)="([^"]+)"', prose(page))))


def dead(page: Path, text: str) -> list[str]:
    """Return the targets of a page's links that do not exist."""
    wrong = []
    for target in LINK.findall(text):
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        file = (page.parent / name).resolve() if name else page
        if not file.exists() or (anchor and file.suffix == ".md" and anchor not in anchors(file)):
            wrong.append(target)
    return wrong


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links(page: Path) -> None:
    assert not dead(page, prose(page))


def test_a_dead_link_is_found() -> None:
    text = "[a](ppmc312/README.md#7-states) [b](#7-states) [c](ppmc312/README.md#8-states) [d](no.md) [e](https://example.org/#x)"
    assert dead(DOCS / "testing.md", text) == ["#7-states", "ppmc312/README.md#8-states", "no.md"]


def test_links_of_a_rule_move_with_it() -> None:
    """In statements that `make trace` copies to another page, the links are adapted to the folder of this
    page.
    """
    text = "[a](#7-states), [b](../boards.md#3-pins), [c](img/x.svg), [d](https://example.org)"
    moved = "[a](README.md#7-states), [b](../boards.md#3-pins), [c](img/x.svg), [d](https://example.org)"
    assert at_home(text) == moved
