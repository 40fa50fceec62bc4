"""Virtual boards of all parts: board, build, parser of the text after `sim:`, machine model, lines."""
