"""Tests of the golden model of the PPMC-104: acceptance checks, edges of rules, properties."""
