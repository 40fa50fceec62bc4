"""The panel "Real board" of the page in Chromium, with virtual boards on its serial port (board.mjs)."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from functools import cache
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import ProjectError
from openppmc import sim
from openppmc.sim.common.board import to_stderr
from scripts.site.pages import SITE, packages, playground
from scripts.site.webparts import BUILDS
from tests.common.slow import slow_if
from tests.common.web.counters import add

HERE = ROOT / "tests/common/web"
pytestmark = [
    pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed: no browser"),
    pytest.mark.skipif(sys.platform != "linux", reason="a virtual board needs Linux"),
    pytest.mark.xdist_group("page"),
]
NAMES = re.findall(r'^  async "([^"]+)"\(\)', (HERE / "board.mjs").read_text(encoding="utf-8"), re.M)
BOARDS = {
    # Clock frequency, crystal and timing are those of the module in the page, so that the page can compare
    # the recorded edges.
    "recorded": "clk=16000000,record=13",
    "plain": "",
    "idle": "clk=24000000,record=10",
    **{part: f"part={part}" for part in ("ppmc2104", "stmc", "ppmc312", "bank")},
}
"""Virtual boards by their names in board.mjs."""
OTHER_CLOCKS = "every edge of boards with other clocks"
REAL = ("ppmc104_24000000_0", "ppmc2104_100000000", "stmc_24000000", "bank_54000000_13500000_0_16")
"""Builds of the iCEBreaker, the ULX3S and the Tang Nano 9K, for which virtual boards are also started."""


def started(name: str) -> sim.SimBoard:
    """Start a virtual board of BOARDS, or with the parameters of a build in REAL."""
    if name in BOARDS:
        return sim.start(BOARDS[name])
    given = BUILDS[name].params
    words = {"clk": given["CLK_HZ"], "xtal": given["XTAL_HZ"], "axes": given.get("AXES"), "record": 10}
    spec = sim.parse_spec(f"part={BUILDS[name].name}", **words)
    # The text of a virtual board cannot set PHASE_IDLE.
    idle = {"phase_idle": str(given["PHASE_IDLE"])} if "PHASE_IDLE" in given else {}
    return sim.SimBoard(replace(spec, own={**spec.own, **idle}), to_stderr)


@contextmanager
def status_server(boards: dict[str, sim.SimBoard]) -> Iterator[str]:
    """Serve the number of pulses of each board, and yield the address."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.end_headers()
            self.wfile.write(str(boards[self.path.strip("/")].status().pulses).encode())

        def log_message(self, *words: object) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@cache
def checked(other_clocks: bool) -> dict[str, dict[str, str]]:
    """Return the results of the checks in the browser. Without a browser, skip the tests with a message."""
    try:
        packages(SITE / "browser")
    except ProjectError as error:
        pytest.skip(f"no browser: {error}")
    # A virtual board always needs processor time, so only the boards that the checks use are started.
    return results(REAL, OTHER_CLOCKS) if other_clocks else results(BOARDS, f"^(?!{OTHER_CLOCKS})")


def results(names: Iterable[str], checks: str) -> dict[str, dict[str, str]]:
    """Return the results of the checks whose name matches this regular expression, with these boards."""
    folder = playground()
    with ExitStack() as stack:
        boards = {name: stack.enter_context(started(name)) for name in names}
        status = stack.enter_context(status_server(boards))
        ports = {name: board.port for name, board in boards.items()}
        command = ["node", str(HERE / "board.mjs"), str(folder), str(ROOT / "build/site/shots")]
        command += [str(SITE / "browser"), json.dumps({**ports, "status": status}), checks]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 3:
        pytest.skip(done.stderr.strip().splitlines()[-1])
    if done.returncode:  # the failure is returned as a result, because an exception would not be cached
        return {name: {"error": done.stderr} for name in NAMES if re.search(checks, name)}
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    for line in lines:
        if line.get("told"):
            add(line["told"])
    return {line["name"]: line for line in lines}


@pytest.mark.parametrize("name", slow_if(lambda name: name == OTHER_CLOCKS, NAMES))
def test_board(name):
    """The panel passes the check without an error in the console."""
    result = checked(name == OTHER_CLOCKS)[name]
    assert result.get("error") is None, result["error"]
