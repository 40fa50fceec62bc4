"""Parameters of the PPMC-312's golden model."""

from __future__ import annotations

from typing import Any

import pytest

from openppmc.model.ppmc312.part import Ppmc312


@pytest.mark.parametrize(
    "bad",
    [{"timing": "SLOW"}, {"clk_hz": 1}, {"version": 256}, {"xtal_hz": 17_000_000}, {"sum_mode": "NONE"}],
    ids=lambda bad: next(iter(bad)),
)
def test_parameters_out_of_range(bad: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=next(iter(bad))):
        Ppmc312(**bad)
