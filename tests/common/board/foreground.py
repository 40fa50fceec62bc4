"""Starts programs that Ctrl-C ends, even if the tests run in the background."""

from __future__ import annotations

import signal
import subprocess
from collections.abc import Sequence
from typing import Any


def foreground(command: Sequence[str], **options: Any) -> subprocess.Popen[str]:
    """Start a command with its output in a pipe and SIGINT enabled.

    If the tests are a background job of a shell, SIGINT is ignored, and child processes inherit this.
    """

    def listen() -> None:
        signal.signal(signal.SIGINT, signal.SIG_DFL)

    return subprocess.Popen(command, text=True, stdout=subprocess.PIPE, preexec_fn=listen, **options)
