"""`make demo`: a part from the host bus to the motor pins."""
