"""Motion of one axis, common to the PPMC family: ramp, operation, guard, excitation, chopper."""
