"""Tests of the PPMC-312 core: directed tests, closed-loop tests on the bus and the line, and random hosts."""
