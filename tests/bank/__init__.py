"""Tests of the bank: host, command line, virtual board, C driver."""
