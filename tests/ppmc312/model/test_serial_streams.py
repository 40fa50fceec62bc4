"""With any bytes on the line, a PPMC-312 never hangs and never executes a frame with a wrong checksum."""

from __future__ import annotations

import os

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from cocotb_tests.harness import verifies
from cocotb_tests.ppmc312.serial_frames import summed
from cocotb_tests.ppmc312.serial_streams import Line, campaign
from openppmc.model.ppmc312.front.serial import LENGTHS, Outcome, Parser

FIRST = int(os.environ.get("OPENPPMC_SEED", "0"))
RESET = summed(0x91, b"\xff")
FRAMES = [summed(0x91, bytes([code, *range(0x30, 0x30 + n)])) for code, n in LENGTHS.items() if code != 0xFF]
PIECES = st.one_of(
    st.lists(st.one_of(st.integers(0, 255), st.none(), st.just(400_000)), max_size=12),
    st.sampled_from(FRAMES).map(list),
    st.tuples(st.sampled_from(FRAMES), st.integers(1, 20)).map(lambda pair: list(pair[0][: pair[1]])),
    st.sampled_from([summed(0x81), summed(0x82), summed(0x91, b"\x80"), RESET]).map(list),
)


@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(PIECES, max_size=8))
@verifies("P312-BAD-16", "P312-SER-10", "P312-SER-15", "P312-SER-19")
def test_one_poll_brings_the_station_back(pieces: list[list[int | None]]) -> None:
    line = Line()
    line.send(item for piece in pieces for item in piece)
    line.recovers()


@pytest.mark.parametrize("seed", range(FIRST, FIRST + 3))
@verifies("P312-BAD-16", "P312-SER-19")
def test_campaign(seed: int) -> None:
    print(f"seed {seed}: OPENPPMC_SEED={seed} repeats it")
    assert campaign(seed, 2_000) >= 2_000


@settings(max_examples=400, deadline=None)
@given(st.binary(max_size=60))
@verifies("P312-SER-10", "P312-SER-11", "P312-SER-14", "P312-BAD-16")
def test_only_good_frames_count(noise: bytes) -> None:
    """Each accepted frame was in the stream, with the right address, length and checksum."""
    parser, seen = Parser(1, LENGTHS, "BINARY"), b""
    for byte in noise + b"\x91" + noise:
        seen += bytes([byte])
        finished = parser.take(byte)
        if finished and finished.outcome is Outcome.INSTRUCTION:
            assert seen.endswith(summed(0x91, bytes([finished.code]) + finished.data))
            assert len(finished.data) == LENGTHS[finished.code]
        elif finished and finished.outcome is Outcome.POLL:
            assert seen.endswith(summed(0x81))


@pytest.mark.parametrize(
    ("characters", "outcome"),
    [
        ("91", None),
        ("91 33", None),
        ("91 33 33", Outcome.UNKNOWN),
        ("91 33 33 31 32", Outcome.UNKNOWN),
        ("91 32 36", None),
        ("91 32 36 31", None),
        ("91 4A", Outcome.FAULT),
        ("91 32 4A", Outcome.FAULT),
        ("91 4A 32 36 31", Outcome.FAULT),
        ("81", None),
        ("92 33 33", None),
        ("A1 33 33", None),
        ("91 33 33 81", None),
    ],
)
@verifies("P312-SER-12", "P312-SER-16", "P312-SER-17")
def test_silence(characters: str, outcome: Outcome | None) -> None:
    parser = Parser(1, LENGTHS, "BINARY")
    for byte in bytes.fromhex(characters):
        assert parser.take(byte) is None
    found = parser.silence()
    assert (found.outcome if found else None) is outcome
    assert not parser.unfinished and parser.silence() is None


@verifies("P312-SER-17", "P312-SER-44", "P312-BAD-06")
def test_codes_without_a_meaning() -> None:
    """Each code that is not defined for the serial mode is reported as unknown and skipped until silence
    (P312-SER-17).
    """
    listed = {
        0x00,
        *range(0x02, 0x07),
        *range(0x20, 0x29),
        *range(0x40, 0x46),
        0x49,
        *range(0x4D, 0x50),
        0x59,
    }
    listed |= {0x62, 0x63, 0x69, 0x79, 0xFF, 0x98, 0xB8}
    listed |= {first + bits for first in (0x80, 0x81, 0x89, 0x8A) for bits in (0x00, 0x10, 0x20, 0x30)}
    listed |= {first + bits for first in range(0x82, 0x89) for bits in (0x00, 0x20)} | {0x97, 0xB7}
    assert set(LENGTHS) == listed
    for code in sorted({*range(256)} - listed):
        parser = Parser(1, LENGTHS, "BINARY")
        for byte in b"\x91" + f"{code:02x}".encode():
            assert parser.take(byte) is None
        found = parser.silence()
        assert found is not None and found.outcome is Outcome.UNKNOWN and found.code == code
