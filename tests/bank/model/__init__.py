"""Self-tests of the golden model of the bank."""
