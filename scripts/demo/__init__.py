"""`make demo`: show a run of a part, from the accesses on its host bus to the signals at its motor pins."""
