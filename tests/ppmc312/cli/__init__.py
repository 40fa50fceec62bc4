"""The PPMC-312's commands behind the bridge."""
