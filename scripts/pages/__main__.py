"""Generate the pictures of docs/ (WaveDrom JSON and plots, in docs/<part>/img/) and the tables of manuals.

`python -m scripts.pages` (`make docs`) writes the files. `--check` writes nothing; it lists outdated files
and exits with 1 if there are any. Each run generates identical files.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from cocotb_tests.harness.project import DOCS, ProjectError, console, fail, relative, replace_between, run
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


def stale(files: dict[Path, bytes]) -> list[Path]:
    """Return the generated files that are missing or differ, and pictures without a source."""
    changed = [path for path, content in files.items() if not path.is_file() or path.read_bytes() != content]
    kept = sorted(DOCS.glob("**/img/*.svg"))
    kept += sorted(wiring.FOLDER.glob("*.md"))
    return changed + [path for path in kept if path not in files]


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; return the exit code."""
    parser = argparse.ArgumentParser(prog="docs", description="Generate the pictures and tables of docs/.")
    parser.add_argument("--check", action="store_true", help="write nothing, fail if a file is outdated")
    check = parser.parse_args(arguments).check
    try:
        files = wanted()
    except ProjectError as error:
        return fail(str(error))
    found = stale(files)
    for path in found:
        console.print(
            f"{'outdated' if check else 'written' if path in files else 'removed'}: {relative(path)}"
        )
    if check:
        console.print(f"{len(files)} generated files, {len(found)} outdated")
        return 1 if found else 0
    for path in found:
        if path in files:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(files[path])
        else:
            path.unlink()
    console.print(f"{len(files)} generated files, {len(found)} changed")
    return 0


if __name__ == "__main__":
    sys.exit(run(main))
