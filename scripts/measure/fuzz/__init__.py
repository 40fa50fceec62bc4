"""Fuzzed bytes on the serial lines: each deframer of the RTL is compared with its golden model."""
