"""`openppmc.sim.KNOWN`, in a separate module because it imports the machine models of all parts."""

from .spec import known_words

KNOWN = known_words()
"""Words of the text of a board."""
