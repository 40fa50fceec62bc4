"""Fuzzed bytes on the serial lines: each deframer of the RTL is compared with that of its golden model."""
