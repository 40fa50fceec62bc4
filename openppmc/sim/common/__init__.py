"""The virtual board, its build, its text, the machine around it, and lines of stations."""
