"""Invariants of the golden model with random hosts, limits and clocks."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from openppmc.model import Ppmc104
from openppmc.model.motion.excitation import step_list
from openppmc.model.motion.ramp import index_profile
from tests.ppmc104.model.host import INIT_A, Host

GUARD_PINS = ("l1_n", "l2_n", "l3_n", "l4_n", "alm_n", "cnp_n")
ENDS = {
    "l1_n": (0x10, lambda op, d: d == 0),
    "l2_n": (0x10, lambda op, d: d == 1),
    "alm_n": (0x20, lambda op, d: True),
    "cnp_n": (0x00, lambda op, d: op == 7),
}

gap = st.one_of(st.integers(1, 12), st.integers(1, 400), st.integers(1, 5000))
byte = st.one_of(st.integers(0, 255), st.sampled_from([0x40, 0x41, 0x42, 0x43, 0x44, 0x46, 0x0A, 0xC0, 9, 4]))
action = st.one_of(
    st.tuples(st.just("command"), gap, byte),
    st.tuples(st.just("data"), gap, byte),
    st.tuples(st.just("init"), gap, st.sampled_from([0x0A, 0x1A, 0x2A, 0x3F, 0x05])),
    st.tuples(st.just("move"), gap, st.sampled_from([0x43, 0x4B, 0x53, 0xC3, 0xCB])),
    st.tuples(st.just("read"), gap, st.integers(0, 1)),
    st.tuples(st.sampled_from([*GUARD_PINS, "csel", "vsel", "clock"]), gap, st.integers(0, 1)),
)


def play(host: Host, actions: list[tuple[str, int, int]]) -> dict[str, list[tuple[int, int]]]:
    """Run random actions; return the history of the pins."""
    history: dict[str, list[tuple[int, int]]] = {pin: [(-1, 1)] for pin in GUARD_PINS}
    for kind, wait, value in actions:
        host.pause(wait)
        if kind in ("command", "data"):
            host.write(int(kind == "command"), value)
        elif kind == "init":
            for i, b in enumerate((value, 9, 4, 4, 0)):
                host.write(int(i == 0), b, gap=3)
        elif kind == "move":
            for i, b in enumerate((value, 13, 0, 0)):
                host.write(int(i == 0), b, gap=3)
        elif kind == "read":
            host.read(value)
        else:
            history.setdefault(kind, []).append((host.t, value))
            host.pins(**{kind: value})
    host.sync()
    return history


def level_at(history: list[tuple[int, int]], t: int) -> int:
    return [value for edge, value in history if edge <= t][-1]


@given(
    st.lists(action, max_size=40),
    st.sampled_from(["FAST", "DATASHEET"]),
    st.sampled_from([8_000_000, 11_059_200, 16_000_000, 50_000_000]),
)
def test_any_host_can_be_recovered_from(actions, timing, clk_hz):
    host = Host(timing=timing, clk_hz=clk_hz)
    history = play(host, actions)
    log = host.model.log
    dirs = [(-1, 0), *log.of("dir")]
    for fall in log.falls("pout_n"):
        limit = "l2_n" if level_at(dirs, fall) else "l1_n"
        assert level_at(history[limit], fall - 3) == 1, f"pulse at {fall} against {limit}"
        assert level_at(history["alm_n"], fall - 3) == 1, f"pulse at {fall} under alarm"
    edges = log.edges
    assert all(a.t <= b.t for a, b in zip(edges, edges[1:], strict=False))
    assert len({(e.t, e.signal) for e in edges}) == len(edges)

    t = host.t
    host.write(1, 0x40)
    host.pause(clk_hz // 1000)
    for _ in range(200):
        if host.poll(2, 0) & 4 == 0:
            break
        host.write(1, 0x40)
        host.pause(4000 * clk_hz // 16_000_000)
    assert host.read(1) & 4 == 0, f"still BUSY, recovery began at {t}"
    host.pins(**{pin: 1 for pin in (*GUARD_PINS, "csel", "vsel")})
    for code in ("c C0", INIT_A):
        host.run(code)
        host.pause(20 * clk_hz // 1000)
    assert host.run("c 82 r")[0] & 0xF8 == 0xC0
    host.run("c 43 d 0D d 00 d 00")
    host.pause(clk_hz // 500)
    host.idle()
    exact = [32 * (rate + 1) * clk_hz / 16e6 for rate in (9, 7, 5, 5, 4, 4, 4, 4, 4, 5, 5, 7, 9)]
    assert all(abs(a - b) < 1 for a, b in zip(host.intervals(), exact, strict=True))


OPERATIONS = {2: 0, 3: 3, 4: 4, 5: 1, 6: 0, 7: 1}


@st.composite
def moves(draw: st.DrawFn) -> dict:
    """Draw an operation, its ramp, and at most one disturbance that is between two pulse events."""
    operation = draw(st.sampled_from([2, 3, 3, 4, 5, 6, 7]))
    pulse_only = operation in (3, 6) and draw(st.booleans())
    rl = draw(st.integers(0, 30))
    return {
        "operation": operation,
        "pulse_only": pulse_only,
        "masked": draw(st.booleans()),
        "direction": draw(st.integers(0, 1)),
        "rl": rl,
        "rh": draw(st.integers(0, rl)),
        "pa": draw(st.integers(4, 12)),
        "n": draw(st.integers(1, 40)),
        "rate": draw(st.integers(0, 40)),
        "vsel": draw(st.integers(0, 1)),
        "fall": draw(st.integers(1, 30)),
        "after": draw(st.integers(5, 400)),
        "cause": draw(st.sampled_from([None, "0x40", "0x41", *GUARD_PINS])),
    }


@settings(max_examples=400)
@given(moves())
def test_one_move_with_one_disturbance(move):
    host = Host()
    operation, direction = move["operation"], move["direction"]
    host.run(f"c 0E d {move['rl']:02X} d {move['rh']:02X} d {move['pa']:02X} d 00")
    host.pins(vsel=move["vsel"])
    host.pause(6)
    code = (0xC0 if move["pulse_only"] else 0x40) | move["masked"] << 4 | direction << 3 | operation
    count = f" d {move['n'] - 1:02X} d 00 d 00"
    rate = f" d {move['rate']:02X}"
    endless = operation in (5, 6, 7)
    host.run(
        f"c {code:02X}" + (rate if operation in (4, 5, 7) else "") + (count if operation in (3, 4) else "")
    )
    n = 1 if operation == 2 else 1 << 24 if endless else move["n"]

    cause = move["cause"] or ("0x40" if endless else None)
    target = min(move["fall"], n - 1)
    flag_after = None
    if cause is not None and target >= 1:
        edge = host.fall(target)
        length = 4 * host.model.intervals[target - 1].quanta
        if length >= 64:
            # Keep a distance to pulse events: tests of single edges cover the coincidences.
            host.go(edge + 5 + move["after"] % (length - 30))
            flag_after = target
            if cause.startswith("0x"):
                host.write(1, int(cause, 16))
            else:
                host.pins(**{cause: 0})
    if endless and flag_after is None:
        host.command(0x40)
    ignored = False
    if endless:
        # If the operation ignores the cause, it does not end.
        host.pause(30_000)
        host.sync()
        if host.model.busy:
            host.command(0x40)
            ignored = True
    mark = host.mark
    host.idle()
    host.mark = mark
    pulses = len(host.pulses())
    assert host.out("int_n") == int(move["masked"])
    status, remaining = host.finish()
    assert status & 0x87 == 0x80 | operation
    left = n - pulses
    assert remaining == max(left - 1, 0)
    bits = status & 0x78
    assert bits == 0 if left == 0 else (bits != 0 or (operation == 7 and cause == "cnp_n"))

    ramp = operation in (3, 6)
    expected, wanted_bits = n, 0
    if flag_after is not None:
        slow = {0: "l3_n", 1: "l4_n"}[direction]
        plateau = n >= 2 * move["pa"] + 2
        if cause == "0x40" or (cause == "0x41" and not ramp):
            expected, wanted_bits = flag_after, 0x40
        elif cause in ENDS and ENDS[cause][1](operation, direction):
            expected, wanted_bits = flag_after, ENDS[cause][0]
        elif ramp and cause in ("0x41", slow):
            begin = flag_after
            if cause == slow and move["pulse_only"]:
                begin = max(begin, move["pa"] + 1) if plateau else n
            profile = [min(j - 1, n - 1 - j, move["pa"]) for j in range(1, min(n, 200))]
            natural = begin >= n or profile[begin - 1] < min(begin - 1, move["pa"])
            if not natural:
                expected = begin + 1 + profile[begin - 1]
                wanted_bits = 0x40 if cause == "0x41" else 0x08
    if ignored or (endless and flag_after is None):
        assert bits == 0x40
        return
    assert pulses == expected, (cause, flag_after)
    assert bits == (wanted_bits if left else 0)
    assert move["pulse_only"] == (host.model.log.of("s", mark) == []) or pulses == 0


@settings(max_examples=60)
@given(
    n=st.integers(1, 60),
    rate=st.integers(0, 60),
    periods=st.lists(st.integers(16, 300), min_size=20, max_size=60),
    vsel=st.integers(0, 1),
    ramp=st.booleans(),
)
def test_external_clock_counts_edges(n, rate, periods, vsel, ramp):
    """With any external clock, all N pulses are output, and there are at least rate + 1 clock edges between
    two pulses.
    """
    host = Host()
    host.run(f"c 1E d {rate:02X} d {rate // 2:02X} d 04 d 00")
    host.pins(vsel=vsel)
    host.pause(6)
    host.run((f"c 43 d {n - 1:02X}" if ramp else f"c 44 d {rate:02X} d {n - 1:02X}") + " d 00 d 00")
    rises, i = [], 0
    while host.model.busy:
        period = periods[i % len(periods)]
        host.model.pins(host.t, clock=1)
        rises.append(host.t)
        host.model.pins(host.t + period // 2, clock=0)
        host.t += period
        i += 1
        assert i < 61 * 70
        host.sync()
    pulses = host.pulses()
    assert len(pulses) == n and all(80 >= low > 0 for low in host.lows())
    rates = [interval.rate for interval in host.model.intervals]
    assert len(rates) == n - 1
    if ramp:
        assert [interval.index for interval in host.model.intervals] == index_profile(n, 4)
    effective = [rise + 3 for rise in rises]
    for interval_rate, a, b in zip(rates, pulses, pulses[1:], strict=False):
        between = sum(a < edge <= b for edge in effective)
        assert between >= interval_rate + 1
        if vsel:
            assert b in effective
    steps = step_list(4, True)
    shown = [value ^ 0 for _, value in host.model.log.of("s", host.mark)]
    assert shown == [steps[(i + 1) % 8] for i in range(n)]


@given(st.lists(st.tuples(st.integers(1, 6), st.integers(0, 1), st.integers(0, 1)), max_size=60))
def test_any_bus_noise_stores_whole_bytes_only(changes):
    """After strobes of any length, a byte was stored completely, or no byte was stored."""
    model, t = Ppmc104(), 5
    for wait, wr_n, rd_n in changes:
        model.pins(t, cs_n=0, wr_n=wr_n, rd_n=rd_n, a0=1, d_i=0x87)
        t += wait
    model.pins(t, cs_n=1, wr_n=1, rd_n=1)
    model.run_until(t + 20)
    assert model.outputs["d_oe"] == 0
    assert model.status in (0x00, 0x80)
    wrote = any(wr == 0 and rd == 1 for _, wr, rd in changes)
    assert (model.status == 0x80) == wrote
