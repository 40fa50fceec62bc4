"""Tests of the PPMC-104: golden model and host."""
