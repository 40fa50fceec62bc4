"""Virtual boards of all parts: board, build, parser of the port text, machine model, lines.

The port text is the text after `sim:`.
"""
