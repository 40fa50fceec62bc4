"""The site as an archive."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from cocotb_tests.harness.project import ROOT, ProjectError
from scripts.release.archive import files_below, tar_gz
from scripts.release.state import Release

HTML = ROOT / "build" / "site" / "html"
COMMAND = [sys.executable, "-m", "scripts.site"]


def check() -> None:
    """Raise ProjectError if a tool of the site, except Python, is missing; called before all steps."""
    if shutil.which("npm") is None:
        raise ProjectError(
            "npm is not installed; install Node.js (Debian: apt-get install npm), or use SKIP=site"
        )


def run(say: Callable[[str], None], scratch: Path) -> None:
    """Build the site and pass each line to `say` as soon as it is printed.

    If the build fails, raise ProjectError with the last line of its errors.
    """
    errors = scratch / "errors.txt"
    with errors.open("w", encoding="utf-8") as sink:
        with subprocess.Popen(
            COMMAND,
            cwd=ROOT,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=sink,
            encoding="utf-8",
            errors="replace",
        ) as running:
            assert running.stdout is not None
            for line in running.stdout:
                say(line.rstrip())
    if running.returncode:
        last = errors.read_text(encoding="utf-8", errors="replace").strip().splitlines() or ["failed"]
        raise ProjectError(f"make site: {last[-1]}")


def make(release: Release, out: Path, scratch: Path, say: Callable[[str], None]) -> None:
    """Write the archive to `out`; `say` receives the progress."""
    check()
    run(say, scratch)
    files = {f"openppmc-site-{release.version}/{name}": path for name, path in files_below(HTML).items()}
    tar_gz(out / release.name("site", ".tar.gz"), files, release.epoch)
