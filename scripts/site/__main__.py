"""`make site`: all documents, the Python API and the playground as static pages in build/site/html."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import ProjectError, relative, run
from scripts.site import sheets, wasm
from scripts.site.hooks import PARTS, START, data_sheet
from scripts.site.pages import SITE, playground
from scripts.site.progress import say

PAGES = wasm.OUT / "pages"
HTML = wasm.OUT / "html"
OTHERS = (
    "README.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "CHANGELOG.md",
    "LICENSE",
    "drivers/c/README.md",
    "examples/cocotb/README.md",
    "examples/systemverilog/README.md",
)
LINK = re.compile(r"\]\(([^)#?\s:]+)(?:#[^)]*)?\)")
APP = """---
hide: [navigation, toc, footer]
title: Playground
---

# Playground

<div id="openppmc-playground" markdown="0"><p>The playground needs JavaScript and WebAssembly.</p></div>
<link rel="stylesheet" href="playground/playground.css">
<link rel="preload" as="script" href="playground/parts/ppmc104.js">
<script src="playground/parts.js"></script>
<script src="playground/playground.js"></script>

<div id="pg-statements" markdown="1" popover>
"""

TRIED = re.compile(r"^\*\*No board .*?(?=\n## )", re.M | re.S)
"""Part of README.md that states what was tried on hardware; the landing page contains it."""


def linked(page: Path) -> Iterator[Path]:
    """Yield the files of the checkout to which a page links."""
    for target in LINK.findall(page.read_text(encoding="utf-8")):
        path = (page.parent / target).resolve()
        if path.is_file() and path.is_relative_to(ROOT):
            yield path


def stage() -> None:
    """Copy all inputs of MkDocs to PAGES; files keep their paths in the checkout, so links do not change."""
    shutil.rmtree(PAGES, ignore_errors=True)
    sources = [*(ROOT / name for name in OTHERS), *(p for p in (ROOT / "docs").rglob("*") if p.is_file())]
    for source in dict.fromkeys([*sources, *(p for s in sources if s.suffix == ".md" for p in linked(s))]):
        to = PAGES / source.relative_to(ROOT)
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, to)
    manual = (ROOT / "docs/playground.md").read_text(encoding="utf-8")
    (PAGES / "playground.md").write_text(
        f"{APP}\n## Statements{manual.split('## Statements')[1]}\n</div>\n", encoding="utf-8"
    )
    tried = TRIED.search((ROOT / START).read_text(encoding="utf-8"))
    if not tried:
        raise ProjectError(f"{START}: no paragraph '**No board …'; change TRIED in scripts/site/__main__.py")
    landing = (SITE / "landing.md").read_text(encoding="utf-8")
    (PAGES / "landing.md").write_text(landing.replace("<!-- tried -->", tried[0]), encoding="utf-8")
    shutil.copytree(playground(), PAGES / "playground", ignore=shutil.ignore_patterns("index.html"))
    shutil.copy(SITE / "site.css", PAGES)
    # The search in local files needs this script, which MkDocs Material would load from another host.
    shim = (SITE / "node_modules/iframe-worker/shim/index.js").read_text(encoding="utf-8")
    text = (SITE / "search_shim.js").read_text(encoding="utf-8").replace("/* SHIM */", shim)
    (PAGES / "iframe-worker.js").write_text(text, encoding="utf-8")
    shutil.copytree(SITE / "api", PAGES / "api")


def build(out: Path = HTML) -> Path:
    """Build the whole site in `out`; raise ProjectError with the first warning of MkDocs."""
    stage()
    say("all pages, with MkDocs")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--clean"]
    command += ["-f", str(SITE / "mkdocs.yml"), "-d", str(out)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    log = wasm.OUT / "mkdocs.log"
    log.write_text(done.stdout + done.stderr, encoding="utf-8")
    if done.returncode:
        wrong = [line for line in done.stderr.splitlines() if line.startswith(("WARNING", "ERROR"))]
        raise ProjectError(f"{wrong[0] if wrong else 'MkDocs failed'} (the whole log: {relative(log)})")
    for number, part in enumerate(PARTS, 1):
        say(f"data sheet of {part}, {number} of {len(PARTS)}")
        path = out / data_sheet(part)
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(sheets.make(part))
    return out


def main() -> int:
    """Build the site, print its path, and return the exit code."""
    try:
        folder = build()
    except (ProjectError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    pages = sum(1 for _ in folder.rglob("*.html"))
    print(f"{pages} pages, {size / 1e6:.1f} MB: {relative(folder / 'index.html')}")
    return 0


if __name__ == "__main__":
    sys.exit(run(main, ""))
