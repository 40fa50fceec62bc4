"""The playground's folder: its script, bundled by esbuild, and the tables and modules of all parts."""

from __future__ import annotations

import shutil
import subprocess
from functools import cache
from pathlib import Path

from cocotb_tests.harness.build import locked
from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import ProjectError, relative
from scripts.site import export, wasm
from scripts.site.progress import say

SITE = ROOT / "site"


def node(*command: str, folder: Path = SITE) -> None:
    """Run a tool of Node.js; raise ProjectError with the name of the log if it fails."""
    if shutil.which(command[0]) is None:
        raise ProjectError(
            f"{command[0]} is not installed; the site needs Node.js 18 or newer (apt install npm)"
        )
    log = wasm.OUT / f"{command[0]}.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("w", encoding="utf-8") as sink:
        done = subprocess.run(
            command, cwd=folder, stdin=subprocess.DEVNULL, stdout=sink, stderr=sink, check=False
        )
    if done.returncode:
        raise ProjectError(f"{' '.join(command)} failed: see {relative(log)}")


def packages(folder: Path) -> None:
    """Install the packages of a package-lock.json unless this was already done for its present content.

    Only one process at a time installs: `npm ci` empties node_modules first, so another process would find an
    incomplete folder.
    """
    lock, mark = folder / "package-lock.json", folder / "node_modules/.openppmc"
    with locked(wasm.OUT / f"{folder.name}.lock"):
        if not mark.is_file() or mark.read_bytes() != lock.read_bytes():
            node("npm", "ci", "--no-audit", "--no-fund", folder=folder)
            shutil.copy(lock, mark)


@cache
def playground() -> Path:
    """Build what has changed; return the folder. Several processes may call this at the same time."""
    with locked(wasm.OUT / "playground.lock"):
        return _made()


def _made() -> Path:
    say("npm packages of the playground")
    packages(SITE)
    say("script of the playground")
    node("npx", "tsc", "--noEmit")
    node("node", "build.mjs", str(export.PLAYGROUND))
    export.all_parts()
    export.put(export.PLAYGROUND / "index.html", (SITE / "index.html").read_bytes())
    return export.PLAYGROUND
