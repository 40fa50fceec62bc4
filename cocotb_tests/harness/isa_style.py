"""How a bench speaks on an 8-bit ISA bus: the address says which register, no chip select of its own."""

from __future__ import annotations

from .part import BusStyle

STROBES_ISA = BusStyle(
    write_on={"iow_n": 0},
    write_off={"iow_n": 1},
    read_on={"ior_n": 0},
    read_off={"ior_n": 1},
    address="sa",
)
