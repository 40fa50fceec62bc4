"""Redraw the pictures of docs/: WaveDrom JSON and plots to docs/<part>/img/, computed tables into the manual.

``python scripts/docs.py`` (or ``make docs``) writes; ``--check`` writes nothing, lists what is stale and
exits with 1 if anything is. The files are the same byte for byte on each run.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

from cocotb_tests.harness.project import DOCS, ProjectError, console, fail, relative, replace_between  # noqa: E402
from scripts.pictures import house, plots, tables, waves
from scripts.pmc006 import currents
from scripts.pmc006 import diagram as diagram_006
from scripts.pmc006 import plots as plots_006
from scripts.pmc006 import tables as tables_006
from scripts.ppmc312 import diagram as diagram_312
from scripts.ppmc312 import plots as plots_312
from scripts.ppmc312 import tables as tables_312
from scripts.ppmc312 import waves as waves_312
from scripts.stmc import plots as plots_stmc
from scripts.stmc import tables as tables_stmc
from scripts.stmc import waves as waves_stmc

# Tables inside hand-written pages: page -> marker -> text.
TABLES: dict[str, dict[str, Callable[[], str]]] = {
    "ppmc104/README.md": {"speed-table": tables.speed_table_104},
    "ppmc2104/README.md": {"speed-table": tables.speed_table_2104},
    "stmc/README.md": {
        "speed-table": tables_stmc.speed_table,
        "ramp-table": tables_stmc.ramp_table,
        "moves-table": tables_stmc.moves_table,
        "times-table": tables_stmc.times_table,
    },
    "ppmc312/README.md": {
        "table-table": tables_312.table_table,
        "moves-table": tables_312.moves_table,
        "times-table": tables_312.times_table,
    },
    "pmc006/README.md": {
        "moves-table": tables_006.moves_table,
        "currents-table": currents.currents_table,
        "times-table": tables_006.times_table,
    },
}
PLOTS = {
    **house.PLOTS,
    **diagram_312.PLOTS,
    **diagram_006.PLOTS,
    **plots.PLOTS,
    **plots_stmc.PLOTS,
    **plots_312.PLOTS,
    **plots_006.PLOTS,
    **currents.PLOTS,
}
DIAGRAMS = {**waves_stmc.DIAGRAMS, **waves_312.DIAGRAMS}


def image(name: str) -> Path:
    """Where the picture "<part>/<what>", or "<what>" of pages about the whole, stands."""
    part, _, what = name.rpartition("/")
    return DOCS / part / "img" / f"{what}.svg"


def wanted() -> dict[Path, bytes]:
    """Path and content of every generated file of docs/."""
    files: dict[Path, bytes] = {}
    for source in sorted(DOCS.glob("*/wavedrom/*.json")):
        try:
            files[source.parents[1] / "img" / f"{source.stem}.svg"] = waves.render(source)
        except ValueError as error:
            raise ProjectError(str(error)) from None
    for name, diagram in DIAGRAMS.items():
        files[image(name)] = waves.draw(diagram(), name)
    for name, plot in PLOTS.items():
        files[image(name)] = plots.render(plot)
    for page, wanted_tables in TABLES.items():
        text = (DOCS / page).read_text(encoding="utf-8")
        for marker, table in wanted_tables.items():
            text = replace_between(text, marker, table())
        files[DOCS / page] = text.encode()
    return files


def stale(files: dict[Path, bytes]) -> list[Path]:
    """Generated files that are missing or differ, and pictures of a part that have lost their source."""
    changed = [path for path, content in files.items() if not path.is_file() or path.read_bytes() != content]
    kept = sorted(DOCS.glob("**/img/*.svg"))
    return changed + [path for path in kept if path not in files]


def main(arguments: list[str] | None = None) -> int:
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(prog="docs", description="Redraw the pictures of docs/.")
    parser.add_argument("--check", action="store_true", help="change nothing, fail if something is stale")
    check = parser.parse_args(arguments).check
    try:
        files = wanted()
    except ProjectError as error:
        return fail(str(error))
    found = stale(files)
    for path in found:
        console.print(f"{'stale' if check else 'written' if path in files else 'removed'}: {relative(path)}")
    if check:
        console.print(f"{len(files)} generated files, {len(found)} stale")
        return 1 if found else 0
    for path in found:
        if path in files:
            path.parent.mkdir(exist_ok=True)
            path.write_bytes(files[path])
        else:
            path.unlink()
    console.print(f"{len(files)} generated files, {len(found)} changed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
