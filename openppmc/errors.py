"""The base of all errors that users see; `host.errors` has most of them."""


class PpmcError(Exception):
    """Base of all errors of this package."""
