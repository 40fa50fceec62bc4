"""The sessions in the page of the serial mode of the PPMC-312, in the statements of the playground."""

from __future__ import annotations

import pytest

from scripts.site.webparts import WEB_PARTS
from tests.common.pages import DOCS, chapters
from tests.common.web.players import player

SESSIONS = {
    title: blocks for title, blocks in chapters(DOCS / "ppmc312/serial.md").items() if title.startswith("7.")
}
WORDS = {"at": "pulse", "ms": "wait", "=": "count"}
"""Words of the page, and the statements of the playground that replace them (docs/playground.md)."""


def statement(line: str) -> str:
    """Return a line of the page as statements; two spaces precede its explanation."""
    verb, _, rest = line.strip().partition("  ")[0].partition(" ")
    if verb == "pin":
        pin, *levels = rest.split()
        return "; ".join(f"set {pin}[1]={level}; wait 20" for level in levels)
    return f"{WORDS.get(verb, verb)} {rest}" + ("ms" if verb == "ms" else "")


@pytest.mark.parametrize("title", SESSIONS, ids=lambda title: title.split()[0])
def test_sessions_of_the_page(title):
    """Each session has the results that the page of the serial mode shows."""
    for block in SESSIONS[title]:
        recording = player(WEB_PARTS["ppmc312-serial"]).play("\n".join(map(statement, block)))
        assert len(recording.edges) > 50
