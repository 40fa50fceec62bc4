"""The C driver of the STMC, compiled and run."""
