"""Simulations of the RTL: a folder per part, folders for shared blocks and boards, and the test harness."""
