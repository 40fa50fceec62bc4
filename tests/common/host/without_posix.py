"""Python without the modules and functions that only POSIX systems have.

This module is a pytest plugin, too: `pytest -p tests.common.host.without_posix …`. It changes the process for
good, so the tests use it in a separate process.
"""

from __future__ import annotations

import os
import select
import signal
import sys

MODULES = (
    "crypt",
    "fcntl",
    "grp",
    "nis",
    "ossaudiodev",
    "pty",
    "pwd",
    "readline",
    "resource",
    "spwd",
    "syslog",
)
"""Modules that Windows does not have. The next statement adds others, among them termios and tty."""
MODULES += ("termios", "tty", "_curses", "_posixshmem")
NAMES = {
    os: ("fork", "forkpty", "openpty", "killpg", "setsid", "getuid", "geteuid", "mkfifo", "ttyname"),
    signal: ("SIGHUP", "SIGALRM", "SIGCHLD", "SIGKILL", "SIGPIPE", "SIGUSR1", "setitimer", "alarm", "pause"),
    select: ("poll", "epoll"),
}


def block() -> None:
    """Make each import of these modules, and each use of these functions, an error."""
    sys.modules.update(dict.fromkeys(MODULES))
    for module, names in NAMES.items():
        for name in names:
            if hasattr(module, name):
                delattr(module, name)


def pytest_configure() -> None:
    block()
