"""`openppmc.sim.KNOWN`. It has a separate module, because it loads the machine models of all parts."""

from .spec import known_words

KNOWN = known_words()
"""Words of the text of a board."""
