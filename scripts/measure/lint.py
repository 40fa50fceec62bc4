"""`make lint`: every check of the sources; all findings are printed, then one summary line.

With ``--fix`` (`make format`) it formats RTL and Python instead.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import sysconfig
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from importlib.metadata import distributions
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from rich.markup import escape

from cocotb_tests.harness import header, project
from cocotb_tests.harness.project import ProjectError, console, relative
from openppmc.parts import Row, tops
from openppmc.sim.common.build import verilator_command, verilator_environment
from openppmc.sources import needed, walls
from scripts.fpga.flow.boards import HOSTS_OF, parameters
from scripts.fpga.flow.boards import sources as board_sources
from scripts.measure import cdc, prose
from scripts.measure.module_rules import all_findings
from scripts.measure.sizes import figures
from scripts.measure.tables import differences

CLOCKS = (8_000_000, 11_059_200, 16_000_000, 25_000_000, 100_000_000, 200_000_000)
BANKS = (
    (4, 8_000_000, 16_000_000),
    (8, 25_000_000, 12_500_000),
    (16, 54_000_000, 13_500_000),
    (32, 25_000_000, 12_500_000),
    (32, 100_000_000, 16_000_000),
    (64, 200_000_000, 16_000_000),
)
"""Combinations of AXES, CLK_HZ and XTAL_HZ with which a part with many axes is checked (BANK-GEN-02)."""
CONTRACTS = ("--no-logo", "--cache-dir", "build/import-linter")
FORMAT_FLAGS = "--flagfile=.verible-format.flags"
TEXT_SUFFIXES = {".sv", ".svh", ".rdl", ".py", ".sh", ".md", ".yml", ".toml", ".txt", ".vlt", ".json", ".asm"}
TABLES = project.BUILD / "lint" / "tables"
GENERATORS = ("scripts.pages", "scripts.fpga.rom.calc_rom", "scripts.fpga.packages", "scripts.fpga.boards")
"""Modules with an option --check, which lists the outdated files."""
BUILT = {".venv", "build", ".git", "node_modules"}
MARKS = tuple(a + b for a, b in (("TO", "DO"), ("FIX", "ME"), ("XX", "X"), ("HA", "CK")))


@dataclass(frozen=True)
class Check:
    """One check: its tool, its target, and a function for its findings as text ("" for no findings)."""

    tool: str
    target: str
    run: Callable[[], str]


def ran(*command: str, env: dict[str, str] | None = None) -> tuple[int, str]:
    """Run a tool from the project's root; return its exit code and its output."""
    try:
        code, text = project.ran(command, env)
    except FileNotFoundError:
        return 1, f"{command[0]}: not installed (run `make setup`)"
    text = text.strip()
    if code and not text:
        text = f"{Path(command[0]).name} ended with exit code {code}"
    return code, text


def tool(*command: str, ok_output: bool = False, env: dict[str, str] | None = None) -> str:
    """Return the output of a tool. With `ok_output`, the result is "" if the tool succeeds."""
    code, text = ran(*command, env=env)
    return "" if ok_output and not code else text


def module(name: str, *words: str) -> str:
    """Return the output of a Python module if it fails; "" if it succeeds."""
    return tool(sys.executable, "-m", name, *words, ok_output=True)


def rtl_files(*suffixes: str) -> list[str]:
    """Return all SystemVerilog files below rtl/ and tb/formal/, relative to the root."""
    folders = (project.RTL, project.ROOT / "tb" / "formal")
    return sorted(
        relative(path) for suffix in suffixes for room in folders for path in room.rglob(f"*{suffix}")
    )


def python_paths() -> list[str]:
    """Return the folders and files that ruff checks."""
    return [
        name
        for name in ("openppmc", "scripts", "cocotb_tests", "tests", "conftest.py")
        if Path(name).exists()
    ]


def ruff(*arguments: str) -> str:
    """Return ruff's findings in all Python of the project."""
    return tool(sys.executable, "-m", "ruff", *arguments, "-q", *python_paths())


def verible_lint() -> str:
    """Check the style of the RTL."""
    return tool("verible-verilog-lint", "--rules_config=.rules.verible_lint", *rtl_files(".sv", ".svh"))


def verible_format() -> str:
    """Check the format of the RTL; return the files that `make format` would change."""
    text = tool("verible-verilog-format", FORMAT_FLAGS, "--verify", "--inplace", *rtl_files(".sv"))
    return "\n".join(line for line in text.splitlines() if line.strip())


def verilator(top: str, files: list[Path], params: dict[str, int | str]) -> str:
    """Run Verilator -Wall on one top for one set of parameters, with assertions as in simulation.

    Verilator generates C++ in this run, because --lint-only does not detect combinational loops.
    """
    folder = project.BUILD / "lint" / "-".join([top, *map(str, params.values())])
    folder.mkdir(parents=True, exist_ok=True)
    words = ["--cc", "--assert", "-Wall", "--timing", "--Mdir", relative(folder)]
    words += ["--top-module", top, *(f"-I{relative(path)}" for path in project.include_dirs())]
    for name, value in params.items():
        words.append(f'-G{name}="{value}"' if isinstance(value, str) else f"-G{name}={value}")
    words += ["lint/verilator.vlt", "lint/verilator_newer.vlt", *(relative(path) for path in files)]
    text = tool(*verilator_command(words, project.ROOT), env=verilator_environment(project.ROOT))
    # Lines that begin with a dash are statistics, not findings.
    return "\n".join(line for line in text.splitlines() if not line.startswith("- "))


def slang(top: str, files: list[Path], params: dict[str, int | str]) -> str:
    """Elaborate with yosys' read_slang, with assertions, then run yosys' checks; warnings are findings."""
    job = {
        "includes": [relative(path) for path in project.include_dirs()],
        "sources": [relative(path) for path in files],
        "top": top,
        "params": params,
    }
    code, text = ran(sys.executable, "-m", "scripts.fpga.flow.elaborate", json.dumps(job))
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    messages = [line for line in lines if "warning:" in line.lower() or "error:" in line.lower()]
    if code and not messages:
        messages = lines[-4:]
    return "\n".join(dict.fromkeys(messages))


def file_list() -> str:
    """Check that rtl/files.yml lists every RTL file once, and that every listed file exists."""
    groups = project.listed()
    names = [path for group in groups.values() for path in group.files]
    found = [
        f"rtl/files.yml does not list {relative(p)}"
        for p in sorted(project.RTL.rglob("*.sv"))
        if p not in names
    ]
    found += [
        f"rtl/files.yml lists {relative(path)} twice" for path in sorted(set(names)) if names.count(path) > 1
    ]
    found += [
        f"rtl/files.yml lists {relative(path)}, which does not exist" for path in names if not path.is_file()
    ]
    known = set(needed(groups, "boards", *(row.rtl for row in tops())))
    found += [f"rtl/files.yml: group {group} belongs to no part" for group in groups if group not in known]
    return "\n".join(found)


def group_dependencies() -> str:
    """Check that files use only modules and packages of groups in `needs`, and that no `needs` is unused."""
    return "\n".join(walls(project.listed()))


def text_files() -> list[Path]:
    """Return the text files of the project: tracked or new in git; without git, all except build files."""
    code, text = ran("git", "ls-files", "--cached", "--others", "--exclude-standard")
    every = project.ROOT.rglob("*")
    paths = (
        [path for path in every if not BUILT & set(path.relative_to(project.ROOT).parts)]
        if code
        else [project.ROOT / name for name in text.splitlines()]
    )
    return [path for path in paths if path.suffix in TEXT_SUFFIXES and path.is_file()]


def text_marks() -> str:
    """Check for marks of unfinished work, tabs, and spaces at line ends."""
    found = []
    for path in text_files():
        if path.suffix == ".json" or path.name == "Makefile":
            continue
        for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
            words = line.replace(":", " ").replace("(", " ").split()
            if any(mark in words for mark in MARKS):
                found.append(f"{relative(path)}:{number}: leftover mark")
            if line != line.rstrip():
                found.append(f"{relative(path)}:{number}: spaces at the end of the line")
            if "\t" in line:
                found.append(f"{relative(path)}:{number}: tab")
    return "\n".join(found)


def spelling() -> str:
    """Check the text files with codespell; `[tool.codespell]` in pyproject.toml has its settings."""
    files = [relative(path) for path in text_files()]
    return module("codespell_lib", *files)


def locked() -> str:
    """Check that every installed package has the version of requirements.lock."""
    lines = (project.ROOT / "requirements.lock").read_text(encoding="utf-8").splitlines()
    rows = [Requirement(line) for line in lines if not line.startswith("#")]
    versions = {
        canonicalize_name(row.name): str(row.specifier).removeprefix("==")
        for row in rows
        if row.marker is None or row.marker.evaluate()
    }
    found = []
    for installed in distributions(path=[sysconfig.get_path("purelib")]):
        name = canonicalize_name(installed.metadata["Name"])
        version = versions.get(name, "no version")
        # Before Python 3.12, venv installs a setuptools of its own, which is not checked.
        if installed.version != version and name != "setuptools":
            found.append(f"{name} {installed.version} is installed, requirements.lock has {version}")
    return "\n".join(sorted(found))


def board_checks() -> list[Check]:
    """Return the checks of the board tops and their shared carrier, each with all hosts that it supports."""
    every = []
    on_boards = [path.stem for path in project.listed()["boards"].files if path.stem.startswith("board_")]
    for top in ["ppmc104_carrier", *on_boards]:
        hosts = HOSTS_OF.get(top, ("uart", "bus")) if "HOST" in parameters(top) else ("",)
        for host in hosts:
            params: dict[str, int | str] = {"HOST": host.upper()} if host else {}
            label, files = f"{top} {host}".rstrip(), board_sources(top)
            every.append(Check("verilator -Wall", label, partial(verilator, top, files, params)))
            every.append(Check("read_slang", label, partial(slang, top, files, params)))
    return every


def settings(part: Row) -> Iterator[tuple[str, dict[str, int | str]]]:
    """Yield the parameter sets with which a part's top is checked, each with a label for the summary."""
    known = header.parameters(project.top_file(part))
    if "AXES" in known:
        for index, (axes, clk_hz, xtal_hz) in enumerate(BANKS):
            label = f"{part.name} {axes} axes {clk_hz / 1e6:g} MHz"
            idle = index % 2
            yield label, {"AXES": axes, "CLK_HZ": clk_hz, "XTAL_HZ": xtal_hz, "PHASE_IDLE": idle}
        return
    for index, clk_hz in enumerate(CLOCKS):
        for timing in ("FAST", "DATASHEET"):
            params: dict[str, int | str] = {"CLK_HZ": clk_hz, "TIMING": timing}
            label = f"{part.name} {clk_hz / 1e6:g} MHz {timing}"
            if "PHASE_IDLE" in known:
                # These sets combine both levels with both timings, without doubling the number of runs.
                params["PHASE_IDLE"] = (index + (timing == "FAST")) % 2
                label += f" PHASE_IDLE={params['PHASE_IDLE']}"
            yield label, params


def checks() -> list[Check]:
    """Return all checks. Slow checks are first, so that all workers end at about the same time."""
    every = [Check("cdc", "lint/cdc.txt and docs/cdc.md", cdc.findings)]
    for part in tops():
        files = project.sources(part)
        for label, params in settings(part):
            every.append(Check("verilator -Wall", label, partial(verilator, part.top, files, params)))
            every.append(Check("read_slang", label, partial(slang, part.top, files, params)))
    every += board_checks()
    return [
        *every,
        Check("verible-verilog-lint", "rtl/", verible_lint),
        Check("verible-verilog-format", "rtl/", verible_format),
        Check("ruff check", "Python", partial(ruff, "check", "--output-format=concise")),
        Check("ruff format", "Python", partial(ruff, "format", "--check")),
        Check(
            "import-linter", "Python", partial(tool, project.tool("lint-imports"), *CONTRACTS, ok_output=True)
        ),
        Check("mypy --strict", "openppmc", partial(module, "mypy")),
        Check("figures", "docs/sizes.json", lambda: "\n".join(figures.stale(figures.read()))),
        Check("rtl/files.yml", "complete", file_list),
        Check("rtl/files.yml", "dependencies of groups", group_dependencies),
        Check("modules", "ports and lines", all_findings),
        Check("tables", "equal in netlist and simulation", partial(differences, TABLES)),
        *(
            Check(name.rpartition(".")[2], "up to date", partial(module, name, "--check"))
            for name in GENERATORS
        ),
        Check("packages", "templates and FuseSoC run", partial(module, "scripts.fpga.packages", "--try")),
        Check("requirements.lock", "installed packages", locked),
        Check("texts", "marks, tabs, line ends", text_marks),
        Check("prose", "lint/prose.txt", prose.errors),
        Check("codespell", "spelling", spelling),
    ]


def guarded(check: Check) -> str:
    """Return the findings of a check; the message of a ProjectError is a finding, too."""
    try:
        return check.run()
    except ProjectError as error:
        return str(error)


def fix() -> int:
    """Format RTL and Python in place."""
    problems = [
        tool("verible-verilog-format", FORMAT_FLAGS, "--inplace", *rtl_files(".sv"), ok_output=True),
        ruff("check", "--output-format=concise", "--fix", "--select", "I"),
        ruff("format"),
    ]
    for text in filter(None, problems):
        console.print(escape(text))
    console.print(
        "format: done" if not any(problems) else "[bold red]format: some files could not be formatted[/]"
    )
    return int(any(problems))


def main() -> int:
    """Run all checks; return 1 if a check has findings."""
    parser = argparse.ArgumentParser(prog="lint.py", description=__doc__)
    parser.add_argument("--fix", action="store_true", help="format the sources instead of checking them")
    os.chdir(project.ROOT)
    if parser.parse_args().fix:
        return fix()
    every = checks()
    bad, seen = 0, dict[str, str]()
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        for check, findings in zip(every, pool.map(guarded, every), strict=True):
            name = f"{check.tool:22} {check.target}"
            if not findings:
                console.print(f"[green]ok[/]   {name}")
                continue
            bad += 1
            console.print(f"[bold red]FAIL[/] {name}")
            if findings in seen:
                console.print(f"     the same as for {seen[findings]}")
            else:
                console.print(escape("\n".join("     " + line for line in findings.splitlines())))
            seen.setdefault(findings, check.target)
    if bad:
        console.print(f"[bold red]lint: {bad} of {len(every)} checks have findings[/]")
        return 1
    console.print(f"[bold green]lint: {len(every)} checks, no findings[/]")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
