"""`make replay FILE=…/recording.json`: repeat the recording of a failed test on RTL and golden model.

RTL and golden model are reset and receive the pin changes in the file, and every output edge is compared. If
there is a difference, the exit code is 1, and the folder of the run contains the waveforms.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from cocotb_tests.harness.project import console, run
from cocotb_tests.harness.random_items import replay_item, replay_line
from cocotb_tests.harness.replay import REPLAY
from cocotb_tests.harness.runner import attempt
from cocotb_tests.harness.simulate import REPRO
from openppmc.check.records import Recording


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line, which names the file; return the exit code."""
    given = sys.argv[1:] if arguments is None else list(arguments)
    file = Path(given[0] if given else "")
    try:
        recording = Recording.from_json(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, KeyError, TypeError) as error:
        console.print(f"error: FILE={file}: not a recording ({error})", markup=False)
        return 2
    env = {REPLAY: str(file.resolve()), REPRO: replay_line(file)}
    if message := attempt(replay_item(recording), env=env):
        console.print(message, markup=False)
        return 1
    console.print(f"all output edges up to edge {recording.end} equal the golden model")
    return 0


if __name__ == "__main__":
    sys.exit(run(main))
