"""Blocks of the PPMC-312: instructions, responses and tables of the worked examples of its rules."""

from __future__ import annotations

import doctest
from fractions import Fraction
from pathlib import Path

import pytest

from openppmc.host import CCW, CW, OutOfRange
from openppmc.host.capabilities import SetupRequest
from openppmc.host.errors import AxisBusy, CommandRefused, NotInitialised, StartRefused, UnknownCommand
from openppmc.host.ppmc312 import answers, errors, profile
from openppmc.host.ppmc312 import answers as registers
from openppmc.host.ppmc312 import blocks as blocks312
from openppmc.host.ppmc312 import profile as free
from openppmc.host.ppmc312.answers import BadResponse, EventBuffer, Inputs, Response, Status
from openppmc.host.ppmc312.blocks import Trigger
from openppmc.host.ppmc312.profile import CAPABILITIES as PPMC312
from openppmc.host.ppmc312.profile import base_clocks, plan_curve, plan_setup, read_stages
from openppmc.model import Timebase, predict_move
from openppmc.model.ppmc312 import stages as tables
from openppmc.model.ppmc312.carrier import TableMove
from openppmc.model.ppmc312.codes import Cause, State

XTAL = 16_000_000
MEGAHERTZ = base_clocks(XTAL)[1]


def test_examples_in_the_docstrings() -> None:
    for module, least in (
        (blocks312, 20),
        (answers, 4),
        (errors, 3),
        (profile, 4),
        (free, 2),
        (registers, 2),
    ):
        failed, attempted = doctest.testmod(module)
        assert not failed and attempted >= least, module


# (number of the transaction in cocotb_tests/ppmc312/tb_transactions.py, block, WAR, bytes in bus order)
TRANSACTIONS = [
    (1, blocks312.initial_setting(1, 1000, 200, 2000), 0x15, "D0 07 00 C8 00 E8 03 01 00 09 03"),
    (
        2,
        blocks312.initial_setting(1, 1000, 200, 2000, 500, 1500),
        0x10,
        "DC 05 00 D0 07 00 C8 00 F4 01 E8 03 11 00 0E 03",
    ),
    (3, blocks312.in_position(True, 10), 0x1A, "0A 00 03 02 04 03"),
    (4, blocks312.encoder_watch(True, 20), 0x1A, "14 00 03 03 04 03"),
    (5, blocks312.interlock_position(5000), 0x19, "88 13 00 00 04 05 03"),
    (6, blocks312.speed_limit(300), 0x1B, "2C 01 05 03 03"),
    (7, blocks312.end_terminal(True), 0x1C, "01 06 02 03"),
    (8, blocks312.immediate_stop(), 0x1C, "00 80 02 03"),
    (9, blocks312.immediate_stop(Trigger.POSITION, 0x1000), 0x18, "00 10 00 00 04 80 06 03"),
    (10, blocks312.slow_stop(Trigger.EVENT1), 0x1C, "05 81 02 03"),
    (11, blocks312.acceleration(CW, 5000), 0x16, "88 13 00 00 00 00 00 82 08 03"),
    (12, blocks312.constant(CCW, 100, 500), 0x16, "64 00 00 00 F4 01 40 83 08 03"),
    (13, blocks312.single_step(CCW), 0x1C, "40 84 02 03"),
    (14, blocks312.run(CW, ramped=True), 0x1A, "00 00 00 85 04 03"),
    (15, blocks312.run(CCW, 400), 0x1A, "90 01 40 86 04 03"),
    (16, blocks312.change(400), 0x1A, "90 01 00 87 04 03"),
    (17, blocks312.change(300, False, Trigger.POSITION, 0x800), 0x16, "00 08 00 00 2C 01 04 88 08 03"),
    (18, blocks312.origin_search(CCW, 500, index=True), 0x1A, "F4 01 50 10 04 03"),
    (19, blocks312.zero_return(CW), 0x1A, "00 00 00 11 04 03"),
    (20, blocks312.block(0x25), 0x1D, "25 01 03"),
    (21, blocks312.outputs(0x15), 0x1C, "15 26 02 03"),
    (23, blocks312.input_mask(0x24), 0x1B, "24 01 28 03 03"),
    (24, blocks312.read_position(), 0x1C, "00 42 02 03"),
    (25, blocks312.set_position(0xFFFFFFFF, encoder=True), 0x18, "FF FF FF FF 01 43 06 03"),
    (
        29,
        blocks312.event_register(2, blocks312.acceleration(CW, 100)),
        0x12,
        "64 00 00 00 00 00 00 82 08 03 01 49 0C 03",
    ),
    (30, blocks312.event_delete(2), 0x1C, "03 49 02 03"),
    (31, blocks312.event_read(2), 0x1C, "01 47 02 03"),
]


@pytest.mark.parametrize(
    ("row", "block", "start", "wanted"), TRANSACTIONS, ids=[str(t[0]) for t in TRANSACTIONS]
)
def test_transactions_of_the_rules(row: int, block: bytes, start: int, wanted: str) -> None:
    assert blocks312.bus_order(block).hex(" ").upper() == wanted
    assert blocks312.start_address(block) == start


def test_free_curve_of_the_rules() -> None:
    """The blocks of a free curve equal transactions 34 to 36 of tb_transactions.py.

    If the deceleration is separate, the opening block also contains the number of its stages.
    """
    blocks = blocks312.free_curve(1, [100, 200, 400], [5, 4, 3])
    assert [blocks312.bus_order(block).hex(" ") for block in blocks] == [
        "03 01 01 03 02",
        "90 01 c8 00 64 00 06 00",
        "03 00 00 04 00 00 05 00 00 09 01",
    ]
    opening, *data = blocks312.free_curve(2, list(range(100, 2500, 100)), [9] * 24, [7] * 11)
    assert opening.hex(" ") == "02 04 01 12 18 0b"
    assert [(block[0], block[1]) for block in data] == [
        *((0, 20), (0, 20), (0, 8)),
        *((0, 30), (0, 30), (0, 12)),
        *((0, 30), (1, 3)),
    ]


@pytest.mark.parametrize(
    "make",
    [
        lambda: blocks312.acceleration(CW, 0),
        lambda: blocks312.acceleration(CW, 1 << 32),
        lambda: blocks312.acceleration(2, 5),
        lambda: blocks312.acceleration(CW, 5, trigger=Trigger.POSITION),
        lambda: blocks312.immediate_stop(Trigger.POSITION),
        lambda: blocks312.immediate_stop(Trigger.EVENT1, 5),
        lambda: blocks312.constant(CW, 5, 0x10000),
        lambda: blocks312.in_position(True, 0),
        lambda: blocks312.encoder_watch(True, 0x10000),
        lambda: blocks312.outputs(64),
        lambda: blocks312.input_mask(-1),
        lambda: blocks312.speed_limit(1),
        lambda: blocks312.set_position(1 << 32),
        lambda: blocks312.set_position(-(1 << 31) - 1),
        lambda: blocks312.event_read(3),
        lambda: blocks312.block(0x40, bytes(30)),
    ],
)
def test_what_does_not_fit_is_told_before_it_is_sent(make: object) -> None:
    with pytest.raises(OutOfRange):
        make()  # type: ignore[operator]


# ---------------------------------------------------------------------- responses

REFUSALS = [
    ("03 03 F1 00 01", NotInitialised, "no table"),
    ("03 03 F1 00 04", AxisBusy, "busy"),
    ("03 03 F1 00 08", AxisBusy, "busy"),
    ("03 03 F1 00 10", errors.InAlarm, "in alarm"),
    ("03 03 F1 00 20", errors.HeldByRun, "RUN"),
    ("03 03 F1 01 02", errors.UnexpectedInstruction, "did not expect"),
    ("03 03 F1 02 01", errors.UnexpectedInstruction, "did not expect"),
    ("03 01 F2", StartRefused, "limit switch"),
    ("03 02 F5 46", UnknownCommand, "does not know"),
    ("03 02 F6 09", errors.InvalidBlockLength, "length"),
    ("03 02 F7 00", errors.RegistrationRefused, "eight"),
    ("03 02 F7 01", errors.RegistrationRefused, "in use"),
    ("0B 02 F8 02", errors.EventFailed, "limit switch"),
    ("1B 02 F9 00", errors.OverrideFailed, "parameter"),
    ("1B 02 F9 01", errors.OverrideFailed, "state"),
    ("23 02 F4 00", errors.AlarmRaised, "alarm input"),
    ("23 02 F4 01", errors.AlarmRaised, "unread answer"),
    ("23 02 F4 02", errors.AlarmRaised, "interlock or RUN"),
    ("23 02 F4 03", errors.AlarmRaised, "stop report"),
]
NUMBERS = [
    *(0x00, 0x01, 0x02, 0x03, 0x04, 0x05),
    *(0x10, 0x11, 0x15, 0x16, 0x17, 0x18, 0x19, 0x1A),
    *(0x20, 0x21, 0x23, 0x24, 0x25, 0x26, 0x27),
]
"""Error numbers that the answer F0 (parameter abnormality) contains (docs/ppmc312/README.md, Blocks)."""


@pytest.mark.parametrize(("response", "kind", "text"), REFUSALS, ids=[r[0] for r in REFUSALS])
def test_refusals_have_names(response: str, kind: type[CommandRefused], text: str) -> None:
    error = Response(bytes.fromhex(response)).error
    assert type(error) is kind and text in str(error) and "\n" not in str(error)


def test_parameter_refusals_have_names_and_lines_of_their_own() -> None:
    texts = set()
    for number in NUMBERS:
        error = Response(bytes([3, 10, 0xF0, number, 0x82, 0, 0, 0, 0, 0, 0, 0])).error
        assert isinstance(error, errors.ParameterRefused)
        assert error.number == number and error.echo == bytes([0x82, 0, 0, 0, 0, 0, 0, 0])
        assert "error " not in str(error)
        texts.add(str(error))
        wanted = {
            0x00: errors.ParameterRefused,
            0x01: errors.RateRefused,
            0x20: errors.RateRefused,
        }.get(number)
        if 0x02 <= number <= 0x05:
            wanted = errors.TableRefused
        elif 0x10 <= number <= 0x1A:
            wanted = errors.CurveRefused
        assert type(error) is (wanted or errors.ParameterRefused)
    assert len(texts) == len(NUMBERS)
    assert "error 55" in str(Response(bytes([3, 3, 0xF0, 0x55, 0x40])).error)


@pytest.mark.parametrize(
    ("response", "wanted"),
    [
        ("23 06 E0 08 FF FF FF F9", answers.Stopped(Cause.SLOW, -7)),
        ("23 01 E1", answers.InterlockEnded()),
        ("23 01 E2", answers.HoldExecuted()),
        ("23 02 E3 01", answers.EncoderChange(True)),
        ("23 02 E4 00", answers.InPositionChange(False)),
        ("23 03 E9 01 24", answers.InputChange(0x24, True)),
        ("23 02 F4 03", answers.Alarm(3)),
        ("0B 02 25 FF", answers.Executed(answers.Source.EVENT, 0x25, b"\xff")),
        ("1B 01 88", answers.Executed(answers.Source.OVERRIDE, 0x88)),
    ],
)
def test_reports(response: str, wanted: object) -> None:
    assert Response(bytes.fromhex(response)).report() == wanted


@pytest.mark.parametrize("response", ["23 06 E0 03 00 00 00 00", "23 02 E0 40", "23 01 E7", "23 01 E9"])
def test_reports_that_cannot_be(response: str) -> None:
    with pytest.raises(BadResponse, match="is not known"):
        Response(bytes.fromhex(response)).report()


def test_responses_whose_length_is_wrong() -> None:
    for response in ("", "03", "03 01", "03 02 40", "03 01 40 12"):
        with pytest.raises(BadResponse, match="length byte"):
            Response(bytes.fromhex(response))


def test_status_and_inputs() -> None:
    """Each bit of status and inputs is at the position that the rules state (P312-CMD-4D, -27)."""
    rest = Status.parse(bytes([0x00, 0x02, 0x00]))
    assert (rest.state, rest.busy, rest.run_monitored, rest.overrides) == (State.NOR, False, True, 0)
    names = ("interlock", None, "encoder_watched", "position_watched", "end_monitored")
    for bit, name in enumerate((*names, "encoder_outside", "position_outside")):
        now = Status.parse(bytes([0x40 >> bit, 0x20, 0x00]))
        on = [field for field in vars(now) if vars(now)[field] is True and field != "run_monitored"]
        assert on == ([name] if name else []) and now.busy
    assert not Status.parse(bytes([0x80, 0x10, 0x00])).run_monitored
    assert Status.parse(bytes([0x00, 0x10, 0x00])).in_alarm
    full = Status.parse(bytes([0x00, 0x02, 0x68]))
    assert (full.overrides, full.override_events, full.events) == (8, (2,), (1,))
    places = ("limit_ccw", "limit_cw", "slow_ccw", "slow_cw", "origin", "index", "end", "alarm")
    for bit, place in enumerate(places):
        now = Inputs.parse(bytes([0xFF & ~(1 << bit), 0xC0]))
        assert [name for name, active in vars(now).items() if active] == [place]
    assert Inputs.parse(bytes([0xFF, 0xE0])).active == ["run"]
    assert Inputs.parse(bytes([0xFF, 0x40])).active == ["event2"]
    assert EventBuffer.parse(bytes.fromhex("02 01 26 84 00 00")) == EventBuffer(1, (0x26, 0x84))


# ---------------------------------------------------------------------- tables


def test_base_clock_by_the_slowest_speed() -> None:
    """The planned base clock is the fastest one with which the slowest speed needs at most 65 535 ticks."""
    for slowest, clk in ((5000, 0), (123, 0), (122, 1), (15.3, 1), (7.7, 2), (4, 3), (1, 4), (0.3, 5)):
        setup = PPMC312.plan(XTAL, SetupRequest(start_pps=slowest, high_pps=7000, ramp_pulses=9_000_000))
        assert setup.clock.clk == clk, slowest
    own_stop = PPMC312.plan(
        XTAL, SetupRequest(start_pps=1000, stop_pps=100, high_pps=5000, ramp_pulses=20_000)
    )
    assert own_stop.clock.clk == 1
    assert PPMC312.plan(8_000_000, SetupRequest(start_pps=1000)).clock.hertz == 4_000_000
    outside = PPMC312.plan(XTAL, SetupRequest(external_clock=100_000, start_pps=100, high_pps=500))
    assert outside.clock.external and outside.blocks[0][3] == 6


def test_initial_settings() -> None:
    """Planned initial settings have the bytes of the tables T1 to T5 (docs/ppmc312/README.md, 8.1)."""
    examples: list[tuple[dict[str, object], str]] = [
        ({}, "09 00 01 03 E8 00 C8 00 07 D0"),
        ({"sigmoid": True}, "09 00 09 03 E8 00 C8 00 07 D0"),
        ({"stop_pps": 2000, "down": 1500}, "0E 00 11 03 E8 01 F4 00 C8 00 07 D0 00 05 DC"),
        (
            {"start_pps": 2000, "up": 1500, "stop_pps": 1000, "down": 2000},
            "0E 00 11 01 F4 03 E8 00 C8 00 05 DC 00 07 D0",
        ),
    ]
    for changes, wanted in examples:
        values = {"start_pps": 1000, "high_pps": 5000, "up": 2000} | changes
        setup = plan_setup(MEGAHERTZ, **values)  # type: ignore[arg-type]
        assert setup.blocks == [b"\x03" + bytes.fromhex(wanted)], changes
    assert setup.table.sd == 0 and setup.table.sa == 31
    assert setup.rate_of(2500) == 400


@pytest.mark.parametrize(
    ("start", "high", "stop", "sigmoid", "least"),
    [
        (1000, 200, None, False, [762]),
        (0xFFFF, 0xFF7F, None, True, [255]),
        (132, 4, None, False, [4318]),
        (300, 100, None, True, [508]),  # R[0] = R[1] = R[2]
        (1000, 200, 500, False, [762, 338]),  # sd = 31
        (500, 200, 1000, True, [325, 762]),
    ],
)
def test_fewest_pulses_of_a_ramp(
    start: int, high: int, stop: int | None, sigmoid: bool, least: list[int]
) -> None:
    """The driver computes the minimum number of pulses of a ramp; with one pulse less, the setting is
    rejected with error 05 (P312-TBL-05).
    """
    rates = (start, start if stop is None else stop, high)
    assert profile._least(rates, sigmoid)[: len(least)] == least
    least = (2 * least)[:2]
    tables.build(*rates, *least, sigmoid=sigmoid, separate=stop is not None)
    for side in range(len(least) if stop else 1):
        short = [pulses - (at == side) for at, pulses in enumerate(least)]
        with pytest.raises(tables.SettingError) as refused:
            tables.build(*rates, *short, sigmoid=sigmoid, separate=stop is not None)
        assert refused.value.number == 0x05


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"start_pps": 0.2}, "start speed 0.2 pps is outside 0.238422 to 7812.5 pps"),
        ({"start_pps": 5000, "high_pps": 1000}, "must be above start and stop speed"),
        ({"start_pps": 4990, "ramp_pulses": 9000}, "too close"),
        ({"stop_pps": 4990, "ramp_pulses": 9000}, "start or stop speed is too close"),
        (
            {"ramp_pulses": 761},
            "761 pulses: the ramp is too short: each of its stages needs 2 pulses: 762 or more",
        ),
        ({"ramp_pulses": 0}, "outside 1 to 16777215"),
        ({"down_pulses": 1 << 24}, "outside 1 to 16777215"),
        ({"down_pulses": 500}, "762 up and 762 down or more"),
        ({"base_clock": 3_000_000}, "this part has 8e.06, 1e.06, 500000, 250000, 62500, 15625 Hz"),
        ({"external_clock": 3_000_000}, "outside 0 to 2000000 Hz"),
        ({"phases": 5}, "phase outputs: a PPMC-312 does not have that"),
        ({"positive_logic": True}, "phase outputs"),
        ({"long_intervals": True}, "long intervals: a PPMC-312"),
        ({"axis": 2}, "a PPMC-312 has one axis"),
        ({"curve": "/no/such.csv"}, r"[/\\]such.csv: cannot be read"),
        ({"curve": "x.csv", "sigmoid": True}, "a free curve has its own speeds"),
    ],
)
def test_bad_setups_are_told_before_they_are_sent(arguments: dict[str, object], text: str) -> None:
    with pytest.raises(OutOfRange, match=text.replace("(", ".")):
        PPMC312.plan(XTAL, SetupRequest(**arguments))  # type: ignore[arg-type]


def test_prediction_of_a_move() -> None:
    """Predictions equal worked moves E13 and E17 (P312-CHK-17); input that the part would reject is
    rejected.
    """
    one, two = "01 03e8 00c8 0007d0", "11 03e8 01f4 00c8 0007d0 0005dc"
    move = predict_move(bytes.fromhex(one), 5000, part="ppmc312")
    assert isinstance(move, TableMove) and (move.kind, len(move.clk)) == (0, 5000)
    assert move.clk[-1] == 16 * (1_532_294 - 1000) and move.rates[:6] == (1000,) * 5 + (969,)
    move = predict_move(bytes.fromhex(two), 100, part="ppmc312", timebase=Timebase(8_000_000))
    assert isinstance(move, TableMove) and move.kind == 0x40 and move.clk[-1] == 8 * (81_077 - 677)
    assert move.seconds[-1] == pytest.approx(0.0804) and move.speeds[0] == 1000
    flat = predict_move(bytes.fromhex(one), 3, 500, part="ppmc312")
    assert isinstance(flat, TableMove) and flat.intervals == [8000, 8000] and flat.indices == (None, None)
    for init, n, rate in (
        (one[:-2], 5, None),
        ("01 03e8 00c8 000100", 5, None),
        ("11 03e8 00c8 0007d0", 5, None),
        ("06 03e8 00c8 0007d0", 5, None),
        (one, 0, None),
        (one, 1 << 32, None),
        (one, 5, 199),
    ):
        with pytest.raises(ValueError):
            predict_move(bytes.fromhex(init), n, rate, part="ppmc312")


# ---------------------------------------------------------------------- free curves


def test_free_curve_with_a_deceleration_of_its_own() -> None:
    """A curve with three stages up and two down gives the blocks TG of cocotb_tests/ppmc312/blocks.py."""
    setup = plan_curve(MEGAHERTZ, [(2500, 3), (5000, 4, 4), (10_000, 5, 6)])
    assert [block.hex(" ") for block in setup.blocks] == [
        "02 04 01 11 03 02",
        "00 06 00 64 00 c8 01 90",
        "00 09 00 00 05 00 00 04 00 00 03",
        "01 06 00 00 06 00 00 04",
    ]
    assert (setup.start.reached, setup.stop.reached, setup.high.reached) == (2500, 5000, 10_000)


def test_free_curve_from_a_file(tmp_path: Path) -> None:
    path = tmp_path / "curve.csv"
    path.write_text("pps,up,down\n# slow\n2500,3,\n\n 5000 , 4 , 4\n10000,5,6\n")
    stages = read_stages(path)
    assert stages == [(2500, 3, None), (5000, 4, 4), (10_000, 5, 6)]
    assert (
        PPMC312.plan(XTAL, SetupRequest(curve=str(path), base_clock=1_000_000)).blocks
        == plan_curve(MEGAHERTZ, stages).blocks
    )


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("2500,3\nfast,4", "curve.csv:2: a line is a speed"),
        ("2500,3\n5000,4.5", "curve.csv:2: a line is a speed"),
        ("2500,3\n5000,4,5,6", "curve.csv:2: a line is a speed"),
        ("2500,3", "free curve of 1 stages"),
        ("", "free curve of 0 stages"),
        ("2500,3\n5000,", "stage 2: pulses up are missing"),
        ("2500,\n5000,4\n10000,5", "stage 1: pulses are missing on both sides"),
        ("2500,3,2\n5000,4,3\n10000,5,", "stage 3: pulses down are missing"),
        ("2500,3,\n5000,4,\n10000,5,5", "pulses down: a side has 2 stages or more"),
        ("2500,3\n0,4", "speed 0 pps"),
        ("250000,3\n500000,4", "stage 1: 3 pulses at 250000 pps last less than 256 base clocks"),
        ("2500,1\n5000,4", "fewer than 2 pulses"),
        ("2500,16777215\n5000,4", "more than 16777215 pulses"),
    ],
)
def test_bad_free_curves(tmp_path: Path, text: str, complaint: str) -> None:
    path = tmp_path / "curve.csv"
    path.write_text(text)
    with pytest.raises(OutOfRange, match=complaint):
        PPMC312.plan(XTAL, SetupRequest(curve=str(path)))


def test_a_curve_that_is_no_text(tmp_path: Path) -> None:
    path = tmp_path / "curve.csv"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(OutOfRange, match="not a text file in UTF-8"):
        read_stages(path)


def test_seconds_of_a_ramp() -> None:
    """The duration of a ramp is the sum of its intervals: three of 400 us, four of 200 us, five of 100 us."""
    setup = plan_curve(MEGAHERTZ, [(2500, 3), (5000, 4), (10_000, 5)])
    assert setup.seconds(setup.table.pa) == pytest.approx(float(Fraction(2500, 1_000_000)))
