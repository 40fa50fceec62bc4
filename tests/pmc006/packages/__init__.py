"""The C driver of the PMC006B4, compiled and run."""
