"""What cocotb needs of pytest, for simulations: half of the time that one takes to start is the real one's.

The folder of this file is the first one on a simulation's path. Whoever asks for anything else gets the real
pytest, and so does the second run of a failing test, which has the values of its assertions from there.
"""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any


class _Never(Exception):  # noqa: N818
    """What nobody raises: tests that fail or skip by themselves use the real pytest."""


raises = skip = xfail = SimpleNamespace(Exception=_Never)

# cocotb imports these names, and does nothing with them when no assertions are to be rewritten.
_STUBS = {"_pytest.assertion": "install_importhook", "_pytest.config": "Config"}
for _module, _attribute in _STUBS.items():
    sys.modules[_module] = ModuleType(_module)
    setattr(sys.modules[_module], _attribute, None)


def __getattr__(name: str) -> Any:
    # cocotb can do without these two, and the import system without its own.
    if name in ("RaisesExc", "RaisesGroup") or name.startswith("__"):
        raise AttributeError(name)
    folder = str(Path(__file__).parent)
    sys.path[:] = [entry for entry in sys.path if entry != folder]
    for module in ("pytest", *_STUBS):
        sys.modules.pop(module, None)
    return getattr(importlib.import_module("pytest"), name)
