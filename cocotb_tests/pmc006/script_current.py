"""Scripts: a motor in place of constant comparators, so that the choppers regulate a real current."""

from __future__ import annotations

from itertools import pairwise

from cocotb_tests.harness.verifies import verifies
from openppmc.model.pmc006.bench.motor import Motor, Plant

from .scenes import brisk, run, start
from .script_host import Host


def ready(motor: Motor | None = None, **settings: int) -> tuple[Host, Plant]:
    """A part that holds its full current in a motor."""
    host = Host()
    host.ok(a=0, **settings)
    return host, Plant(host.model, host.clk_hz, motor)


def off_by(host: Host, plant: Plant, since: int, until: int | None = None) -> float:
    """Largest difference of a current and its reference between two edges, ampere."""
    host.sync()
    times = [t / host.clk_hz for t in range(since, until or host.t, 40)]
    return max(abs(one.current(t) - one.reference(t)) for one in plant.windings.values() for t in times)


@verifies("P006-CHP-02", "P006-CHP-03", "P006-CHP-04", "P006-CHP-06")
def test_regulated_at_rest_and_after_a_fall() -> None:
    """The currents stay at the reference; fast decay brings them to a smaller one."""
    host, plant = ready(e=2000)
    host.ms(1)
    since = host.t
    host.ms(1)
    assert off_by(host, plant, since) < 0.04
    host.ok(e=500)
    host.ms(0.3)
    since = host.t
    host.ms(0.5)
    assert off_by(host, plant, since) < 0.04
    pulses = {pin: len(host.edges(pin, since)) // 2 for pin in ("m10", "m11", "m20", "m21")}
    # One on or fast pulse in each 20 us and a little.
    assert all(15 < pulses[a] + pulses[b] < 26 for a, b in (("m10", "m11"), ("m20", "m21")))


@verifies("P006-CHP-03", "P006-CHP-04", "P006-EXC-13")
def test_regulated_in_motion() -> None:
    """A cycle in half steps, with back EMF, forward and backward."""
    host, plant = ready(e=1000, m=2)
    brisk(host, 2000)
    plant.spin(4.0, 250, 1.0)
    for direction in (1, 0):
        host.ok(d=direction)
        start(host, 10)
        since = host.t
        host.until("mon_busy", 0)
        # Between two steps of 0.5 ms each current comes to its reference.
        for before, after in pairwise(host.steps(since)):
            assert after - before == host.us(500)
            assert off_by(host, plant, after - host.us(50), after) < 0.1
    host.ms(1)
    assert off_by(host, plant, host.t - 2000) < 0.1


@verifies("P006-CHP-04", "P006-CHP-03")
def test_nothing_is_left_at_a_reference_of_0() -> None:
    """Half steps: phase B from 71 % to 0, where no sign changes; fast decay takes the current away."""
    host, plant = ready(e=2000, m=2, P=300)
    brisk(host, 1000)
    start(host, 3)
    host.until("mon_busy", 0)
    host.ms(0.7)
    winding = plant.windings["b"]
    assert not host.out("phase_b_ref") and not host.out("phase_b_sign")
    assert max(abs(winding.current(t / host.clk_hz)) for t in range(host.t - 2000, host.t, 40)) < 0.05


@verifies("P006-CHP-01", "P006-STA-12")
def test_released_and_taken_back() -> None:
    """Without bridges the current dies in the diodes; it comes back in the next cycle."""
    host, plant = ready(Motor(2.0, 1e-3, 12.0), e=3000)
    brisk(host, 3000)
    run(host)
    host.ms(2)
    host.ok(g=1)
    host.ms(0.5)
    assert all(one.current(plant.seconds(host.t)) == 0 for one in plant.windings.values())
    host.ok(g=0)
    host.ms(1)
    assert off_by(host, plant, host.t - 2000) < 0.15
