"""`make demo`: a part seen from the host bus to the motor pins."""
