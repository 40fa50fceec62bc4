"""The site as an archive, and the data sheets as PDF if there is a browser."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

from cocotb_tests.harness.project import ROOT, ProjectError, console

from .archive import files_below, tar_gz
from .state import Release

HTML = ROOT / "build" / "site" / "html"
_DATE = re.compile(rb"/(?:Creation|Mod)Date \(D:(\d{14})")
NO_PDF = "No data sheets as PDF: there was no browser."


def dated(pdf: bytes, epoch: int) -> bytes:
    """A PDF with this time in place of that of its making; no byte moves."""
    when = time.strftime("%Y%m%d%H%M%S", time.gmtime(epoch)).encode()
    return _DATE.sub(lambda match: match[0][: -len(match[1])] + when, pdf)


def check() -> None:
    """ProjectError if what the site needs beside Python is not there; asked before anything is made."""
    if shutil.which("npm") is None:
        raise ProjectError(
            "npm is not installed: the site needs Node.js (Debian: apt-get install npm), or SKIP=site"
        )


def make(release: Release, out: Path, scratch: Path) -> None:
    """Archive and PDFs into `out`; one line if there is no browser."""
    check()
    command = [sys.executable, "-m", "scripts.site"]
    done = subprocess.run(
        command, cwd=ROOT, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise ProjectError(f"make site: {(done.stderr.strip().splitlines() or ['failed'])[-1]}")
    sheets = sorted((HTML / "pdf").glob("*.pdf"))
    for path in sheets:
        path.write_bytes(dated(path.read_bytes(), release.epoch))
        shutil.copyfile(path, out / release.name(path.stem, ".pdf"))
    if not sheets:
        console.print(NO_PDF)
        release.missing.append(NO_PDF)
    files = {f"openppmc-site-{release.version}/{name}": path for name, path in files_below(HTML).items()}
    tar_gz(out / release.name("site", ".tar.gz"), files, release.epoch)
