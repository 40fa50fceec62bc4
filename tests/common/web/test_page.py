"""The page in a real Chromium: sessions, switches, links, VCD, bad input, names, frames (browser.mjs)."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from functools import cache
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import ProjectError
from openppmc.check.comparison import compare_edges
from openppmc.check.records import Edge
from scripts.site import wasm
from scripts.site.pages import SITE, packages, playground
from scripts.site.sessions import sessions
from scripts.site.webparts import WEB_PARTS
from tests.common.web.counters import add
from tests.common.web.players import player

HERE = ROOT / "tests/common/web"
SHOTS = ROOT / "build/site/shots"
pytestmark = pytest.mark.xdist_group("page")  # one process opens the browser once for all checks
NAMES = re.findall(r'^  async "([^"]+)"\(\)', (HERE / "browser.mjs").read_text(encoding="utf-8"), re.M)


@cache
def checked() -> dict[str, dict[str, str]]:
    """Return the result of each check in the browser. Without a browser, skip the tests with a message."""
    if shutil.which("node") is None:
        pytest.skip("node is not installed: no browser")
    folder = playground()
    try:
        packages(SITE / "browser")
    except ProjectError as error:
        pytest.skip(f"no browser: {error}")
    tripped = wasm.build("ppmc104", bound=[HERE / "trip.sv"])
    command = [
        "node",
        str(HERE / "browser.mjs"),
        str(folder),
        str(SHOTS),
        str(SITE / "browser"),
        str(tripped),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 3:
        pytest.skip(done.stderr.strip().splitlines()[-1])
    assert done.returncode == 0, done.stderr
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    for line in lines:
        if line.get("told"):
            add(f"page: {line['told']}")
    return {line["name"]: line for line in lines}


@pytest.mark.parametrize("name", NAMES)
def test_page(name):
    """The page passes the check without an error in the console."""
    assert checked()[name].get("error") is None, checked()[name]["error"]


def vcd_edges(path: Path, outputs: dict[str, int], ps: int) -> tuple[list[Edge], int]:
    """Return (edges of these outputs in cycles, last cycle) from a file that the page has saved."""
    names: dict[str, str] = {}
    edges, t = [], -1
    for line in path.read_text(encoding="utf-8").splitlines():
        if found := re.match(r"\$var wire \d+ (\S+) (\w+)", line):
            names[found[1]] = found[2]
        elif line.startswith("#"):
            t = int(line[1:]) // ps - 1
        elif found := re.match(r"b([01]+) (\S+)|([01])(\S+)", line):
            name, value = names[found[2] or found[4]], int(found[1] or found[3], 2)
            if name in outputs and t >= 0:
                edges.append(Edge(t, name, value))
    return edges, t


def test_vcd():
    """The edges in the VCD of a session are those of the golden model."""
    checked()
    part = WEB_PARTS["ppmc104"]
    text = next(session.text for session in sessions("ppmc104") if session.name == "2")
    recording = player(part).play(text)
    levels = part.part.reset_levels(part.params)
    initial = {pin: levels[pin] for pin in part.part.watched}
    edges, end = vcd_edges(SHOTS / "ppmc104-2.vcd", initial, 10**12 // part.config.clk_hz)
    assert end > recording.end
    _, actual, mismatch = compare_edges(recording.edges, edges, initial, recording.end)
    assert mismatch is None, mismatch
    add(f"page: VCD of ppmc104's session 2, {sum(map(len, actual.values()))} edges as in the golden model")
