"""Tests of the golden model of the PPMC-2104: acceptance checks, errors, inputs, examples, properties."""
