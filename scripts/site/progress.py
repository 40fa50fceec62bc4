"""Progress lines of `make site`, each printed when its work begins."""

from __future__ import annotations


def say(text: str) -> None:
    """Print a progress line at once, also into a pipe."""
    print(f"site: {text}", flush=True)
