"""Words that all files written from a description begin with or say."""

from __future__ import annotations

from .pads import Fitted


def head(fitted: Fitted, mark: str) -> list[str]:
    """Licence, and from what the file was written; `mark` begins a comment."""
    carrier = f"{fitted.carrier.name}.sv"
    return [
        f"{mark} SPDX-License-Identifier: Apache-2.0",
        f"{mark} Written by `make boards` from {fitted.board.source} and {carrier}; change those, not this.",
    ]


def hosts(fitted: Fitted) -> str:
    """Its host, as titles say it; nothing for a part with a line of its own."""
    if fitted.on.set or "HOST" not in fitted.carrier.parameters:
        return ""
    names = {"uart": "UART", "bus": "bus"}
    return f"{' or '.join(names[host] for host in fitted.on.hosts)} host"


def clk(fitted: Fitted) -> str:
    """The part's clock and where it is from."""
    osc = fitted.board.clock
    from_it = f" from the {osc['mhz']:g} MHz oscillator" if "module" in osc else ", its oscillator"
    return f"clk {fitted.on.mhz:g} MHz{from_it}"
