"""Wiring and order lists: circuits between the headers of a board and a machine or an old host."""
