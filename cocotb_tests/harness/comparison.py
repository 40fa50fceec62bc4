"""What a comparison finds is that of `openppmc.check.comparison`."""

from openppmc.check.comparison import Comparison, Mismatch, Waves, compare_edges, differing_spans

__all__ = ["Comparison", "Mismatch", "Waves", "compare_edges", "differing_spans"]
