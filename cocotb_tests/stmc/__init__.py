"""Part tests of the STMC core and of its board, run inside the simulator and under pytest."""
