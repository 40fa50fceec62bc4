"""Captures of old chips: what a logic analyser saw of bus and pins, in words and beside the golden model.

Room `common` reads files, pin maps, moves and comparisons, and knows no part. A part's folder says how its
bus or line is read and what its bytes mean (column `decode` of the table of parts).
"""
