"""`make bench`: how fast everything runs that runs a part without an FPGA, as ratios of one run."""
