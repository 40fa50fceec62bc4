"""A stand-in for pytest in simulator processes that do not rewrite assertions: it starts faster."""
