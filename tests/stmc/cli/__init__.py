"""Tests of the commands of the STMC."""
