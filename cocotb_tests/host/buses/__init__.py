"""Tests of the on-chip bus bridges ppmc_axil and ppmc_wishbone.

buses_top.sv      both bridges with bare strobe pins (model_*), and both with a PPMC-104 (part_*)
strobe_slave.py   register model at the strobe pins; checks every cycle for UB-BUS-01
wishbone.py       Wishbone master for classic cycles, with a protocol check
session.py        a host program for the part over any bus, and the comparison with the golden model
tb_axil.py, tb_wishbone.py   the tests; test_buses.py runs them under pytest
"""
