"""Speeds, rates and set-ups as numbers, under one public name. Pure.

The functions are defined in `speeds`. Functions for times of a single part are defined in the folder of that
part.
"""

from .axis import chop_byte
from .ppmc2104.registers import half_us_byte, hold_byte
from .speeds import (
    BaseClock,
    Setup,
    Speed,
    any_clock,
    choose_clock,
    motor_bits,
    nearby,
    pin_period,
    plan_setup,
)

__all__ = [
    "BaseClock",
    "Setup",
    "Speed",
    "any_clock",
    "choose_clock",
    "chop_byte",
    "half_us_byte",
    "hold_byte",
    "motor_bits",
    "nearby",
    "pin_period",
    "plan_setup",
]
