"""Tests of the PPMC-312 core: scripts on the golden model that are played on the RTL, and random hosts."""
