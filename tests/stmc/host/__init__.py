"""Tests of the driver of the STMC."""
