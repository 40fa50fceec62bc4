"""Tests of the driver of the PPMC-104."""
