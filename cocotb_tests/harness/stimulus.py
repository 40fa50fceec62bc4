"""The records that bench and comparator share are those of `openppmc.check.records`."""

from openppmc.check.records import Access, Change, Edge, Recording, bit_changes, by_signal, level_at, steps

__all__ = ["Access", "Change", "Edge", "Recording", "bit_changes", "by_signal", "level_at", "steps"]
