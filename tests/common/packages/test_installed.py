"""Dependencies of the installed package: models and library need no package, extras are optional."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest

from cocotb_tests.harness.paths import ROOT
from openppmc import errors
from openppmc.errors import MissingExtraError, needs

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
README = (ROOT / PROJECT["readme"]).read_text(encoding="utf-8")
FOREIGN = """
import sys
sys.path.insert(0, sys.argv[1])
{code}
roots = {{name.partition(".")[0] for name in sys.modules}}
print(*sorted(roots - sys.stdlib_module_names - {{"openppmc", "__main__"}}))
"""
MODULE_OF = {"pyvcd": "vcd", "PyYAML": "yaml"}


def foreign(code: str, *flags: str) -> list[str]:
    """Run code without the packages of this environment; return the loaded modules outside the standard
    library.
    """
    words = [sys.executable, "-I", *flags, "-c", FOREIGN.format(code=code), str(ROOT)]
    done = subprocess.run(words, text=True, capture_output=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()[-1].split()


PURE = {
    "models": "import openppmc.model, openppmc.parts",
    "predict": "from openppmc.model import predict_move; assert predict_move(bytes((9, 4, 4, 0)), 14)",
    "predict of the PPMC-312": "import openppmc.model.ppmc312.carrier",
    "host": "import openppmc.host, openppmc.host.selftest.run, openppmc.check",
    "decode": "import openppmc.capture.common.files, openppmc.capture.common.compare",
    "every driver": "from openppmc.parts import PARTS, LAYER_OF\n"
    "for row in PARTS.values():\n"
    "    for column in ('model', 'predict', 'driver', 'capabilities', 'selftest', 'decode'):\n"
    "        getattr(row, column) and row.load(column)",
    "a move on the model": "from openppmc.host import Ppmc104\n"
    "with Ppmc104.open('model:') as axis:\n"
    "    axis.initialise(start_pps=1000, high_pps=8000, ramp_pulses=40)\n"
    "    axis.move(10)",
}


@pytest.mark.parametrize("code", PURE.values(), ids=PURE)
def test_needs_the_standard_library_only(code):
    """In a Python without packages, models, library and decoders load, and load only the standard library."""
    assert foreign(code, "-S") == []


def test_foreign_modules_are_seen():
    """The test above detects a module that is not in the standard library."""
    assert foreign("import sys, types\nsys.modules['serial.rs485'] = types.ModuleType('x')", "-S") == [
        "serial"
    ]


COMMANDS = """
from openppmc.cli.app import Commands
for row in Commands.rows:
    row.load()
"""


def test_commands_load_what_always_comes_along_only():
    """The command line loads typer, rich and their dependencies, but no package of an extra."""
    extras = {
        MODULE_OF.get(name, name)
        for extra in PROJECT["optional-dependencies"].values()
        for name in (re.split(r"\W", text)[0] for text in extra)
    }
    assert extras == {"caproto", "litex", "matplotlib", "migen", "numpy", "ophyd", "vcd", "yaml"}
    assert not (extras | {"serial"}) & set(foreign(COMMANDS))


def test_missing_extra_is_one_line(monkeypatch):
    """If a package of an extra is missing, one line names it and the command to type."""
    monkeypatch.setattr(errors, "find_spec", lambda module: None if module == "vcd" else object())
    needs("plot", "a plot", "matplotlib")
    with pytest.raises(MissingExtraError, match=r"^a plot needs vcd, .*pip install 'openppmc\[plot\]'$"):
        needs("plot", "a plot", "matplotlib", "vcd")


@pytest.mark.parametrize(
    "extra",
    re.findall(
        r'needs\(\s*"(\w+)"',
        "".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "openppmc").rglob("*.py"))),
    ),
)
def test_every_extra_that_is_asked_for_exists(extra):
    """Each extra that the code refers to exists in pyproject.toml."""
    assert extra in PROJECT["optional-dependencies"]


def test_readme_of_the_package_stands_alone():
    """The page for the package index has no links into the tree, and its Python examples run."""
    links = re.findall(r"\]\(([^)\s]+)\)", README)
    assert all(re.match(r"https://", link) for link in links)
    blocks = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    assert len(blocks) == 2
    for block in blocks:
        exec(compile(block, "README.md", "exec"), {})
