"""Fuzzed bytes on the serial lines: each deframer of the RTL against that of its golden model."""
