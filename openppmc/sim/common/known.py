"""`openppmc.sim.KNOWN`, apart because it needs the machines of all parts."""

from .spec import known_words

KNOWN = known_words()
"""Words of a board's text."""
