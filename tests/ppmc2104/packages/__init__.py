"""The C driver of the PPMC-2104, compiled and run."""
