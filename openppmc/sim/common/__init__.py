"""The virtual board, its build, its text, and lines of stations."""
