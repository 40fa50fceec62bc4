"""Texts that all files generated from a board description contain."""

from __future__ import annotations

import textwrap

from scripts.fpga.boards.pads import Fitted


def head(fitted: Fitted, mark: str) -> list[str]:
    """Return the lines with the licence and the sources of a file; `mark` is the comment mark."""
    carrier = f"{fitted.carrier.name}.sv"
    return [
        f"{mark} SPDX-License-Identifier: Apache-2.0",
        f"{mark} Written by `make boards` from {fitted.board.source} and {carrier}; change those, not this.",
    ]


def title(fitted: Fitted) -> str:
    """Return the names of part, board and host; without the host if the part has its own serial line."""
    names = {"uart": "UART", "bus": "bus", "spi": "SPI"}
    host = f" with {' or '.join(names[host] for host in fitted.on.hosts)} host"
    own_line = "HOST" in (fitted.on.set or {}) or "HOST" not in fitted.carrier.parameters
    return f"{fitted.on.row.title}{'' if own_line else host} on {fitted.board.title}"


def wrapped(mark: str, *texts: str) -> list[str]:
    """Return texts as comment lines of a header; each text begins on a new line."""
    lines = [
        line
        for text in texts
        for line in textwrap.wrap(text, 115, subsequent_indent=" " * 8, break_on_hyphens=False)
    ]
    return [f"{mark} {line}" for line in lines]


def clk(fitted: Fitted) -> str:
    """Return a text about the clock of the part and the source of this clock."""
    osc = fitted.board.clock
    from_it = f" from the {osc['mhz']:g} MHz oscillator" if "module" in osc else " from the oscillator"
    return f"clk {fitted.on.mhz:g} MHz{from_it}"
