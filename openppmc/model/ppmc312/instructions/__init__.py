"""Instructions of the PPMC-312: checks, execution, registration."""
