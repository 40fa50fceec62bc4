"""FPGA boards: constraints/<board>/board.yml and the files that `make boards` generates from it."""
