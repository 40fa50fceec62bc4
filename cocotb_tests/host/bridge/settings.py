"""The configurations in which tests build the bridge; `extra` contains the parameter Baud."""

from __future__ import annotations

from cocotb_tests.harness import Config

# 8 cycles per bit, so that scripts need little simulated time; most tests use this build.
FAST = Config("fast8m", clk_hz=8_000_000, extra=(("Baud", 1_000_000),))
# Two pulse counters, as for a part with two axes.
TWO = Config("two8m", clk_hz=8_000_000, extra=(("Baud", 1_000_000), ("Axes", 2), ("Part", 2104)))
# No pulse counter, as for a bank.
NONE = Config("none8m", clk_hz=8_000_000, extra=(("Baud", 1_000_000), ("Counter", 0), ("Part", 32)))
# A bank with its bridge, and the shortest round, counted in cycles, that BANK-GEN-02 allows.
BANK = Config("bank8m", clk_hz=8_000_000, extra=(("Baud", 1_000_000), ("AXES", 4)))
# A recorder of 32 records. Each record has 3 bytes: 9 levels and 15 bits of time.
REC = Config("rec8m", clk_hz=8_000_000, extra=(("Baud", 1_000_000), ("Watch", 9), ("Record", 5)))
# A carrier with a recorder of 16 records.
RECORDING = Config("recording8m", clk_hz=8_000_000, extra=(("Baud", 1_000_000), ("Record", 4)))
# All rate codes are available; the highest rate has exactly 5 cycles per bit.
ALL_RATES = Config("rates15m", clk_hz=15_000_000, extra=(("Baud", 115_200),))
# Few cycles per millisecond, for tests with long waits.
SLOW = Config("slow2m", clk_hz=2_000_000, extra=(("Baud", 115_200), ("Datasheet", 1)))

RATES = {1: 230_400, 2: 460_800, 3: 921_600, 4: 1_000_000, 5: 2_000_000, 6: 3_000_000}


def baud_of(config: Config) -> int:
    """Return the line rate after reset in baud."""
    return int(dict(config.extra)["Baud"])


def rates_of(config: Config) -> dict[int, int]:
    """Return the available codes and their rates in baud (UB-LIN-02)."""
    return {0: baud_of(config), **{c: r for c, r in RATES.items() if config.clk_hz >= 5 * r}}


def axes_of(config: Config) -> int:
    """Return the number of pulse counters."""
    return int(dict(config.extra).get("Axes", 1))


def params_of(config: Config) -> dict[str, int]:
    """Return the parameters of ppmc_uart_bridge."""
    return {"ClkHz": config.clk_hz, "XtalHz": config.xtal_hz, **dict(config.extra)}
