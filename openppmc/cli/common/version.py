"""Whether board and package fit: versions, and the sources of a checkout."""

from __future__ import annotations

from ... import __version__, parts
from ...errors import PpmcError
from ...host.script import Build


def misfit(build: Build | None, number: int) -> str:
    """One line that says what to do, "" if they fit or nobody can tell. number: of the part."""
    if build is None:
        return ""
    if build.version != __version__:
        older = "the package" if _order(build.version) > _order(__version__) else "the bitstream"
        return f"the bitstream is of version {build.version}, this package {__version__}: renew {older}"
    row = parts.by_number(number)
    if not build.source or row is None:
        return ""
    from ... import sources
    from ...sim.common.build import find_root

    try:
        own = sources.digest(find_root(), f"{row.rtl}_carrier").hex()
    except (PpmcError, RuntimeError, OSError):
        return ""  # no checkout here
    if own and build.source != own:
        return (
            f"the bitstream was built from other sources ({build.source}) than those of this checkout "
            f"({own}): build and load it anew to test these"
        )
    return ""


def _order(version: str) -> list[int]:
    return [int(word) for word in version.split(".") if word.isdigit()]
