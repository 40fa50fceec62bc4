"""Driver of the PMC006B4, its bus and its programs, on modelled lines with and without faults."""
