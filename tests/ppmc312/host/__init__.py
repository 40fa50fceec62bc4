"""The PPMC-312's driver behind the bridge, and its blocks of bytes."""
