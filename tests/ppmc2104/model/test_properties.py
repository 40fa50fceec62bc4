"""Invariants of the golden model of the PPMC-2104 with random hosts, switches and clocks."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from openppmc.model.motion.codes import Kind
from openppmc.model.ppmc2104.codes import decode
from openppmc.model.ppmc2104.part import Ppmc2104
from tests.ppmc2104.model.host import B1, Host

SWITCHES = ("fl_n", "bl_n", "fhl_n", "bhl_n", "alm_n", "org_n")
AXIS_2_OUTPUTS = ("pout_n", "dir", "hold")

gap = st.one_of(st.integers(1, 12), st.integers(1, 400), st.integers(1, 5000))
byte = st.one_of(
    st.integers(0, 255),
    st.sampled_from([0x40, 0x41, 0x42, 0x43, 0x44, 0x46, 0x60, 0x61, 0x63, 0x02, 0xC0, 9, 4, 0x80, 0xA6]),
)
action = st.one_of(
    st.tuples(st.just("code"), gap, byte),
    st.tuples(st.just("data"), gap, byte),
    st.tuples(st.just("setting"), gap, st.sampled_from([0x02, 0x12, 0x0A, 0x22, 0x36, 0x2B])),
    st.tuples(st.just("move"), gap, st.sampled_from([0x43, 0x4B, 0x53, 0xC3, 0x63, 0x6B, 0x73, 0xEB])),
    st.tuples(st.just("read"), gap, st.integers(0, 1)),
    st.tuples(st.sampled_from([*SWITCHES, "run", "csel", "extck"]), gap, st.integers(0, 3)),
    st.tuples(st.just("errint_n"), gap, st.integers(0, 1)),
)


def play(host: Host, actions: list[tuple[str, int, int]]) -> dict[str, list[tuple[int, int]]]:
    """Run random actions; return the history of the pins."""
    history: dict[str, list[tuple[int, int]]] = {pin: [(-1, 3)] for pin in SWITCHES}
    for kind, wait, value in actions:
        host.pause(wait)
        if kind in ("code", "data"):
            host.write(int(kind == "code"), value)
        elif kind == "setting":
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
    st.integers(0, 1),
)
def test_any_host_can_be_recovered_from(actions, timing, clk_hz, busc):
    host = Host(timing=timing, clk_hz=clk_hz, busc=busc)
    history = play(host, actions)
    if timing == "FAST":
        for axis in (1, 2):
            dirs = [(-1, 0), *host.model.bits("dir", axis)]
            for fall in host.model.pulses(axis):
                limit = "bl_n" if level_at(dirs, fall) else "fl_n"
                for pin in (limit, "alm_n"):
                    assert level_at(history[pin], fall - 3) >> (axis - 1) & 1, f"pulse at {fall} on {pin}"
    edges = host.model.edges
    assert all(a.t <= b.t for a, b in zip(edges, edges[1:], strict=False))
    assert len({(e.t, e.signal) for e in edges}) == len(edges)

    host.poll(0x02, 0)
    for _ in range(200):
        if host.poll(2, 0) & 0x0C == 0:
            break
        for code in (0x40, 0x60):
            host.command(code)
        host.pause(4000 * clk_hz // 16_000_000)
    assert host.status() & 0x0C == 0
    host.pins(**dict.fromkeys((*SWITCHES, "run", "csel"), 3))
    host.pause(2000)
    host.run("c C0 c C0 c 02 d 09 d 04 d 04 d 00 ready")
    while host.status() & 1:
        host.read(0)
    assert host.run("c 82 r")[0] & 0xF8 == 0x38
    if timing == "DATASHEET":
        host.run("c 02 d 1C d 17 d 04 d 00 ready c E0")
    host.run("c 43 d 0D d 00 d 00")
    host.pause(clk_hz // 100)
    host.idle()
    rates = (9, 7, 5, 5, 4, 4, 4, 4, 4, 5, 5, 7, 9)
    if timing == "FAST":
        exact = [32 * (rate + 1) * clk_hz / 16e6 for rate in rates]
        assert all(abs(a - b) < 1 for a, b in zip(host.intervals(), exact, strict=True))
    assert len(host.pulses()) == 14


# --------------------------------------------------------------- two axes, one processor


axis_1_instruction = st.one_of(
    st.sampled_from(
        [(0x42,), (0x40,), (0x41,), (0x4A,), (0x46,), (0x80,), (0x86,), (0x87,), (0xC0,), (0xC6,)]
    ),
    st.sampled_from([(0x43, 13, 0, 0), (0x4B, 3, 0, 0), (0xC3, 60, 0, 0), (0x44, 1, 9, 0, 0), (0x45, 7)]),
    st.sampled_from([(0x02, 9, 4, 4, 0), (0x1E, 20, 2, 9, 0), (0x02, 5, 9, 9, 9), (0x84, 64, 64), (0x85, 0)]),
)
axis_1_action = st.one_of(
    st.tuples(st.just("host"), axis_1_instruction),
    st.tuples(st.sampled_from([*SWITCHES, "run", "csel", "extck"]), st.integers(0, 1)),
)


def axis_2_edges(model: Ppmc2104) -> list[tuple[int, str, int]]:
    """Return all output edges of axis 2, sorted by time."""
    shared = [(t, signal, bit) for signal in AXIS_2_OUTPUTS for t, bit in model.bits(signal, 2)]
    return sorted(shared + [(t, "s2_n", value) for t, value in model.log.of("s2_n")])


def two_runs(moves: list, traffic: list | None, clk_hz: int) -> Ppmc2104:
    """Run the moves of axis 2 at fixed edges; between them is the traffic to axis 1, if any."""
    host = Host("c 36 d 09 d 04 d 04 d 00 ready", clk_hz=clk_hz)
    start, rest = 20_000, iter(traffic or [])
    for place, (code, data, pin, offset) in enumerate(moves):
        begin = start + 60_000 * place
        host.go(begin)
        for reg, value in [(1, code), *((0, b) for b in data)]:
            host.write(reg, value, gap=4)
        switched = begin + 300 + offset
        done = False
        for kind, what in rest if traffic else ():
            if not done and host.t + 300 > switched:
                host.go(max(host.t, switched))
                host.pin(pin, 0, 2)
                done = True
            if kind == "host":
                for reg, value in [(1, what[0]), *((0, b) for b in what[1:])]:
                    host.write(reg, value, gap=4)
            else:
                host.pin(kind, what)
            host.pause(97)
            if host.t > begin + 50_000:
                break
        if not done:
            host.go(switched)
            host.pin(pin, 0, 2)
        host.go(begin + 55_000)
        host.pin(pin, 1, 2)
    host.pause(60_000)
    host.sync()
    return host.model


def axis_2_move() -> st.SearchStrategy:
    code = st.sampled_from(
        [(0x62, 0), (0x63, 3), (0x6B, 3), (0xE3, 3), (0x64, 4), (0x65, 1), (0x66, 0), (0x6F, 1)]
    )
    return st.builds(
        lambda kind, n, rate, pin, offset: (
            kind[0],
            ([rate] if kind[1] in (1, 4) else []) + ([n, 0, 0] if kind[1] > 1 else []),
            pin,
            offset,
        ),
        code,
        st.integers(0, 60),
        st.integers(1, 20),
        st.sampled_from(SWITCHES),
        st.integers(0, 8000).map(lambda k: 331 * (k % 25)),
    )


@settings(max_examples=60)
@given(
    st.lists(axis_2_move(), min_size=1, max_size=4),
    st.lists(axis_1_action, min_size=1, max_size=60),
    st.sampled_from([16_000_000, 11_059_200]),
)
def test_axis_1_never_changes_axis_2(moves, traffic, clk_hz):
    """Traffic to axis 1 never changes an edge of axis 2 (P2104-OPR-10, P2104-BCK-05, P2104-STP-06)."""
    # Pin changes of axis 2 must be on the same edges in both runs, so the traffic pauses before them.
    alone = two_runs(moves, None, clk_hz)
    beside = two_runs(moves, traffic, clk_hz)
    assert [e[1:] for e in axis_2_edges(alone)] and axis_2_edges(alone) == axis_2_edges(beside)


# --------------------------------------------------------------- counts


@settings(max_examples=200)
@given(
    n=st.integers(1, 60),
    rl=st.integers(3, 30),
    span=st.integers(2, 27),
    pa=st.integers(4, 20),
    code=st.sampled_from([0x43, 0x4B, 0xC3, 0x44, 0x46, 0x45, 0x47]),
    cause=st.sampled_from([None, "40", "41", *SWITCHES]),
    fall=st.integers(1, 40),
    after=st.integers(6, 500),
)
def test_pulses_and_remaining_value_add_up(n, rl, span, pa, code, cause, fall, after):
    """After j of N pulses, m = N - j pulses remain; if m > 0, one of bits 6-3 is 1, except at the origin
    (P2104-END-05, P2104-END-06).
    """
    rh = max(1, rl - span)
    host = Host(f"c 02 d {rl:02X} d {rh:02X} d {pa:02X} d 00 ready")
    rate = " d 09" if code & 7 in (4, 5, 7) else ""
    count = f" d {n - 1:02X} d 00 d 00" if code & 7 in (3, 4) else ""
    total = n if count else 1 << 24
    host.run(f"c {code:02X}{rate}{count}")
    mark = host.mark
    if cause is not None and fall < total:
        host.go(max(host.fall(fall) + after, host.t))
        if cause in SWITCHES:
            host.pin(cause, 0)
        else:
            host.write(1, int(cause, 16))
    if total > n:
        host.pause(40_000)
        host.write(1, 0x40)
    host.mark = mark
    status, remaining = host.end()
    pulses = len(host.pulses())
    assert status & 0x87 == 0x80 | code & 7
    assert 1 <= pulses <= total and remaining == max(total - pulses - 1, 0)
    if pulses == total:
        assert status & 0x78 == 0
    elif not (cause == "org_n" and code & 7 == 7):
        assert status & 0x78


# --------------------------------------------------------------- interrupt latches


@settings(max_examples=100)
@given(
    st.lists(
        st.one_of(
            st.tuples(st.sampled_from([0x42, 0x62, 0x52, 0x72, 0x87, 0xA7, 0x80, 0xA0, 0x86, 0xA6]), gap),
            st.tuples(st.sampled_from([-1, -2]), gap),
        ),
        max_size=40,
    )
)
def test_interrupt_latches(steps):
    """int_n agrees with a reference model of the interrupts that were raised and read (P2104-INT-01..05)."""
    host = Host(B1 + " c 22 d 63 d 13 d 0A d 00 ready")
    errint, pending = 1, set()
    for code, wait in steps:
        if code < 0:
            errint = int(code == -1)
            host.pins(errint_n=errint)
            host.pause(4)
            continue
        axis = code >> 5 & 1
        host.run(f"c {code:02X} idle")
        command = decode(code)
        if command.kind is Kind.OPERATION and not command.masked:
            pending.add(("end", axis))
        elif command.kind is Kind.UNDEFINED and not errint:
            pending.add(("error", axis))
        elif command.kind is Kind.READ:
            pending.discard(("error" if code & 7 == 6 else "end", axis))
        host.pause(wait)
        host.sync()
        assert {(c.value, n) for c, n in host.model._interrupt.pending} == pending
    host.pause(200)
    assert host.out("int_n") == (0 if pending else 1)
    edges = host.model.log.of("int_n")
    highs = [b[0] - a[0] for a, b in zip(edges, edges[1:], strict=False) if a[1]]
    assert all(high >= 80 for high in highs)
