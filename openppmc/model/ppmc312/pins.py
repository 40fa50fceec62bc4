"""Pins of the PPMC-312 with idle and reset levels (chapter 1.3)."""

from __future__ import annotations

INPUTS: dict[str, int] = {
    "rst_n": 1,
    "mode": 1,
    "d_i": 0,
    "rs": 0,
    "cs_n": 1,
    "we_n": 1,
    "oe_n": 1,
    "rxd": 1,
    "hsp": 0,
    "mod": 0,
    "adr": 0,
    "evt0_n": 1,
    "evt1_n": 1,
    "auxi": 0,
    "epin": 0,
    "epdir": 0,
    "index_n": 1,
    "org_n": 1,
    "alm_n": 1,
    "end_n": 1,
    "fl_n": 1,
    "bl_n": 1,
    "fhl_n": 1,
    "bhl_n": 1,
    "extck": 0,
    "run": 1,
}
OUTPUTS: dict[str, int] = {
    "d_o": 0,
    "d_oe": 0,
    "wrq_n": 1,
    "irq_n": 1,
    "txd": 1,
    "snd": 0,
    "auxo_n": 0x3F,
    "exon_n": 1,
    "cclr_n": 1,
    "aclr_n": 1,
    "zclmp_n": 1,
    "cd_n": 1,
    "pout": 0,
    "dir": 0,
    "intlk_n": 1,
    "out_oe": 0,
}
WIDTHS: dict[str, int] = {"d_i": 8, "rs": 3, "mod": 3, "adr": 4, "auxi": 8, "d_o": 8, "auxo_n": 6}
HOST_PINS = ("d_i", "rs", "cs_n", "we_n", "oe_n")
SERIAL_PINS = ("rxd",)
