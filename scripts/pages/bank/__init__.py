"""Pictures and tables of the manual of the bank."""
