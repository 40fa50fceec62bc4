"""Tests of the PPMC-312 core: directed tests, closed loop on the bus and on the line, and random hosts."""
