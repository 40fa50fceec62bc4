"""Virtual boards, as `make board` makes them: fixtures of all parts, ports, the pseudo-terminal."""
