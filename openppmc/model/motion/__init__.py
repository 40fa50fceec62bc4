"""Motion of one axis as the whole family has it: ramp, operation, guard, excitation, chopper."""
