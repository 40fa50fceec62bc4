"""What is around a PPMC-312: machine, virtual line of stations."""
