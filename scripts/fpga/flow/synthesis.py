"""Yosys jobs of `make report`, `make bitstream` and `make test-gates`."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from cocotb_tests.harness import project
from cocotb_tests.harness.project import ProjectError

FAMILIES = ("ecp5", "ice40")


def run_yosys(folder: Path, job: dict) -> Path:
    """Run one synthesis job in a separate process; raise ProjectError with the end of its log if it fails."""
    folder.mkdir(parents=True, exist_ok=True)
    stem = f"{job['family']}-{job['recipe']}{'-kept' if job['keep'] else ''}"
    # Paths are relative to the root, where yosys runs, because a space ends a name in its commands.
    job = {**job, "json": project.relative(folder / f"{stem}.json")}
    job_file, log = folder / f"{stem}.job", folder / f"{stem}.log"
    job_file.write_text(json.dumps(job, indent=1))
    with log.open("w") as sink:
        done = subprocess.run(
            [sys.executable, "-m", "scripts.fpga.flow.yosys_job", str(job_file)],
            cwd=project.ROOT,
            stdout=sink,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            check=False,
        )
    if done.returncode:
        lines = [line for line in log.read_text().splitlines() if line.strip()]
        errors = [line for line in lines if "error" in line.lower()][:12] or lines[-8:]
        raise ProjectError("\n".join([f"yosys failed ({project.relative(log)})", *errors]))
    return folder / f"{stem}.json"
