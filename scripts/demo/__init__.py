"""`make demo`: run a part from its host bus to its motor pins."""
