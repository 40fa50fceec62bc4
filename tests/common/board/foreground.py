"""A program that Ctrl-C ends, even if the tests run in the background."""

from __future__ import annotations

import signal
import subprocess
from collections.abc import Sequence
from typing import Any


def foreground(command: Sequence[str], **options: Any) -> subprocess.Popen[str]:
    """Start it with its output in a pipe and SIGINT enabled, which background jobs of a shell ignore."""

    def listen() -> None:
        signal.signal(signal.SIGINT, signal.SIG_DFL)

    return subprocess.Popen(command, text=True, stdout=subprocess.PIPE, preexec_fn=listen, **options)
