"""Synthesis with yosys, place and route with nextpnr, plain Verilog."""
