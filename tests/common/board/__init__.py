"""Virtual boards, as `make board` builds them: fixtures for all devices, ports, the pseudo-terminal."""
