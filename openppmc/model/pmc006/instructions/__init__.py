"""Instructions of the PMC006B4: executor, user program, keys."""
