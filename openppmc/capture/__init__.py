"""Captures of original chips by a logic analyser.

The accesses on the bus are decoded to text, and the pins are compared with the golden model.

The folder `common` reads files and pin maps, finds the moves in a capture, and compares the capture with the
model. It depends on no part. The folder of a part defines how its bus or line is read and what its bytes mean
(column `decode` of the table of parts).
"""
