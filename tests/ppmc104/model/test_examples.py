"""Examples of the manual, and the parts of acceptance checks that last too long for the RTL, on the model."""

from __future__ import annotations

import pytest

from tests.ppmc104.model.host import INIT_A, Host

CHOPPED = "c 2A d 09 d 04 d 04 d 00"


def started(script: str, **parameters: object) -> Host:
    host = Host(**parameters)
    host.run(script)
    return host


def with_pins(script: str, move: str, **levels: int) -> Host:
    host = started(script)
    host.pins(**levels)
    host.pause(8)
    host.run(move)
    return host


def test_ac_20_immediate_stop_and_rest():
    host = started(INIT_A + " c 44 d 63 d E7 d 03 d 00")
    host.fall(10, 400)
    mark = host.mark
    host.run("c 40")
    host.mark = mark
    assert host.finish() == (0xC4, 989)
    assert len(host.pulses()) == 10
    host.run("c 44 d 63 d DD d 03 d 00")
    assert host.finish() == (0x84, 0) and len(host.pulses()) == 990


def test_ex_05_indices_and_ex_09_order():
    host = started("c 0F d 09 d 04 d 04 d 00 c 4C d 63 d 03 d 00 d 00")
    host.idle()
    shown = [value for _, value in host.model.log.of("s", host.mark)]
    assert shown == [0b10011, 0b10001, 0b11001, 0b11000]


@pytest.mark.parametrize("vsel, total", [(1, 2720), (0, 4280)])
def test_ex_07_vsel(vsel, total):
    host = with_pins(INIT_A, "c 43 d 0D d 00 d 00", vsel=vsel)
    host.idle()
    assert sum(host.intervals()) == total


def test_ex_11_flat_ramp():
    host = started("c 0A d 0A d 0A d 04 d 00 c 43 d 0B d 00 d 00")
    host.idle()
    assert host.intervals() == [352] * 11


def test_ac_47_reinitialisation_without_chopping():
    host = Host()
    host.run(CHOPPED)
    host.pause(5000)
    host.run(INIT_A)
    host.pause(40_100)
    host.sync()
    assert host.model.log.of("s")[-1][1] == 0b00011
    assert host.model.next_event is None
