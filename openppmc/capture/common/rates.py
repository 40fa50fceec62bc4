"""The sample rates and the units of time, as the programs of analysers write them."""

from __future__ import annotations

import re
from fractions import Fraction

_NUMBER = r"([\d.,]{1,40}(?:e[+-]?\d{1,2})?)\s*([kKmMgG]?)\s*(?:Hz|S/s|Sa/s|sps)?\s*"
_RATE = re.compile(rf"sample\s*_?rate\W*?{_NUMBER}(?:[;,\t\"]|$)", re.I)
_PREFIX = {"": 1, "k": 10**3, "K": 10**3, "M": 10**6, "m": 10**6, "G": 10**9, "g": 10**9}
UNITS = {
    **{"s": 10**12, "sec": 10**12, "secs": 10**12, "second": 10**12, "seconds": 10**12},
    **{"ms": 10**9, "millisecond": 10**9, "milliseconds": 10**9},
    **{"us": 10**6, "µs": 10**6, "μs": 10**6, "microsecond": 10**6, "microseconds": 10**6},
    **{"ns": 10**3, "nanosecond": 10**3, "nanoseconds": 10**3},
    **{"ps": 1, "picosecond": 1, "picoseconds": 1},
}
FINE = {"fs": 3, "femtosecond": 3, "femtoseconds": 3, "as": 6, "attosecond": 6, "attoseconds": 6}
"""Units below 1 ps. A key is the name of the unit 10**-n ps, its value is n."""


def unit(name: str) -> Fraction | None:
    """Return a unit of time in ps, `None` for other text."""
    name = name.strip().lower()
    if name in FINE:
        return Fraction(1, 10 ** FINE[name])
    return Fraction(UNITS[name]) if name in UNITS else None


def rate_in(line: str) -> Fraction | None:
    """Return the sample rate in Hz from a line of a header; `None` if it contains no rate.

    >>> rate_in("; Samplerate: 24 MHz"), rate_in("#Sample rate: 1e+08Hz"), rate_in("; Channels: 3")
    (Fraction(24000000, 1), Fraction(100000000, 1), None)
    """
    match = _RATE.search(line)
    return None if match is None else hertz(match[1] + match[2])


def hertz(text: str) -> Fraction | None:
    """Return the rate in Hz of `24 MHz`, `24000000` or `1.5k`.

    The result is `None` if the text is not a rate from 1 mHz to 1 THz.
    """
    match = re.fullmatch(rf"\s*{_NUMBER}", text, re.I)
    if match is None:
        return None
    digits = match[1].replace(",", ".") if match[1].count(",") == 1 and "." not in match[1] else match[1]
    try:
        found = Fraction(digits.replace(",", "")) * _PREFIX[match[2]]
    except ValueError:
        return None
    return found if Fraction(1, 1000) <= found <= 10**12 else None
