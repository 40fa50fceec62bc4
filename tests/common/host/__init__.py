"""Tests of the host package below the device drivers: frames, sessions, ports, units."""
