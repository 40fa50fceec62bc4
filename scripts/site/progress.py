"""Progress lines of `make site`, each printed when its step begins."""

from __future__ import annotations


def say(text: str) -> None:
    """Print a progress line immediately, also to a pipe."""
    print(f"site: {text}", flush=True)
