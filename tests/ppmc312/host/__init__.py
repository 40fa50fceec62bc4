"""Driver of the PPMC-312 with the bridge, and its blocks of bytes."""
