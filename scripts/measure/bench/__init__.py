"""`make bench`: speed of every way to run a part without an FPGA; ratios are measured in one run."""
