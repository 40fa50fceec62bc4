"""Measure one command or import in a process that has not loaded any module yet; print one JSON object.

    python -m tests.common.ways modules CODE          modules of the project that CODE loads
    python -m tests.common.ways files WORD...         files whose functions `openppmc WORD...` enters
    python -m tests.common.ways frames WORD...        frames of its deepest call of `Link._run`

The module imports only the standard library, so that no module is loaded before the count begins.
"""

from __future__ import annotations

import json
import sys
import threading
import traceback
from pathlib import Path
from types import FrameType
from typing import Any

ROOT = Path(__file__).parents[2]


def modules(code: str) -> list[str]:
    """Return the names of the modules of `openppmc` and `cocotb_tests` that the code loads."""
    exec(compile(code, "ways", "exec"), {"__name__": "ways"})
    return sorted(name for name in sys.modules if name.partition(".")[0] in ("openppmc", "cocotb_tests"))


def files(words: list[str]) -> list[str]:
    """Return the files of `openppmc`, relative to the root, in which a function is entered after import."""
    root, entered, importing = f"{ROOT / 'openppmc'}/", set(), 0

    def profile(frame: FrameType, event: str, _: Any) -> None:
        nonlocal importing
        if frame.f_code.co_name == "<module>":
            importing += {"call": 1, "return": -1}.get(event, 0)
        elif event == "call" and not importing and frame.f_code.co_filename.startswith(root):
            entered.add(frame.f_code.co_filename)

    from openppmc.cli import main

    sys.setprofile(profile)
    threading.setprofile(profile)
    status = main(words)
    sys.setprofile(None)
    assert status == 0, words
    return sorted(str(Path(name).relative_to(ROOT)) for name in entered)


def frames(words: list[str]) -> list[list[str]]:
    """Return the file and the function of each frame of the project between `main` and the deepest
    `Link._run`.
    """
    from openppmc.cli import main
    from openppmc.host import Link

    run, root, deepest = Link._run, f"{ROOT / 'openppmc'}/", []

    def _run(*values: Any, **words: Any) -> Any:
        nonlocal deepest
        calls = (frame for frame, _ in traceback.walk_stack(sys._getframe()))
        stack = [frame for frame in calls if frame.f_code.co_filename.startswith(root)]
        if len(stack) >= len(deepest):
            deepest = [*((one.f_code.co_filename, one.f_code.co_name) for one in reversed(stack))]
        return run(*values, **words)

    Link._run = _run  # type: ignore[method-assign]
    status = main(words)
    assert status == 0 and deepest, words
    made = [[str(Path(name).relative_to(ROOT)), function] for name, function in deepest]
    return [*made, [str(Path(run.__code__.co_filename).relative_to(ROOT)), "_run"]]


if __name__ == "__main__":
    way, *rest = sys.argv[1:]
    standard, sys.stdout = sys.stdout, sys.stderr
    found = modules(*rest) if way == "modules" else {"files": files, "frames": frames}[way](rest)
    print(json.dumps(found), file=standard, flush=True)  # an error of the last write must not be lost at exit
