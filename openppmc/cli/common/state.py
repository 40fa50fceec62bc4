"""What `init` remembers for each port: the values of the set-up options, in a small JSON file."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path
from typing import Any

from ...errors import PpmcError
from ...host.port import MODEL, SIM


def state_folder() -> Path:
    """Where the files are: $OPENPPMC_STATE, or `openppmc` in the user's folder for program state."""
    own = os.environ.get("OPENPPMC_STATE")
    if own:
        return Path(own)
    if os.name == "nt":
        return Path(os.environ.get("LOCALAPPDATA", Path.home())) / "openppmc"
    return Path(os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state") / "openppmc"


def lasting(port: str) -> bool:
    """Virtual boards are new each time, so nothing is remembered for them."""
    return bool(port) and not f"{port}:".startswith((MODEL, SIM))


def _file(port: str, axis: int) -> Path:
    name = re.sub(r"[^A-Za-z0-9._-]", "_", port.strip("/"))
    return state_folder() / (name + ("" if axis == 1 else f".axis{axis}") + ".json")


def recall(port: str, axis: int = 1) -> dict[str, Any]:
    """Remembered options of an axis, empty if there are none. PpmcError if the file is not readable."""
    path = _file(port, axis)
    if not lasting(port) or not path.is_file():
        return {}
    try:
        values = json.loads(path.read_text(encoding="utf-8"))["setup"]
        if not isinstance(values, dict):
            raise ValueError("no table")
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise PpmcError(
            f"{path}: the remembered set-up cannot be read: delete the file, then run init"
        ) from error
    return values


def remember(port: str, values: dict[str, Any], axis: int = 1) -> None:
    """Keep the options for later commands. PpmcError if the file cannot be written."""
    if not lasting(port):
        return
    path = _file(port, axis)
    text = json.dumps({"port": port, "setup": values}, indent=1) + "\n"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        fresh = path.with_suffix(f".{os.getpid()}")
        fresh.write_text(text, encoding="utf-8")
        fresh.replace(path)
    except OSError as error:
        raise PpmcError(f"{path}: the set-up cannot be remembered ({error.strerror})") from error
