"""A polling host on the pins of the PPMC-104 model, for the self-tests of the model."""

from __future__ import annotations

from openppmc.model import Latency, Ppmc104
from tests.common.model.host import ModelHost

# Fixed latencies, independent of the RTL, so that tests of single edges do not change with the constants of
# the RTL.
NOMINAL = Latency(
    c_event=2,
    window_open=1,
    host_pins=0,
    motor_pins=1,
    start_extra=1,
    end_extra=0,
    imm_end=1,
    flag_lead=1,
    queue_next=2,
    ds_host=0,
    ds_waited=0,
    ds_motor=0,
    ds12_lag=1,
    lookup_start=0,
    lookup_first=0,
    lookup_per_rate=0,
    build_clk=lambda rl, rh, pa: 300,
)
INIT_A = "c 0A d 09 d 04 d 04 d 00"
INIT_B = "c 0A d 13 d 09 d 0A d 00"


class Host(ModelHost):
    """`ModelHost` of the PPMC-104."""

    MODEL = Ppmc104
