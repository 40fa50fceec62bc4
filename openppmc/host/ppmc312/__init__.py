"""Driver of the PPMC-312; `line` has that of its serial mode."""
