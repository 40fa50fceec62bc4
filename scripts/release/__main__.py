"""`make release [SKIP=…] [ONLY=…]`: build all files of this version in dist/, or none if a step fails."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError, console, relative
from scripts.release import arduino, bitstreams, notes, python, site, sources, verilog
from scripts.release.state import Release, current_release
from scripts.site.hooks import PARTS

DIST = project.ROOT / "dist"
SCRATCH = project.BUILD / "release"
SLOW = ("bitstreams", "site")
"""Steps that the variable SKIP may omit if the release is only a trial."""


Job = Callable[[Release, Path, Path], None]
"""Function that writes files to the first folder and uses the second folder for temporary files."""


def jobs(say: Callable[[str], None]) -> dict[str, Job]:
    """Return the function of each step, by its name. The fast steps are first, the release notes last."""
    from scripts.release import sbom
    from scripts.site import sheets

    def data_sheets(release: Release, out: Path, scratch: Path) -> None:
        for part in PARTS:
            (out / release.name(part, ".pdf")).write_bytes(sheets.make(part, release.version))

    return {
        "python": python.make,
        "rtl": sources.make,
        "arduino": arduino.make,
        "verilog": verilog.make,
        "sbom": sbom.make,
        "data sheets": data_sheets,
        "site": lambda release, out, scratch: site.make(release, out, scratch, say),
        "bitstreams": lambda release, out, scratch: bitstreams.make(release, out, scratch, say),
        "notes": notes.make,
    }


def build(release: Release, skip: set[str], dist: Path = DIST, scratch: Path = SCRATCH, made_by=jobs) -> None:
    """Run all steps in a folder in `scratch`. After the last step, this folder becomes `dist`."""
    shutil.rmtree(scratch, ignore_errors=True)
    out = scratch / "dist"
    out.mkdir(parents=True)
    # Set the time that tools write (setuptools, MkDocs), and the modes of files.
    os.environ["SOURCE_DATE_EPOCH"] = str(release.epoch)
    os.umask(0o022)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as progress:
        task = progress.add_task("release")

        def say(text: str) -> None:
            progress.update(task, description=text)
            if not console.is_terminal:
                console.print(text)

        todo = {name: make for name, make in made_by(say).items() if name not in skip}
        release.missing += [f"The {name}: left out (SKIP)." for name in SLOW if name in skip]
        progress.update(task, total=len(todo))
        for name, make in todo.items():
            say(name)
            folder = scratch / name
            folder.mkdir()
            make(release, out, folder)
            progress.advance(task)
    shutil.rmtree(dist, ignore_errors=True)
    out.rename(dist)


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m scripts.release", description=__doc__)
    parser.add_argument("--skip", default="", help=f"for a trial: {', '.join(SLOW)}")
    parser.add_argument("--only", default="", help="for a trial: names of bitstreams, separated by commas")
    args = parser.parse_args()
    skip = set(args.skip.replace(",", " ").split())
    if strange := sorted(skip - set(SLOW)):
        raise ProjectError(f"SKIP={strange[0]}: expected {' or '.join(SLOW)}")
    only = tuple(args.only.replace(",", " ").split())
    bitstreams.selected(only)
    trial = bool(skip or only)
    release = current_release(only, trial)
    if "site" not in skip:
        site.check()
    build(release, skip)
    for path in sorted(DIST.iterdir()):
        console.print(f"{path.stat().st_size:>12,}  {relative(path)}")
    if trial:
        console.print(f"This is a trial (SKIP or ONLY), version {release.version}: do not publish it.")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
