"""`make site`: all documents, the Python API and the playground as static pages in build/site/html."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import ProjectError, relative, run
from scripts.site import wasm
from scripts.site.hooks import PARTS, PDF, START, data_sheet
from scripts.site.pages import SITE, node, packages, playground
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
API = {
    "Host: PPMC-104": ("openppmc.host.ppmc104",),
    "Host: PPMC-2104": ("openppmc.host.ppmc2104.part", "openppmc.host.ppmc2104.axis"),
    "Host: J105 STMC": ("openppmc.host.stmc",),
    "Host: PPMC-312": ("openppmc.host.ppmc312.part",),
    "Host: PMC006B4": ("openppmc.host.pmc006.part", "openppmc.host.pmc006.axis"),
    "Host: bank": ("openppmc.host.bank.part", "openppmc.host.bank.axis", "openppmc.host.bank.group"),
    "Host: common classes": ("openppmc.host.part", "openppmc.host.units", "openppmc.host.axis"),
    "Golden models": ("openppmc.model.ppmc104", *(f"openppmc.model.{part}.part" for part in
                      ("ppmc2104", "stmc", "ppmc312", "pmc006", "bank"))),
    "Predictions": ("openppmc.model.single.predict", *(f"openppmc.model.{part}.carrier" for part in
                    ("ppmc2104", "stmc", "ppmc312"))),
    "Virtual board (Python)": ("openppmc.sim.common.board", "openppmc.sim.common.spec"),
    "Parts and errors": ("openppmc.parts", "openppmc.errors"),
}  # fmt: skip
"""Pages of the API reference: titles and modules."""
SHIM = """(() => { const Own = window.Worker;
SHIM
if (window.Worker !== Own) window.Worker = function (url, options) {
  return new (/^blob:/.test(url) ? Own : window.IFrameWorker)(url, options);
};
})();
"""
"""Shim of the search worker in pages that are opened from a file.

Such pages can start a worker only from a blob. The worker of the playground is already a blob, so the shim
does not replace it.
"""
APP = """---
hide: [navigation, toc, footer]
title: Playground
---

# Playground

<div id="openppmc-playground" markdown="0"><p>The playground needs JavaScript and WebAssembly.</p></div>
<link rel="stylesheet" href="playground/playground.css">
<link rel="preload" as="script" href="playground/parts/ppmc104.js">
<script>document.body.classList.add("playground-page")</script>
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
    (PAGES / "iframe-worker.js").write_text(SHIM.replace("SHIM", shim), encoding="utf-8")
    folder = PAGES / "api"
    folder.mkdir()
    rows = []
    for number, (title, modules) in enumerate(API.items()):
        entries = "\n".join(f"\n::: {module}\n" for module in modules)
        (folder / f"{number}.md").write_text(f"# {title}\n{entries}", encoding="utf-8")
        rows.append(f"- [{title}]({number}.md)")
    head = "# Python API\n\nFrom the docstrings of the package; [how to use it](../docs/host.md).\n\n"
    (folder / "index.md").write_text(head + "\n".join(rows) + "\n", encoding="utf-8")


def browser() -> bool:
    """Return whether PDFs can be made; print the reason if they cannot be made."""
    try:
        packages(SITE / "browser")
        node("node", "pdf.mjs", str(HTML), folder=SITE / "browser")
    except ProjectError as error:
        print(f"no PDFs of the manuals, because there is no browser: {error}")
        return False
    return True


def build(with_pdf: bool = True, out: Path = HTML) -> Path:
    """Build the whole site in `out`; raise ProjectError with the first warning of MkDocs."""
    stage()
    if with_pdf:
        say("browser for the data sheets as PDF")
    pdf = with_pdf and browser()
    say("all pages, with MkDocs")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--clean"]
    command += ["-f", str(SITE / "mkdocs.yml"), "-d", str(out)]
    env = {**os.environ, **({PDF: "1"} if pdf else {})}
    done = subprocess.run(command, cwd=ROOT, env=env, capture_output=True, text=True, check=False)
    log = wasm.OUT / "mkdocs.log"
    log.write_text(done.stdout + done.stderr, encoding="utf-8")
    if done.returncode:
        wrong = [line for line in done.stderr.splitlines() if line.startswith(("WARNING", "ERROR"))]
        raise ProjectError(f"{wrong[0] if wrong else 'MkDocs failed'} (the whole log: {relative(log)})")
    if pdf:
        say("data sheets as PDF")
        (out / "pdf").mkdir()
        jobs = [f"docs/{part}/index.html={data_sheet(part)}" for part in PARTS]
        node("node", "pdf.mjs", str(out), *jobs, folder=SITE / "browser")
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
    sys.exit(run(main))
