"""Expected values of the PPMC-2104AFP tests: settings and codes."""

from __future__ import annotations

from cocotb_tests.harness.axis_driver import Ramp, forced, rates

Init = tuple[int, int, int, int]

# Code, RL, RH, PA: 4-phase, 2-phase excitation, internal base clock.
INIT_A: Init = (0x02, 9, 4, 4)
# Settings of the acceptance table, ramp "B" of P2104-EX-01.
INIT_B: Init = (0x02, 0x63, 0x13, 0x0A)
# Setting with the external base clock and a short ramp of small rates, for tests that control each clock
# edge.
INIT_EXT: Init = (0x0A, 2, 0, 4)

# Setting code of each step list (E and MM), for axis 1 with internal clock and without switching.
STEP_CODES = {"3 full": 0x01, "3 half": 0x05, "4 full": 0x02, "4 half": 0x06, "5 full": 0x03, "5 half": 0x07}

OBF, IBF, BUSY1, BUSY2, CMND1, CMND2, ERROR = 0x01, 0x02, 0x04, 0x08, 0x10, 0x20, 0x80

ALL = 1 << 24

# Maximum number of cycles of a ramp-table build (P2104-HSK-05).
BUILD_LATEST = 40_000


def slowed(ramp: Ramp, n: int, j: int) -> list[int]:
    """Return the rates of all intervals if deceleration is requested in I(j), j >= 1 (P2104-FDC-02/03).

    If I(j) has the start-up rate, the motion ends during I(j), and the rate of I(j) is not returned.
    """
    rl, _, pa = ramp
    which = forced(n, pa, j)
    if rates(ramp, which[j - 1 : j]) == [rl]:
        which = which[: j - 1]
    return rates(ramp, which)


def kind_of(code: int) -> str:
    """Return the kind of a code, derived from the code map only (P2104-CMD-01)."""
    group, low = code >> 6, code & 7
    if group == 0:
        return "setting" if code & 3 else "undefined"
    if group == 1:
        return ("stop", "stop", "step", "ramp", "constant", "rate", "high", "rate")[low]
    if group == 2:
        names = ("read", "read", "read", "read3", "switching", "delay", "error", "undefined")
        return "undefined" if code & 0x18 else names[low]
    if low == 0:
        return "undefined" if code & 0x18 else "off"
    if low == 1:
        return "undefined" if code & 0x08 else "auxout"
    if low == 2:
        return "auxin" if code == 0xC2 else "undefined"
    return {3: "ramp", 6: "high"}.get(low, "undefined")


DATA_BYTES = {"setting": 4, "ramp": 3, "constant": 4, "rate": 1, "switching": 2, "delay": 1}
OPERATIONS = frozenset({"step", "ramp", "constant", "rate", "high"})


def axis_of(code: int) -> int:
    """Return the axis whose error register records the error of a faulty code (P2104-ERR-01)."""
    return 1 if kind_of(code) in ("auxout", "auxin") else (code >> 5 & 1) + 1
