"""`make bench`: speed of every way to run a part without an FPGA, as ratios of one run."""
