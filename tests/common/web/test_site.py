"""The links of the pages to the playground, and the tables that describe bytes."""

from __future__ import annotations

import re
from types import SimpleNamespace

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc.capture.ppmc104.mnemonics import Ppmc104Decoder
from openppmc.model.single.codes import decode
from openppmc.parts import PARTS as DEVICES
from scripts.site.hooks import PARTS, on_post_page, run_links
from scripts.site.sessions import sessions
from scripts.site.texts import tables
from scripts.site.webparts import WEB_PARTS

PAGES = [part for part in PARTS if (ROOT / "docs" / part / "examples.md").is_file()]
WITHOUT = {("stmc", "9")}
"""Chapters whose sessions require a build that differs from that of the playground."""


def test_every_part_is_there():
    """The playground has exactly the devices of the site; a variant of a device has no manual."""
    assert set(PARTS) == {DEVICES[part].folder for part in WEB_PARTS}


@pytest.mark.parametrize("part", PAGES)
def test_every_example_can_be_run(part):
    """Each chapter of the examples with a session has a link, and its session exists."""
    text = (ROOT / "docs" / part / "examples.md").read_text(encoding="utf-8")
    chapters = [chapter for chapter in re.split(r"^## (?=\d)", text, flags=re.M)[1:] if "```" in chapter]
    numbers = {chapter.split()[0] for chapter in chapters}
    names = {session.name for session in sessions(part)}
    assert {(part, number) for number in numbers} - {(part, name) for name in names} <= WITHOUT
    linked = run_links(f"docs/{part}/examples.md", text)
    assert "<!-- run:" not in linked
    assert set(re.findall(rf"playground\.html#v=1&part={part}&run=(\d+)&go=1", linked)) == names
    assert 'href="../../playground.html#' in linked


def test_other_pages_stay_as_they_are():
    """A page without sessions is not changed; a manual, the overview and the page of the serial mode get one
    link.
    """
    assert run_links("docs/host.md", "# A\n\ntext") == "# A\n\ntext"
    manual = run_links("docs/bank/README.md", "# A\n\ntext")
    assert manual.startswith("# A\n") and manual.count("playground.html#v=1&part=bank") == 1
    overview = run_links("README.md", "# A\n\ntext")
    assert overview.count('href="playground.html#v=1&part=ppmc104&run=2&go=1"') == 1
    serial = run_links("docs/ppmc312/serial.md", "# A\n\ntext")
    assert serial.count("playground.html#v=1&part=ppmc312-serial&run=2&go=1") == 1


@pytest.mark.parametrize("part", WEB_PARTS)
def test_rules(part):
    """The tables state, for each command, each instruction and the status register, a rule that is in the
    manual.
    """
    found = tables(part, getattr(DEVICES[part].load("demo"), "words", Ppmc104Decoder()))
    names = {code["rule"] for code in found["codes"].values()} | {found["statusRule"]}
    assert names <= set(found["rules"]) and len(names) >= 12
    assert all(rule["text"] and "`" not in rule["text"] for rule in found["rules"].values())


def test_rules_of_commands():
    """The rule of a command is the rule of its operation or register; the row of each rule gets an anchor."""
    rules = {part: tables(part, Ppmc104Decoder())["codes"] for part in ("ppmc104", "ppmc312", "pmc006")}
    assert rules["ppmc104"]["43"]["rule"] == "P104-OPR-07" and rules["ppmc104"]["81"]["rule"] == "P104-RD-05"
    assert rules["ppmc312"]["82"]["rule"] == "P312-CMD-82" and rules["pmc006"]["s"]["rule"] == "P006-CMD-40"
    page = SimpleNamespace(file=SimpleNamespace(src_uri="docs/ppmc104/README.md"))
    row = "<tr><td>P104-OPR-07</td><td>P104</td></tr>"
    assert on_post_page(row, page) == '<tr><td id="p104-opr-07">P104-OPR-07</td><td>P104</td></tr>'


def test_words():
    """The tables of a device contain a text for each code, status and field, and no unknown codes."""
    found = tables("ppmc104", Ppmc104Decoder())
    assert found["codes"]["43"]["text"] == "accelerate/decelerate, CW"
    assert found["codes"]["43"]["fields"] == [{"name": "pulses", "bytes": 3, "plus": 1}]
    assert [field["name"] for field in found["codes"]["0A"]["fields"]] == ["RL", "RH", "PA"]
    assert found["codes"]["83"]["count"] == 3 and "04" not in found["codes"] and "C4" not in found["codes"]
    assert found["status"][0xA0] == "error 2: not initialised" and len(found["status"]) == 256
    for code, row in found["codes"].items():
        assert sum(field["bytes"] for field in row["fields"]) == decode(int(code, 16)).parameters
        assert row["text"] and not row["text"].startswith("command ")
