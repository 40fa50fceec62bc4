"""`make docs`: pictures and tables of docs/."""
