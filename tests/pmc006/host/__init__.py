"""The PMC006B4's driver, its bus and its programs, on modelled lines with and without faults."""
