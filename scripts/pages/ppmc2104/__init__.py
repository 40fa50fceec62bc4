"""Pictures and tables of the manual of the PPMC-2104."""
