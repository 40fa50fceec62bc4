"""Tests of the driver of the bank."""
