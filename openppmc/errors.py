"""Base of all errors for users, and the check for missing libraries.

Most errors are in `host.errors`.
"""

from __future__ import annotations

from importlib.util import find_spec


class PpmcError(Exception):
    """Base of all errors of this package."""


class MissingExtraError(PpmcError):
    """A library of an extra, such as `plot` or `ophyd`, is not installed.

    The message is one line that names the library.
    """


def needs(extra: str, what: str, *modules: str) -> None:
    """Check that the libraries of an extra are installed before they are imported.

    Args:
        what: beginning of the message: the function that requires the libraries.

    Raises:
        MissingExtraError: a library is missing.
    """
    for module in modules:
        if find_spec(module) is None:
            raise MissingExtraError(
                f"{what} needs {module}, which is not installed: pip install 'openppmc[{extra}]'"
            )
