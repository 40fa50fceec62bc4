"""`openppmc.sim.KNOWN`, in a separate module, because it loads the machine models of all parts."""

from .spec import known_words

KNOWN = known_words()
"""Names of the options that the text of a virtual board may contain (docs/virtual_board.md, Words)."""
