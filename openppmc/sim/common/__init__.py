"""The virtual board, its build, its text, its machine model, and lines of stations."""
