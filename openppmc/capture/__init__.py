"""Captures of original chips by a logic analyser.

Bus and pins are decoded to text and compared with the golden model.

Folder `common` reads files, pin maps, moves and comparisons, and depends on no part. The folder of a part
defines how its bus or line is read and what its bytes mean (column `decode` of the table of parts).
"""
