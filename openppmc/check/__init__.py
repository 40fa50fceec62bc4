"""What pins did against what the golden model says they must do: of the RTL, a board, an old chip.

records     pin changes, output edges, a `Recording` of both
replay      recorded inputs into a golden model: the edges it expects, and the comparison
comparison  two lists of edges: the first difference, where levels differ
report, draw, vcd   a comparison in words, as a picture, as waveforms
"""
