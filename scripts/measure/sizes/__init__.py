"""`make report` and `make size`: sizes and clock rates of all designs (docs/sizes.json)."""
