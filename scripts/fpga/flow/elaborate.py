"""Run read_slang and yosys' structural checks on one top; print the log, return yosys' exit code.

`make lint` starts ``python -m scripts.fpga.flow.elaborate JOB`` with a JSON text of sources, includes, top
and params. The yosys commands in `passes`, if present, replace the checks. This is a separate process,
because yosys calls exit() on an error.
"""

from __future__ import annotations

import json
import sys

from cocotb_tests.harness.project import run


def main() -> int:
    """Elaborate the top and check it; print the log."""
    import pyosys.libyosys as ys

    job = json.loads(sys.argv[1])
    read = ["read_slang", "--no-synthesis-define", "--top", job["top"]]
    for name, value in job["params"].items():
        read += ["-G", f'{name}="{value}"' if isinstance(value, str) else f"{name}={value}"]
    read += [f"-I{path}" for path in job["includes"]] + job["sources"]
    design = ys.Design()
    checks = [f"hierarchy -check -top {job['top']}", "proc -latches error", "check -assert"]
    for command in (" ".join(read), *job.get("passes", checks)):
        ys.run_pass(command, design)
    return 0


if __name__ == "__main__":
    sys.exit(run(main, "JOB"))
