"""The C drivers with damaged replies: calls end in bounded time, return no wrong value, stay within
bounds.
"""

from __future__ import annotations

import os

import pytest

from cocotb_tests.harness.paths import relative
from tests.common.packages.c_programs import BENCH, C99, DRIVER, WARNINGS, run

SANITIZE = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
DRIVERS = [DRIVER / f"{name}.c" for name in ("ppmc104", "ppmc2104", "ppmc312", "pmc006", "ppmc_bank", "stmc")]
SEEDS = [1, 2, 3, int(os.environ.get("SEED", "4"))]


@pytest.fixture(scope="module")
def programs(tmp_path_factory):
    """Build the programs, with the sanitizers if the compiler has them; return their folder."""
    folder = tmp_path_factory.mktemp("fuzz")
    probe = folder / "probe.c"
    probe.write_text("int main(void) { return 0; }\n")
    try:
        run(*C99, *SANITIZE, probe, "-o", folder / "probe")
        sanitize = SANITIZE
    except pytest.fail.Exception:
        sanitize = []
    for name in ("fuzz", "dead"):
        sources = [BENCH / f"{name}.c", *DRIVERS]
        run(*C99, *WARNINGS, *sanitize, "-O1", "-g", *map(relative, sources), "-o", folder / name)
    return folder


@pytest.mark.parametrize("seed", SEEDS)
def test_damaged_replies(programs, seed):
    """With cut, flipped, inserted and random bytes, every call ends with a result (P006-FRM-03,
    P312-SER-12).
    """
    found = {
        int(line.split()[0]): int(line.split()[1]) for line in run(programs / "fuzz", seed, 3000).splitlines()
    }
    # The results include valid replies, time-outs, no device, damaged replies, and rejections by each device.
    assert {0, 16, 17, 18, 21, 37, 65, 96} <= found.keys()
    assert sum(found.values()) > 100_000


@pytest.mark.parametrize("seed", SEEDS)
def test_buses_without_a_working_part(programs, seed):
    """On a dead bus or line, every call ends after a limited number of accesses.

    Each read returns the same value, or random bits. A line is silent, or never stops sending such bytes.
    With the same value, no call confirms a motion; with random bits, at most 2 of 2000 runs do so by chance.
    """
    lines = run(programs / "dead", seed, 2000).splitlines()
    found = {int(line.split()[0]) for line in lines if line[0].isdigit()}
    assert {16, 17, 19, 20, 21} <= found
    accesses, chance = (line.split() for line in lines[-2:])
    assert int(accesses[1]) <= 4000
    assert int(chance[1]) <= 2
