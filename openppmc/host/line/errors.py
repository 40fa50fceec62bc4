"""What a line with several stations can get wrong, as exceptions."""

# ruff: noqa: N818

from __future__ import annotations

from collections.abc import Sequence

from ..basis.errors import LinkError, NoAnswer
from .faults import Fault, Miss


class StationSilent(NoAnswer):
    """No reply of a station came, however often it was asked."""


class GarbledReply(NoAnswer):
    """Bytes came, but never a whole reply: noise, a wrong speed, or two stations with one address."""


class DuplicateAddress(LinkError):
    """Two stations of a line seem to have the same address."""


class LineEcho(LinkError):
    """The line hears its own bytes, but was not told so."""


class LostReply(LinkError):
    """An instruction that may not be repeated was sent, and nobody knows whether it was carried out."""


def unanswered(where: str, misses: Sequence[Miss], attempts: int, check: str, others: str) -> NoAnswer:
    """What to say when all attempts to ask a station have failed.

    check: what to look at after silence. others: what makes garbled replies.
    """
    if not any(miss.heard for miss in misses):
        if len(misses) < attempts:
            return GarbledReply(f"{where} could not read {attempts} frames: check cable and termination")
        frames = "a frame" if attempts == 1 else f"{attempts} frames"
        return StationSilent(f"{where}: no reply to {frames}: {check}")
    if all(miss.fault is Fault.FOREIGN for miss in misses):
        return GarbledReply(f"{where}: another station replied, {attempts} times: does a second master talk?")
    return GarbledReply(f"{where}: only garbled replies, {attempts} times: {others}")
