"""The C drivers with damaged replies: calls end in bounded time, return no wrong value, stay within
bounds.
"""

from __future__ import annotations

import os

import pytest

from cocotb_tests.harness.paths import relative
from tests.common.packages.c_programs import BENCH, C99, DRIVER, WARNINGS, run

SANITIZE = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
SOURCES = [BENCH / "fuzz.c", *(DRIVER / f"{name}.c" for name in ("ppmc104", "ppmc2104", "ppmc312", "pmc006"))]
SEEDS = [1, 2, 3, int(os.environ.get("SEED", "4"))]


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    """Build the fuzzer, with the sanitizers if the compiler has them."""
    folder = tmp_path_factory.mktemp("fuzz")
    probe = folder / "probe.c"
    probe.write_text("int main(void) { return 0; }\n")
    try:
        run(*C99, *SANITIZE, probe, "-o", folder / "probe")
        sanitize = SANITIZE
    except pytest.fail.Exception:
        sanitize = []
    run(*C99, *WARNINGS, *sanitize, "-O1", "-g", *map(relative, SOURCES), "-o", folder / "fuzz")
    return folder / "fuzz"


@pytest.mark.parametrize("seed", SEEDS)
def test_damaged_replies(program, seed):
    """With cut, flipped, inserted and random bytes, every call ends with a result (P006-FRM-03,
    P312-SER-12).
    """
    found = {int(line.split()[0]): int(line.split()[1]) for line in run(program, seed, 3000).splitlines()}
    # The results include valid replies, time-outs, no device, damaged replies, and rejections by each device.
    assert {0, 16, 17, 18, 21, 37, 65, 96} <= found.keys()
    assert sum(found.values()) > 100_000
