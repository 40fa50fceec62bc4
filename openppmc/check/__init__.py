"""Comparison of pins with the golden model, for the RTL, a board or an original chip.

records     pin changes, output edges, a `Recording` of both
replay      golden model with recorded inputs: the edges that it expects, and the comparison
comparison  two lists of edges: the first difference, and where levels differ
report, draw, vcd   a comparison as text, as a picture, as waveforms
"""
