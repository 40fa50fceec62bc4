"""`make bench`: speed of every way to run a part without an FPGA. A ratio is from a single run."""
