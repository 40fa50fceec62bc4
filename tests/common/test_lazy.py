"""Packages that import a name only when it is first used: those of `openppmc`, and the test harness."""

from __future__ import annotations

import ast
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from cocotb_tests.harness.paths import ROOT

PACKAGES = ("openppmc.host", "openppmc.model", "openppmc.sim")
LAZY = (*PACKAGES, "cocotb_tests.harness")


def written_out(package: str) -> dict[str, tuple[str, str]]:
    """Return public name -> (module, name), read from the imports under `TYPE_CHECKING`."""
    tree = ast.parse((ROOT / package.replace(".", "/") / "__init__.py").read_text(encoding="utf-8"))
    (block,) = (node for node in tree.body if isinstance(node, ast.If))
    imports = [node for node in block.body if isinstance(node, ast.ImportFrom)]
    assert imports and len(imports) == len(block.body)
    return {
        name.asname or name.name: (f".{node.module or ''}", name.name)
        for node in imports
        for name in node.names
    }


@pytest.mark.parametrize("package", LAZY)
def test_names_are_those_of_the_imports_written_out(package: str) -> None:
    """`__all__` contains exactly the names imported for type checkers, and each of them is the object of that
    name in its module.
    """
    module, names = import_module(package), written_out(package)
    assert sorted(names) == sorted(module.__all__)
    for public, (place, own) in names.items():
        found = import_module(f"{package}.{own}") if place == "." else None
        assert getattr(module, public) is (found or getattr(import_module(place, package), own))
    assert {*names} <= {*dir(module)}


@pytest.mark.parametrize("package", PACKAGES)
def test_a_name_needs_no_name_before_it(package: str) -> None:
    """Each public name, and each module of the package, can be the first import of a program."""
    folder = ROOT / package.replace(".", "/")
    modules = sorted(
        ".".join(path.relative_to(ROOT).with_suffix("").parts)
        for path in folder.rglob("*.py")
        if path.name not in ("__init__.py", "__main__.py")
    )
    lines = [f"from {package} import {name}" for name in written_out(package)]
    lines += [f"import {module}" for module in modules]
    code = (
        "import sys\n"
        f"for line in {lines!r}:\n"
        "    for name in [name for name in sys.modules if name.partition('.')[0] == 'openppmc']:\n"
        "        del sys.modules[name]\n"
        "    exec(line)\n"
    )
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, timeout=120)


def test_an_unknown_name_is_an_attribute_error() -> None:
    """A wrong name raises the errors of a normal module, also in `hasattr` and `from … import`."""
    host = import_module("openppmc.host")
    assert not hasattr(host, "Ppmc105")
    with pytest.raises(AttributeError, match=r"^module 'openppmc\.host' has no attribute 'Ppmc105'$"):
        host.Ppmc105  # noqa: B018
    with pytest.raises(ImportError, match="cannot import name 'Ppmc105'"):
        exec("from openppmc.host import Ppmc105")


def test_a_name_is_looked_up_once() -> None:
    """The first use of a name stores it in the package."""
    host = import_module("openppmc.host")
    vars(host).pop("Ppmc104", None)
    assert host.Ppmc104 is vars(host)["Ppmc104"]


def test_type_checkers_refuse_a_wrong_name(tmp_path: Path) -> None:
    """mypy resolves the names of a lazy package and reports the import of an unknown name."""
    pytest.importorskip("mypy", reason="mypy is not installed; run make setup")
    names = {package: next(iter(written_out(package))) for package in PACKAGES}
    program = tmp_path / "program.py"
    lines = [f"from {package} import {name}, {name}x\n" for package, name in names.items()]
    program.write_text("".join(lines), encoding="utf-8")
    words = [sys.executable, "-m", "mypy", "--config-file", "", "--follow-imports=silent", str(program)]
    done = subprocess.run(words, cwd=ROOT, text=True, capture_output=True, check=False, timeout=300)
    errors = [line for line in done.stdout.splitlines() if "error:" in line]
    assert len(errors) == len(names), done.stdout + done.stderr
    for name, error in zip(names.values(), errors, strict=True):
        assert f'has no attribute "{name}x"' in error
