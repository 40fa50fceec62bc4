"""Scripts: electrical angle, references, currents, compensation, hold and decay."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.verifies import verifies

from .reference import HOME, boost, code, increment, lead, sines
from .scenes import after_steps, brisk, move, quick, rest, run, start
from .script_host import EXECUTE, Host

REFS = 64
"""clk from a cause to the references."""
NAMES = ("phase_a_ref", "phase_a_sign", "phase_b_ref", "phase_b_sign")


def shown(host: Host, t: int) -> tuple[int, ...]:
    """References after edge t."""
    return tuple(host.level_at(name, t) for name in NAMES)


@pytest.mark.parametrize("m", [0, 2, 4, 8, 16, 32, 64, 128])
@verifies(
    "P006-EXC-01", "P006-EXC-02", "P006-EXC-10", "P006-EXC-11", "P006-EXC-12", "P006-EXC-13", "P006-EXC-15"
)
def test_angle_of_every_step(m: int) -> None:
    """A full step at least, both ways, with all four outputs within 64 clk of the step and in one clk."""
    host = brisk(Host(), 1000 if m > 1 else 600, m=m, a=0, e=4000, M=100, P=300)
    angle = HOME
    for direction in (1, 0):
        host.ok(d=direction)
        start(host, 9)
        mark = host.mark
        rest(host)
        host.pause(REFS)
        for edge in host.steps(mark):
            angle += increment(m) if direction else -increment(m)
            ahead = lead(1000 if m > 1 else 600, m, 300) * (1 if direction else -1)
            after = edge + REFS
            raised = min(255, 255 + boost(4000, 1000, m, 100))
            wanted = {sines(angle, 255), sines(angle + ahead, raised)}
            assert shown(host, after) in wanted, f"angle {angle}"
            assert len({t for name in NAMES for t, _ in host.edges(name, edge) if t <= after}) <= 1
        assert host.refs() == sines(angle, 255)


@verifies("P006-EXC-14", "P006-EXC-10", "P006-EXC-11")
def test_table_of_angles() -> None:
    table = {
        (0, 64): (64, 0, 0, 0),
        (32, 64): (59, 0, 25, 0),
        (128, 64): (0, 0, 64, 0),
        (192, 64): (45, 1, 45, 0),
        (256, 64): (64, 1, 0, 0),
        (320, 64): (45, 1, 45, 1),
        (384, 64): (0, 0, 64, 1),
        (448, 64): (45, 0, 45, 1),
        (96, 255): (98, 0, 236, 0),
        (320, 255): (180, 1, 180, 1),
    }
    assert all(sines(angle, peak) == row for (angle, peak), row in table.items())
    host = brisk(Host(), 3000, m=4, a=0)
    for current, peak in ((1000, 64), (4000, 255)):
        host.ok(e=current)
        for number in range(16):
            assert host.refs() == sines(HOME + 32 * number, peak)
            if (key := ((HOME + 32 * number) % 512, peak)) in table:
                assert host.refs() == table[key]
            move(host, 1)
            host.pause(REFS)


@verifies("P006-EXC-03", "P006-CMD-54")
def test_nothing_but_steps_moves_the_angle() -> None:
    """From fine to coarse the grid is the angle's own; settings and stops leave it."""
    host = brisk(Host(), 3000, m=128, a=0)
    move(host, 5)
    host.pause(REFS)
    held = host.refs()
    assert held == sines(HOME + 5, code(800))
    for setting in ({"m": 0}, {"d": 0}, {"i": 1000}, {"d": 1}, {"g": 1}, {"g": 0}, {"u": 5}):
        host.ok(**setting)
    assert host.refs() == held and host.ask("I") == 0
    move(host, 3)
    host.pause(REFS)
    assert host.refs() == sines(HOME + 5 + 3 * 128, code(800))
    host.ok(m=64, d=0)
    move(host, 2)
    host.pause(REFS)
    assert host.refs() == sines(HOME + 5 + 3 * 128 - 4, code(800))


@verifies("P006-EXC-20", "P006-CMD-26", "P006-CMD-35")
def test_currents() -> None:
    """Both sides of borders between drive indices, the ends included."""
    host = Host()
    host.ok(a=0)
    printed = (26, 35, 45, 54, 64, 73, 83, 92, 102, 112, 121, 131, 140, 150, 159, 169, 179, 188, 198, 207)
    printed += (217, 226, 236, 245, 255)
    assert printed == tuple(code(400 + 150 * k) for k in range(25))
    for k in (0, 1, 3, 4, 11, 12, 23, 24):
        for current in {max(400, 325 + 150 * k), min(4000, 325 + 150 * k + 149)}:
            host.ok(e=current)
            assert host.refs() == sines(HOME, printed[k]), f"{current} mA"
            assert host.ask("n") == current


@verifies("P006-EXC-21", "P006-EXC-22", "P006-EXC-23", "P006-EXC-24", "P006-CMD-10", "P006-CMD-13")
@pytest.mark.parametrize(
    ("m", "e", "ccomp", "scomp", "speed", "forward"),
    [
        (0, 1000, 300, 1250, 3000, 1),
        (0, 1000, 300, 1250, 3000, 0),
        (2, 4000, 1200, 2000, 3000, 1),
        (2, 2000, 1200, 700, 2345, 0),
        (0, 400, 1200, 2000, 2999, 1),
        (16, 1000, 300, 1250, 3000, 1),
    ],
)
def test_compensation(m: int, e: int, ccomp: int, scomp: int, speed: int, forward: int) -> None:
    """0 up to the first update tick, then that of the speed in force, 0 again at rest."""
    host = brisk(Host(), speed, m=m, e=e, M=ccomp, P=scomp, d=forward, a=0)
    run(host)
    mark = host.mark
    after_steps(host, 9)
    peak = min(255, code(e) + boost(e, speed, m, ccomp))
    sign = 1 if forward else -1
    angle = HOME
    for number, edge in enumerate(host.steps(mark)[:8]):
        angle += sign * increment(m)
        assert shown(host, edge + REFS) == sines(angle + sign * lead(speed, m, scomp), peak), f"step {number}"
    first = host.edges("mon_busy", mark)[0][0]
    assert shown(host, first + host.us(50)) == sines(HOME, code(e))
    assert host.ask("I") == 0
    host.pause(REFS)
    assert host.refs() == sines(HOME + sign * increment(m) * host.made(mark), code(e))


@verifies("P006-EXC-22", "P006-EXC-23", "P006-CMD-54", "P006-CMD-10", "P006-CMD-13")
def test_factors_act_at_once() -> None:
    """CCOMP, SCOMP, CUR of a running motion; MSTEP is its own."""
    host = brisk(Host(), 2000, m=0, a=0, e=1000)
    run(host)
    mark = host.mark
    for settings in ({"M": 1200}, {"P": 300}, {"e": 2500}, {"m": 128}):
        host.ok(**settings)
    host.wait_us(400)
    after_steps(host, host.made(mark) + 1)
    host.pause(REFS)
    angle = HOME + 128 * host.made(mark)
    assert host.refs() == sines(angle + lead(2000, 0, 300), min(255, code(2500) + boost(2500, 2000, 0, 1200)))
    host.ask("I")


@verifies("P006-EXC-30", "P006-EXC-31", "P006-EXC-32", "P006-CMD-14", "P006-CMD-22", "P006-STA-03")
def test_decay() -> None:
    """100 ms behind the fall of BUSY; all coefficients; what acts at once, and what does not."""
    host = quick()
    start(host, 1)
    fall = rest(host)
    host.ok(g=1)
    host.ok(g=0)
    host.go(fall + host.us(99_990))
    assert host.refs() == sines(HOME + 8, code(800))
    host.go(fall + host.us(100_010) + REFS)
    assert host.refs() == sines(HOME + 8, code(800) >> 1)
    for factor in (4, 2, 3, 1):
        host.ok(Q=factor)
        assert host.refs() == sines(HOME + 8, code(800) >> factor)
    host.ok(a=0)
    assert host.refs() == sines(HOME + 8, code(800))
    host.ok(a=1)
    change = host.edges("phase_a_ref", host.said)[0][0]
    assert host.e <= change <= host.e + EXECUTE + REFS
    assert host.ask("s", 0) == 0 and host.refs() == sines(HOME + 8, code(800) >> 1)
    host.ok(v=100)
    assert host.ask("s", 3) == 0 and host.refs() == sines(HOME + 8, code(800) >> 1)
    run(host)
    change = host.edges("phase_a_ref", host.said)[0][0]
    assert host.e <= change <= host.e + EXECUTE + REFS and host.refs() == sines(HOME + 8, code(800))
    host.ask("I")
    assert host.refs() == sines(HOME + 8, code(800))


@verifies("P006-STA-12", "P006-EXC-30", "P006-CMD-28")
def test_free() -> None:
    """Everything off at once; the hold current comes back at the kept angle."""
    host = quick()
    host.ok(e=2000)
    start(host, 500)
    after_steps(host, 11)
    host.ok(g=1)
    made = host.made(0)
    off = host.edges("bridge_a_en", host.said)[0]
    assert host.e <= off[0] <= host.e + EXECUTE + 5 and not off[1] and host.refs() == (0, 0, 0, 0)
    assert not host.steps(off[0] + 5) and host.position() == made
    host.ok(g=0)
    assert host.refs() == sines(HOME + 8 * made, code(2000)) and host.out("bridge_b_en")
