"""`make demo`: one PPMC-104 seen from the host bus to the motor pins."""
