"""Plots of the outputs of a part from lists of edges, with matplotlib."""
