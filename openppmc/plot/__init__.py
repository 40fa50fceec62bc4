"""Plots of what a part did: pictures made from edge lists, with matplotlib."""
