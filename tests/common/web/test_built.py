"""The built site: titles, hosts, and its pages in Chromium, over http and from a file."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import ProjectError
from scripts.site import wasm
from scripts.site.__main__ import build
from scripts.site.pages import SITE, packages
from tests.common.web.counters import add

HERE = ROOT / "tests/common/web"
pytestmark = [
    pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed"),
    pytest.mark.xdist_group("page"),
]
NAMES = re.findall(r'^  async "([^"]+)"\(\)', (HERE / "built.mjs").read_text(encoding="utf-8"), re.M)
LOADS = re.compile(
    r"<(?:script|img|iframe|source|embed)\b[^>]*?\bsrc=[\"']?(?:https?:)?//[^\"' >]*"
    r"|<link\b(?=[^>]*\brel=[\"']?(?:stylesheet|icon|preload|preconnect|manifest))[^>]*\bhref=[\"']?(?:https?:)?//[^>]*"
)


@cache
def site() -> Path:
    """Build the site in a folder whose name has a space and letters outside ASCII."""
    return build(out=wasm.OUT / "tested/a site ü")


def run(script: str) -> str:
    """Run a script of this folder on the site, and return its output; without a browser, skip the test."""
    try:
        packages(SITE / "browser")
    except ProjectError as error:
        pytest.skip(f"no browser: {error}")
    command = ["node", str(HERE / script), str(site()), str(ROOT / "build/site/shots"), str(SITE / "browser")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 3:
        pytest.skip(done.stderr.strip().splitlines()[-1])
    assert done.returncode == 0, done.stderr
    return done.stdout


@cache
def checked() -> dict[str, dict[str, str]]:
    """Return the result of each check in the browser."""
    lines = [json.loads(line) for line in run("built.mjs").splitlines()]
    for line in lines:
        if line.get("told"):
            add(f"site: {line['told']}")
    return {line["name"]: line for line in lines}


def pages() -> dict[str, str]:
    """Return the text of each page by its path."""
    return {
        str(path.relative_to(site())): path.read_text(encoding="utf-8") for path in site().rglob("*.html")
    }


def test_titles():
    """The title of each page is unique."""
    titles = Counter(re.findall(r"<title>(.*?)</title>", text, re.S)[0] for text in pages().values())
    assert [title for title, count in titles.items() if count > 1] == []


def test_no_other_host():
    """No page loads a script, a style sheet or a picture from another host."""
    assert {name: found for name, text in pages().items() if (found := LOADS.findall(text))} == {}


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_built(name):
    """The page passes its check in a browser without an error in the console."""
    assert checked()[name].get("error") is None, checked()[name]["error"]


def test_firefox():
    """In Firefox, the first visit starts a session, and the playground fits the window without scrolling."""
    add(f"site: the playground runs in {run('firefox.mjs').strip()}")
