"""Post-route timing of the bitstreams: `python -m scripts.fpga.flow.timing [FOLDER]`.

The script copies the clock rate and the seed of each bitstream from its report.json into docs/timing.json.
`make bitstream` and `make release` write the reports, for the seed whose bitstream they keep. The script
ignores reports of changed sources or with parameters. `make boards` writes the table in docs/boards.md.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from cocotb_tests.harness import project
from cocotb_tests.harness.project import console
from scripts.fpga.boards.tables import TIMING
from scripts.fpga.flow.board_table import BY_PART
from scripts.fpga.flow.boards import inputs_digest


def current(folder: Path) -> dict[str, dict[str, Any]]:
    """Return the figures of all reports below a folder that belong to the current sources."""
    found = {}
    for on in (on for boards in BY_PART.values() for on in boards.values()):
        for host in on.top:
            path = folder / on.stem(host) / "report.json"
            if not path.is_file():
                continue
            report = json.loads(path.read_text(encoding="utf-8"))
            if report["params"] or report["inputs"] != inputs_digest(on, host):
                console.print(f"left out: {path} has other sources or parameters")
                continue
            found[on.stem(host)] = {"mhz": report["fmax"], "seed": report["seed"], "of": report["inputs"]}
    return found


def text_of(figures: dict[str, dict[str, Any]]) -> str:
    """Return the text of docs/timing.json, one bitstream a line."""
    rows = (f"  {json.dumps(name)}: {json.dumps(figures[name])}" for name in sorted(figures))
    return "{\n" + ",\n".join(rows) + "\n}\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m scripts.fpga.flow.timing", description=(__doc__ or "").splitlines()[0]
    )
    parser.add_argument("folder", nargs="?", type=Path, default=project.BUILD / "boards")
    new = current(parser.parse_args(arguments).folder)
    known = json.loads(TIMING.read_text(encoding="utf-8")) if TIMING.is_file() else {}
    TIMING.write_text(text_of(known | new), encoding="utf-8")
    console.print(f"{len(new)} bitstreams measured; run `make boards`")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
