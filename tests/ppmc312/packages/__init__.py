"""The C driver of the PPMC-312, compiled and run."""
