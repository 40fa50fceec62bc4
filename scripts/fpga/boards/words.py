"""Words that all files written from a description begin with or say."""

from __future__ import annotations

import textwrap

from scripts.fpga.boards.pads import Fitted


def head(fitted: Fitted, mark: str) -> list[str]:
    """Licence, and from what the file was written; `mark` begins a comment."""
    carrier = f"{fitted.carrier.name}.sv"
    return [
        f"{mark} SPDX-License-Identifier: Apache-2.0",
        f"{mark} Written by `make boards` from {fitted.board.source} and {carrier}; change those, not this.",
    ]


def title(fitted: Fitted) -> str:
    """The part, with its host unless it has a line of its own, and the board."""
    names = {"uart": "UART", "bus": "bus", "spi": "SPI"}
    host = f" with {' or '.join(names[host] for host in fitted.on.hosts)} host"
    own_line = "HOST" in (fitted.on.set or {}) or "HOST" not in fitted.carrier.parameters
    return f"{fitted.on.row.title}{'' if own_line else host} on {fitted.board.title}"


def wrapped(mark: str, *texts: str) -> list[str]:
    """Texts as comment lines of a head, each from a line of its own."""
    lines = [
        line
        for text in texts
        for line in textwrap.wrap(text, 115, subsequent_indent=" " * 8, break_on_hyphens=False)
    ]
    return [f"{mark} {line}" for line in lines]


def clk(fitted: Fitted) -> str:
    """The part's clock and where it is from."""
    osc = fitted.board.clock
    from_it = f" from the {osc['mhz']:g} MHz oscillator" if "module" in osc else ", its oscillator"
    return f"clk {fitted.on.mhz:g} MHz{from_it}"
