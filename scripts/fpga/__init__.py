"""Products for FPGAs: boards, bitstreams, plain Verilog, packages, the ROM of the PMC006B4."""
