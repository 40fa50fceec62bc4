"""FPGA boards: what constraints/<board>/board.yml says, and what `make boards` writes from it."""
