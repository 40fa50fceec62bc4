"""The base of all errors that users see; most of them are in `host.basis.errors`."""


class PpmcError(Exception):
    """Base of all errors of this package."""
