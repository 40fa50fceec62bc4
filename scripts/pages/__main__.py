"""Generate the pictures of docs/ (WaveDrom JSON and plots, in docs/<part>/img/) and the tables of manuals.

`python -m scripts.pages` (`make docs`) writes the files. `--check` writes nothing; it lists outdated files
and exits with 1 if there are any. Each run generates identical files.
"""

from __future__ import annotations

import sys
from pathlib import Path

from cocotb_tests.harness.project import DOCS, ProjectError, replace_between, run
from scripts import generated
from scripts.measure.prove import page as proofs
from scripts.measure.sizes import figures, size_page
from scripts.pages.figures import pages
from scripts.pages.pictures import waves
from scripts.pages.wiring import pages as wiring


def wanted() -> dict[Path, bytes]:
    """Return path and content of every generated file of docs/."""
    files: dict[Path, bytes] = {}
    for source in sorted(DOCS.glob("*/wavedrom/*.json")):
        try:
            files[source.parents[1] / "img" / f"{source.stem}.svg"] = waves.render(source)
        except ValueError as error:
            raise ProjectError(str(error)) from None
    for source in sorted(DOCS.glob("**/figures.yml")):
        files |= pages(str(source.parent.relative_to(DOCS)))
    page = DOCS / "benchmarks.md"
    text = page.read_text(encoding="utf-8")
    measured = figures.read()
    for marker, block in size_page.BLOCKS.items():
        text = replace_between(text, marker, block(measured))
    files[page] = text.encode()
    files |= wiring.pages()
    files[proofs.PAGE] = proofs.text().encode()
    return files


def unused(files: dict[Path, bytes]) -> list[Path]:
    """Return the existing pictures and board pages that are no longer generated."""
    kept = [*sorted(DOCS.glob("**/img/*.svg")), *sorted(wiring.FOLDER.glob("*.md"))]
    return [path for path in kept if path not in files]


def main() -> int:
    """Run the command line; return the exit code."""
    check = generated.parser("docs", "Generate the pictures and tables of docs/.").parse_args().check
    files = wanted()
    return generated.update("docs", files, check, unused(files))


if __name__ == "__main__":
    sys.exit(run(main))
