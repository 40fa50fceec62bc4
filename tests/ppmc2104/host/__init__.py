"""Tests of the driver of the PPMC-2104."""
