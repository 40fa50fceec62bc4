"""Bytes of a PPMC-104 host as text."""

from __future__ import annotations

from ..common.mnemonics import OneAxisDecoder

ERRORS = (
    "undefined command, or a stop at rest",
    "not allowed while BUSY",
    "not initialised",
    "unexpected data byte",
    "PA above 11220",
    "RH above RL, or PA below 4",
    "unexpected data byte while BUSY",
    "already decelerating",
)


class Ppmc104Decoder(OneAxisDecoder):
    """Decoder for the bytes of a PPMC-104, which has one axis and error numbers in the status register."""

    errors = ERRORS
    reads = {
        0x80: ("read finish status", 1),
        0x81: ("read input signals", 1),
        0x82: ("read output signals", 1),
        0x83: ("read remaining pulses", 3),
        0x85: ("read auxiliary inputs", 1),
    }
    switches = ((0x80, "CNP"), (0x40, "ALM"), (8, "L1"), (4, "L2"), (2, "L3"), (1, "L4"))
