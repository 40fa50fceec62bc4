"""The host package below the parts: frames, sessions, ports, units."""
