"""Tests of the PPMC-312: golden model, host drivers of both interfaces, command line, virtual boards."""
