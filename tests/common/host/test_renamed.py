"""Old public names emit a warning and return the object of the new name; this tree uses no old name."""

from __future__ import annotations

import re
import subprocess
import warnings
from importlib import import_module
from types import SimpleNamespace
from typing import Any

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc import host
from openppmc.host.bank.part import PpmcBank
from openppmc.host.check import Checked
from openppmc.host.errors import UnknownAttributeError
from openppmc.host.line_port import Counters
from openppmc.host.motion import Handle, Progress
from openppmc.host.motion_result import Cause, EndUnknown, MotionError, MotionResult
from openppmc.host.part import Device
from openppmc.host.pmc006.part import ScanResult as ScanResult006
from openppmc.host.ppmc312.core import Core
from openppmc.host.ppmc312.line.bus import ScanResult as ScanResult312
from openppmc.host.ppmc2104.part import Ppmc2104
from openppmc.host.speeds import BaseClock
from openppmc.lazy import Renamed

CLASSES = {
    "BadRamp": "InvalidRamp",
    "BadSwitching": "InvalidChopperTimes",
    "CutCommand": "IncompleteCommand",
    "End": "MotionResult",
    "Misused": "NotCalledError",
    "NoSuchName": "UnknownAttributeError",
    "NotWhileBusy": "AxisBusy",
    "StoppedEarly": "StoppedByCommand",
    "TooFast": "RateLimitExceeded",
    "UnknownCode": "UnknownCommand",
}
"""Names of `openppmc.host`: old and new."""
IN_MODULES = {
    "errors": ("NoSuchName", "Misused", "NotWhileBusy", "BadRamp", "UnknownCode"),
    "motion_result": ("End", "StoppedEarly"),
    "ppmc2104.registers": ("CutCommand", "BadSwitching", "TooFast"),
}
OTHERS = {
    ("line", "StationSilent"): "StationNotResponding",
    ("line", "GarbledReply"): "CorruptReply",
    ("ppmc312.errors", "OutOfTurn"): "UnexpectedInstruction",
    ("ppmc312.errors", "BadBlock"): "InvalidBlockLength",
    ("pmc006.wire", "LockedByExt"): "ExtStopActive",
    ("pmc006.wire", "MotorFree"): "MotorDisabled",
    ("pmc006.wire", "ProgramDiffers"): "ProgramVerifyFailed",
}
"""Names that only modules have."""
MODULES = OTHERS | {(place, name): CLASSES[name] for place, names in IN_MODULES.items() for name in names}
METHODS = [
    (Device, "attend", "process_reports"),
    (Core, "attend", "process_reports"),
    (Ppmc2104, "together", "move_together"),
    (Ppmc2104, "start_together", "start_moves"),
    (PpmcBank, "together", "move_together"),
    (PpmcBank, "start_together", "start_moves"),
    (PpmcBank, "look", "snapshot"),
    (Handle, "end", "result"),
    (Handle, "asked", "requested"),
]
RESULT = MotionResult(Cause.STOP, 3, 2, 7, 0)
VALUES = [
    (RESULT, "left", "remaining"),
    (MotionError("", RESULT), "end", "result"),
    (EndUnknown("", "", None, 3, 5), "asked", "requested"),
    (Progress(7, 3, 5, 0.1), "made", "done"),
    (Progress(7, 3, 5, 0.1), "asked", "requested"),
    (BaseClock.external_pin(100_000).choose(1000), "asked", "requested"),
    (ScanResult312(1, 2, None, None, None, Counters(), "noise"), "trouble", "problem"),
    (ScanResult006(1, None, None, None, None, Counters(), "noise"), "trouble", "problem"),
]
USED = sorted({*CLASSES, *(name for _, name in OTHERS)} - {"End"})


@pytest.mark.parametrize(("old", "new"), CLASSES.items())
def test_a_class_of_the_package_warns(old: str, new: str) -> None:
    """Each use of an old class name of the package emits one warning and returns the class."""
    with pytest.warns(DeprecationWarning) as seen:
        found = getattr(host, old)
    assert found is getattr(host, new)
    (warning,) = seen
    assert str(warning.message).startswith(f"openppmc.host.{old} is now {new};")
    assert warning.filename == __file__
    assert old not in dir(host) and old not in host.__all__


@pytest.mark.parametrize(("place", "new"), MODULES.items(), ids=lambda one: str(one))
def test_a_class_of_a_module_warns(place: tuple[str, str], new: str) -> None:
    """Each use of an old class name of a module emits one warning and returns the class."""
    module = import_module(f"openppmc.host.{place[0]}")
    with pytest.warns(DeprecationWarning, match=f"{place[1]} is now {new};") as seen:
        assert getattr(module, place[1]) is getattr(module, new)
    assert len(seen) == 1
    with pytest.raises(AttributeError, match="has no attribute 'no_such_name'"):
        module.no_such_name  # noqa: B018


@pytest.mark.parametrize(("owner", "old", "new"), METHODS)
def test_an_attribute_of_a_driver_warns(owner: type, old: str, new: str) -> None:
    """The old name of a method or attribute of a driver emits a warning and returns the method or attribute
    with the new name; each new name exists.
    """
    alias = owner.__dict__[old]
    assert isinstance(alias, Renamed)
    assert hasattr(owner, new) or new in owner.__annotations__
    one: Any = SimpleNamespace(**{new: object()})
    with pytest.warns(DeprecationWarning, match=f"^{owner.__name__}.{old} is now {new};") as seen:
        assert alias.__get__(one, owner) is getattr(one, new)
    assert len(seen) == 1


@pytest.mark.parametrize(("one", "old", "new"), VALUES, ids=lambda one: one if isinstance(one, str) else "")
def test_an_attribute_of_a_result_warns(one: Any, old: str, new: str) -> None:
    """The old name of an attribute of a result emits a warning and returns the value of the attribute with
    the new name.
    """
    with pytest.warns(DeprecationWarning, match=f"^{type(one).__name__}.{old} is now {new};") as seen:
        assert getattr(one, old) is getattr(one, new)
    assert len(seen) == 1 and seen[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        getattr(one, new)


def test_an_old_name_cannot_be_set() -> None:
    """An assignment to an old name fails and names the new one; a hint never contains an old name."""

    class Driver(Checked):
        together = Renamed("move_together")

        def move_together(self) -> None:
            """Move."""

    with pytest.raises(UnknownAttributeError, match="^Driver: 'together' is now 'move_together'$"):
        Driver().together = 1
    with pytest.raises(
        UnknownAttributeError, match="^Driver has no attribute 'togethr': do you mean 'move_together'.$"
    ):
        Driver().togethr = 1  # type: ignore[attr-defined]


def test_no_file_uses_an_old_name() -> None:
    """The old class names occur only in the tables of old names, this test, decisions and the changelog."""
    words = [part for name in USED for part in ("-e", name)]
    places = ("openppmc", "cocotb_tests", "tests", "scripts", "examples", "docs", "README.md")
    command = [
        "git",
        "grep",
        "-nIw",
        *words,
        "--",
        *places,
        ":!docs/decisions",
        ":!tests/common/host/test_renamed.py",
    ]
    done = subprocess.run(command, cwd=ROOT, encoding="utf-8", capture_output=True, check=False)
    if done.returncode not in (0, 1):
        pytest.skip("the tree is no git checkout")
    table = re.compile(r'^[^:]+\.py:\d+: +"(\w+)": "\w+",$|^[^:]+\.py:\d+:.*renamed\(')
    assert [line for line in done.stdout.splitlines() if not table.match(line)] == []
