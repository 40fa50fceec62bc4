"""Driver of the PPMC-312; `line` contains the driver of its serial mode."""
