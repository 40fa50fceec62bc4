"""Packed types of ppmc312_stage_pkg as numbers, and the blocks of the stage area with their ports."""

from __future__ import annotations

from typing import NamedTuple

from openppmc.model.ppmc312.stages import LAST, Table

from ...harness import Block

AREA = "stage"
GROUPS = ("common", "motion", "stage")
CLOCKS = (8_000_000, 16_000_000, 50_000_000)
"""Clock frequencies of the instances of ppmc312_interval, with a 16 MHz crystal."""
PACKAGE = "ppmc312_stage_pkg::"
INTERVAL = "base_i:3 extck_i arm_i first_i fire_i rate_i:16 ready_o high_o"
BLOCKS = {
    "muldiv": Block(
        "ppmc312_muldiv",
        "start_i mul_i keep_i steps_i:6 lo_i:24 operand_i:40 busy_o hi_o:40 lo_o:24",
    ),
    "rom": Block("ppmc312_cosine_rom", "clk_i linear_i index_i:7 weight_o:17", bare=True),
    "unit": Block(
        "ppmc312_stage_unit",
        f"drop_i build_i curve_i:101:{PACKAGE}curve_t busy_o too_few_pulses_o open_i open_acc_i:7"
        f" open_dec_i:7 table_write_i:34:{PACKAGE}table_write_t close_i table_o:115 start_target_o:38"
        f" read_addr_i:8:{PACKAGE}table_addr_t read_stage_o:40 profile_req_i:51:{PACKAGE}profile_req_t"
        f" plan_busy_o plan_kind_o:8 profile_o:128 table_addr_i:8:{PACKAGE}table_addr_t"
        " stage_o:40",
    ),
    "seq": Block(
        "ppmc312_stage_seq",
        f"first_acc_i:7 first_dec_i:7 rate_dec_i:16 table_addr_o:8 stage_i:40:{PACKAGE}stage_t"
        f" load_i profile_i:128:{PACKAGE}profile_t single_i change_i change_ramp_i slow_i"
        " next_end_o next_low_o next_count_o next_slow_o next_final_decel_o next_rate_o:16 step_i"
        " rate_o:16 const_rate_o final_decel_o first_o complete_o",
    ),
    **{
        f"interval{clk // 1_000_000}": Block(
            "ppmc312_interval", INTERVAL, {"ClkHz": clk, "XtalHz": 16_000_000}
        )
        for clk in CLOCKS
    },
}


def pack(*fields: tuple[int, int]) -> int:
    """Return a packed struct of (value, width) fields, the most significant field first."""
    number = 0
    for value, width in fields:
        assert 0 <= value < 1 << width, f"{value} does not fit {width} bits"
        number = number << width | value
    return number


class Target(NamedTuple):
    """target_t: a rate and its look-up result.

    Attributes:
        ge: t(rate), the last stage that is not faster than `rate`; without one, the first used stage - 1.
    """

    rate: int
    slows: int
    ge: int
    ge1: int
    gt1: int

    @classmethod
    def of(cls, table: Table, rate: int) -> Target:
        """Return the look-up result of a rate in a table."""
        at, above = table.stage(rate), table.stage(rate + 1)
        return cls(rate, int(rate < table.rates[table.sd]), at % 128, at + 1, above + 1)

    @classmethod
    def split(cls, number: int) -> Target:
        """Return the fields of a packed target_t."""
        return cls(number >> 22, number >> 21 & 1, number >> 14 & 0x7F, number >> 7 & 0x7F, number & 0x7F)

    @property
    def packed(self) -> int:
        """Value of the packed struct."""
        return pack((self.rate, 16), (self.slows, 1), (self.ge, 7), (self.ge1, 7), (self.gt1, 7))


def walk_start(table: Table, pulses: int) -> tuple[int, int]:
    """Return the stage in which the last `pulses` pulses of the deceleration begin.

    Also return the number of these pulses that are in this stage.
    """
    stage = next(i for i in range(table.sd, LAST + 1) if table.sums_down[i] >= pulses)
    return stage, pulses - (table.sums_down[stage - 1] if stage else 0)


def brief(table: Table) -> str:
    """Return the used stages of a table as text."""
    first = table.first
    return f"{table.rates[first:]} up {table.pa[first:]} down {table.pd[first:]}, from {table.sa}, {table.sd}"
