"""`openppmc.sim.KNOWN`; a separate module, because it loads the models of all machines."""

from .spec import known_words

KNOWN = known_words()
"""Words of the text of a board."""
