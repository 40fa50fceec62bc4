"""Tests of the J105 STMC: golden model, host, command line, C driver, virtual board."""
