"""What a failing random run says beside its message: the shortest list of acts found that still fails."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from . import mutant
from .build import Design, SimError, part_design
from .collect import Item
from .config import Config
from .paths import FAILURES, relative
from .replaying import REPLAY, WORDS
from .runner import SimOptions, attempt, run_sim
from .simulate import safe
from .stimulus import Recording

MODULE = "cocotb_tests.harness.replaying"


def attempt_random(
    item: Item,
    options: SimOptions | None = None,
    env: Mapping[str, str] | None = None,
    design: Design | None = None,
) -> str:
    """As `attempt`; the message of a failing run ends with its short list, found on the part alone."""
    message = attempt(item, options, env, design)
    if not message or mutant.present():
        return message
    seed = options.seed if options and options.seed is not None else item.seed
    return f"{message}\n{shortened(FAILURES / f'{safe(item.id)}-s{seed}')}"


def replay_item(recording: Recording, test: str = "replay") -> Item:
    """The simulation that carries out a recording, in the build that it was made in."""
    known = {"clk_hz", "xtal_hz", "timing", "phase_idle"}
    params = {name.lower(): value for name, value in recording.params.items()}
    given = {name: value for name, value in params.items() if name in known}
    more = tuple((name.upper(), value) for name, value in params.items() if name not in known)
    config = Config("replay", **given, extra=more)  # type: ignore[arg-type]
    return Item(MODULE, test, config, recording.part, (), recording.seed)


def replay_line(file: Path) -> str:
    """The line that carries out a recording again."""
    return f"make replay FILE={relative(file)}"


def shortened(folder: Path, design: Design | None = None) -> str:
    """The short list in words, from the recording that a failing run has left in its folder.

    `design` (default: the recorded part) is what is simulated. The files are in the folder `short` of it.
    """
    file, short = folder / "recording.json", folder / "short"
    if not file.is_file():
        return "not shrunk: no difference from the golden model was recorded"
    item = replay_item(Recording.from_json(file.read_text(encoding="utf-8")), "shrink")
    line = replay_line(short / "recording.json")
    trouble = ""
    try:
        design = design or part_design(item.part, item.config)
        run_sim(design, item, item.seed, env={REPLAY: str(file.resolve())}, folder=short, repro=line)
    except SimError as error:  # an assertion of the RTL, the limit of time: the best so far is on file
        trouble = str(error).splitlines()[0]
    words = short / WORDS
    if not words.is_file():
        return f"not shrunk: {trouble}"
    text = words.read_text(encoding="utf-8")
    if not (short / "recording.json").is_file():
        return text
    cut = f"\n(the search ended early: {trouble})" if trouble else ""
    return f"{text}{cut}\nlist and recording in {relative(short)}, carried out again by: {line}"
