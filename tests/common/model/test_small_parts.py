"""Excitation tables, time base, edge log, scheduler and predictor of the golden models."""

from __future__ import annotations

from fractions import Fraction
from math import ceil

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cocotb_tests.harness import verifies
from openppmc.model import Ppmc104, predict_move
from openppmc.model.clock import Edge, EdgeLog, Latency, QuantumCounter, Scheduler, Timebase, low_times
from openppmc.model.motion.excitation import Excitation, step_list
from openppmc.model.single.codes import Kind, decode

TABLES = {
    (3, False): "00011 00110 00101",
    (3, True): "00011 00010 00110 00100 00101 00001",
    (4, False): "00011 00110 01100 01001",
    (4, True): "00011 00010 00110 00100 01100 01000 01001 00001",
    (5, False): "00011 00110 01100 11000 10001",
    (5, True): "00011 00111 00110 01110 01100 11100 11000 11001 10001 10011",
}


@verifies("P104-PHS-01", "P104-PHS-06")
@pytest.mark.parametrize("motor", TABLES)
def test_step_lists(motor):
    phases, half = motor
    steps = step_list(*motor)
    assert steps == tuple(int(word, 2) for word in TABLES[motor].split())
    if half:
        assert steps[::2] == step_list(phases, False)
    # Consecutive patterns differ in one phase (half step) or in a pair of phases (full step).
    changes = {bin(a ^ b).count("1") for a, b in zip(steps, steps[1:] + steps[:1], strict=True)}
    assert changes == ({1} if half else {2})
    with pytest.raises(ValueError, match="2 phases"):
        step_list(2, half)


@verifies("P104-PHS-02", "P104-PHS-03", "P104-PHS-05")
def test_excitation_levels():
    motor = Excitation(idle=0)
    motor.off()
    assert motor.pattern == motor.chopped == 0
    motor.configure(4, False, positive=False)
    motor.step(1)
    assert motor.pattern == 0b01001 ^ 31 and motor.chopped == 31
    motor.off()
    assert motor.pattern == 31
    motor.configure(4, True, positive=True)
    assert (motor.index, motor.pattern, motor.chopped) == (0, 3, 0)
    motor.off()
    assert motor.pattern == 0


@verifies("P104-GEN-02", "P104-GEN-03", "P104-GEN-04")
@given(st.integers(8_000_000, 200_000_000), st.integers(1_000_000, 16_000_000), st.integers(0, 10**7))
def test_time_conversion(clk_hz, xtal_hz, n):
    base = Timebase(clk_hz, xtal_hz)
    exact = Fraction(n * clk_hz, xtal_hz)
    assert base.cyc(n) == ceil(exact) and base.tick(n) == ceil(4 * exact)
    assert abs(base.nearest(n) - exact) <= Fraction(1, 2)
    clk = n % 100_000
    last = base.ticks_in(clk)
    assert base.tick(last) <= clk < base.tick(last + 1)


def test_time_limits():
    for clk_hz, xtal_hz in ((7_999_999, 16_000_000), (16_000_000, 999_999), (16_000_000, 16_000_001)):
        with pytest.raises(ValueError, match="outside"):
            Timebase(clk_hz, xtal_hz)
    counter = QuantumCounter(Timebase(), 100)
    assert counter.edge_of(3) == 112 and counter.last_tick(111) == 2 and counter.last_tick(0) == 0
    assert Timebase(8_000_000, 16_000_000).nearest(1) == 1
    assert Latency(build_clk=lambda rl, rh, pa: rl + pa).build(5, 1, 7) == 12


def test_edge_log_keeps_real_changes():
    log = EdgeLog({"a": 0, "b": 1})
    for t, signal, value in ((3, "a", 1), (3, "a", 1), (4, "b", 0), (4, "a", 0), (4, "b", 1), (6, "a", 1)):
        log.set(t, signal, value)
    assert log.edges == [Edge(3, "a", 1), Edge(4, "a", 0), Edge(6, "a", 1)]
    assert log.of("a", 4) == [(4, 0), (6, 1)] and log.rises("a") == [3, 6] and log.falls("a") == [4]
    assert low_times([(1, 1), (4, 0), (9, 1), (12, 0)]) == [5]
    with pytest.raises(KeyError):
        log.set(7, "c", 0)


def test_scheduler_order():
    queue, seen = Scheduler(), []
    queue.at(5, 2, lambda t: seen.append("late"))
    queue.at(5, 1, lambda t: seen.append("early"))
    queue.at(5, 1, lambda t: queue.at(t, 3, lambda t: seen.append("added")))
    queue.at(5, 1, lambda t: seen.append("never")).cancel()
    assert queue.next_edge() == 5
    queue.run_edge(5)
    queue.now = 5
    assert seen == ["early", "late", "added"] and queue.next_edge() is None
    with pytest.raises(ValueError, match="edge 5 is done"):
        queue.at(5, 0, lambda t: None)


@verifies("P104-CMD-01", "P104-CMD-02", "P104-CMD-03")
def test_code_map():
    kinds = [decode(code).kind for code in range(256)]
    assert kinds.count(Kind.UNDEFINED) == 97 and len(kinds) - 97 == 159
    for code in range(256):
        if code & 0x40:
            assert decode(code).kind is decode(code ^ 0x20).kind
    assert decode(0xDB).masked and decode(0xDB).pulse_only and decode(0xDB).direction == 1
    assert [decode(c).parameters for c in (0x01, 0x42, 0x43, 0x44, 0x45, 0x46, 0x47)] == [4, 0, 3, 4, 1, 0, 1]
    with pytest.raises(ValueError, match="256"):
        decode(256)


def test_model_refuses_nonsense():
    for wrong in ({"timing": "fast"}, {"phase_idle": 2}, {"clk_hz": 1}, {"xtal_hz": 1}):
        with pytest.raises(ValueError):
            Ppmc104(**wrong)
    model = Ppmc104()
    model.run_until(10)
    for call in (
        lambda: model.pins(10, csel=0),
        lambda: model.run_until(9),
        lambda: model.pins(11, nothing=0),
        lambda: model.pins(11, csel=2),
        lambda: model.pins(11, d_i=256),
    ):
        with pytest.raises(ValueError):
            call()
    assert model.edges == []


@given(st.data())
def test_predictor_meets_the_model(data):
    rl = data.draw(st.integers(0, 60))
    init = [rl, data.draw(st.integers(0, rl)), data.draw(st.integers(4, 20)), 0]
    n, rate = data.draw(st.integers(1, 60)), data.draw(st.one_of(st.none(), st.integers(0, 255)))
    csel, vsel = data.draw(st.integers(0, 1)), data.draw(st.integers(0, 1))
    clk_hz = data.draw(st.sampled_from([8_000_000, 11_059_200, 16_000_000, 50_000_000]))
    model = Ppmc104(clk_hz=clk_hz)
    model.pins(4, csel=csel, vsel=vsel)
    t = 20
    head = [0x43] if rate is None else [0x44, rate]
    for reg, byte in [(1, 0x0A), *((0, b) for b in init)]:
        t = model.write(t, reg, byte) + 6
    t += 40_000
    for i, byte in enumerate([*head, n - 1, 0, 0]):
        t = model.write(t, int(i == 0), byte) + 6
    model.run_until(t)
    while model.busy:
        model.run_until(model.next_event)
    move = predict_move(bytes(init), n, rate, csel, vsel, Timebase(clk_hz))
    assert [p - model.pulses[0] for p in model.pulses] == list(move.clk)
    assert [i.rate for i in model.intervals] == list(move.rates)
    assert move.seconds[-1] == pytest.approx(move.clk[-1] / clk_hz)


@verifies("P104-EX-01", "P104-EX-03", "P104-EX-06", "P104-EX-07", "P104-EX-12")
def test_predicted_examples():
    move = predict_move(bytes((9, 4, 4, 0)), 14)
    assert move.clk[-1] == 2720 and predict_move(bytes((9, 4, 4, 0)), 14, vsel=0).clk[-1] == 4280
    assert predict_move(bytes((199, 49, 100, 0)), 1000).clk[-1] == 1_795_008
    assert predict_move(bytes((199, 49, 100, 0)), 1000, csel=0).clk[-1] == 7_180_032
    assert predict_move(bytes((9, 4, 4, 0)), 5, rate=99).speeds == [5000.0] * 4
    odd = predict_move(bytes((9, 4, 4, 0)), 1001, rate=0, timebase=Timebase(11_059_200))
    assert [odd.clk[i] for i in (1, 2, 3, 1000)] == [23, 45, 67, 22119]
    for wrong in ((b"\x09\x04\x04", 1), (bytes((4, 9, 4, 0)), 1), (bytes((9, 4, 3, 0)), 1)):
        with pytest.raises(ValueError):
            predict_move(*wrong)
    with pytest.raises(ValueError, match="0 pulses"):
        predict_move(bytes((9, 4, 4, 0)), 0)
    with pytest.raises(ValueError, match="rate 256"):
        predict_move(bytes((9, 4, 4, 0)), 2, rate=256)


@verifies("P104-HSK-04", "P104-FDC-06")
def test_constants_of_the_core_lie_in_the_windows_of_the_rules():
    core = Latency()
    windows = {
        "c_event": (0, 8),
        "host_pins": (0, 2),
        "motor_pins": (0, 2),
        "start_extra": (0, 2),
        "end_extra": (0, 4),
        "imm_end": (0, 4),
        "flag_lead": (0, 4),
        "queue_next": (0, 4),
        "ds_host": (0, 14),
        "ds_waited": (0, 14),
        "ds_motor": (0, 14),
    }
    for name, (low, high) in windows.items():
        assert low <= getattr(core, name) <= high, name
    assert core.input_sync == 2
    assert max(core.build(rl, rh, pa) for rl in (0, 255) for rh in (0, rl) for pa in (4, 11220)) <= 40_000
