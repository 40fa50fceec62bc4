"""The C driver of the bank."""
