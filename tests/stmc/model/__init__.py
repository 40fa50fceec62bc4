"""Tests of the golden model of the STMC: acceptance checks, examples, data sheet times, properties."""
