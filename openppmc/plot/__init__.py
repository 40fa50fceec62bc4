"""Plots of the outputs of a part: pictures of edge lists, with matplotlib."""
