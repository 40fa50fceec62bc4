"""The base of all errors that users see; most of them are in `host.errors`. What is not installed."""

from __future__ import annotations

from importlib.util import find_spec


class PpmcError(Exception):
    """Base of all errors of this package."""


class MissingExtraError(PpmcError):
    """A library of an extra, such as `plot` or `ophyd`, is not installed. One line that says which."""


def needs(extra: str, what: str, *modules: str) -> None:
    """Before the libraries of an extra are imported. what: begins the line. Raises MissingExtraError."""
    for module in modules:
        if find_spec(module) is None:
            raise MissingExtraError(
                f"{what} needs {module}, which is not installed: pip install 'openppmc[{extra}]'"
            )
