"""Tables of the PPMC-312: reference tables, error boundaries, read-back, free curves (P312-TBL)."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from cocotb_tests.harness import verifies
from openppmc.model.ppmc312.stages import (
    FreeCurve,
    SettingError,
    Table,
    build,
    curve,
    read_back,
    sigmoid_weights,
)
from tests.ppmc312.model.reference import T1, T2, T3, T4, T5, TF, TG, TH

ROM = [
    int(word)
    for word in """0 10 41 92 163 254 366 498 650 822 1013 1225 1456 1706 1976 2265 2573 2900 3245 3609 3990
    4390 4807
    5242 5694 6162 6648 7149 7666 8199 8747 9310 9888 10480 11086 11705 12337 12983 13640 14309 14990 15682
    16384 17097 17819 18550 19291 20040 20797 21561 22332 23109 23893 24682 25476 26275 27078 27884 28694
    29505 30319 31135 31951 32768""".split()
]


def weighted(values: tuple[int, ...]) -> int:
    """Return the sum of (i + 1) x value over all entries i of a table."""
    return sum((i + 1) * value for i, value in enumerate(values))


def error(*arguments: object, **options: object) -> int | None:
    """Return the error number of a rejected setting, or None if it is accepted."""
    try:
        build(*arguments, **options)  # type: ignore[arg-type]
    except SettingError as refused:
        return refused.number
    return None


@verifies("P312-TBL-01")
def test_sigmoid_weights_are_those_of_the_rom() -> None:
    weights = sigmoid_weights()
    assert list(weights[:64]) == ROM
    assert all(weights[i] + weights[126 - i] == 65536 for i in range(127))


@verifies("P312-TBL-02", "P312-TBL-04")
def test_reference_tables() -> None:
    assert T1.rates[:6] == (1000, 969, 940, 913, 887, 863) and T1.rates[63] == 333
    assert T1.rates[-6:] == (207, 205, 204, 203, 201, 200)
    assert (sum(T1.rates), weighted(T1.rates)) == (51_297, 2_435_805)
    assert T1.pa[:6] == (5, 5, 6, 5, 6, 6) and T1.pa[63] == 15 and T1.pa[-6:] == (25, 26, 25, 26, 26, 27)
    assert weighted(T1.pa) == 156_518 and T1.pd == T1.pa
    assert T2.rates[:6] == (1000, 999, 998, 994, 990, 985) and T2.rates[63] == 333
    assert T2.rates[-6:] == (201, 200, 200, 200, 200, 200)
    assert (sum(T2.rates), weighted(T2.rates)) == (56_947, 2_501_371)
    assert T2.pa[:6] == (5, 5, 5, 6, 5, 5) and T2.pa[63] == 16 and T2.pa[-6:] == (26, 27, 26, 26, 26, 27)
    assert weighted(T2.pa) == 162_503
    assert T5.rates[:6] == (8192, 8036, 7589, 6952, 6226, 5490) and T5.rates[63] == 127
    assert (
        T5.pa[:6] == (7, 7, 8, 9, 9, 11) and T5.pa[63] == 473 and T5.pa[-6:] == (934, 935, 937, 937, 937, 938)
    )
    assert weighted(T5.rates) == 1_512_493


@verifies("P312-TBL-03")
def test_sides_start_at_their_own_rates() -> None:
    assert (T3.rates, T3.pa) == (T1.rates, T1.pa)
    assert (T3.sa, T3.sd, T3.rates[31]) == (0, 31, 504)
    assert T3.pd[31:37] == (8, 9, 10, 9, 9, 10) and T3.pd[-6:] == (22, 22, 22, 22, 22, 23)
    assert (T4.sa, T4.sd, T4.pa, T4.pd) == (31, 0, T3.pd, T3.pa)


@verifies("P312-TBL-02", "P312-TBL-03")
def test_equal_first_rates_belong_to_the_slower_side() -> None:
    """If rounding makes R[1] = R[0], the slower ramp starts at stage 0, and the other ramp at the last stage
    with its rate.
    """
    table = build(300, 300, 100, 3000, 0, sigmoid=True, separate=False)
    assert table.rates[:8] == (300, 300, 300, 299, 299, 298, 297, 296)
    assert (table.sa, table.sd, table.slowest, table.na) == (0, 0, 300, 3000) and min(table.pa) > 2
    for start, stop, sa, sd in ((300, 299, 0, 4), (299, 300, 4, 0), (300, 300, 0, 0), (300, 298, 0, 5)):
        table = build(start, stop, 100, 3000, 4000, sigmoid=True)
        assert (table.sa, table.sd, table.na, table.nd) == (sa, sd, 3000, 4000), (start, stop)
    # R[1] = R[0] holds up to RS = 624, because RS (RS - RH) / RH is below 65536 / 20.
    heads = [build(rs, rs, 100, 6000, 0, sigmoid=True, separate=False).rates[:3] for rs in (624, 625, 626)]
    assert heads == [(624, 624, 622), (625, 624, 623), (626, 625, 624)]


@verifies("P312-TBL-05", "P312-CHK-07", "P312-CHK-08")
def test_error_boundaries() -> None:
    for sigmoid in (False, True):
        for start, high, least in ((1000, 200, 762), (0xFFFF, 0xFF7F, 255)):
            assert error(start, start, high, least - 1, 0, sigmoid=sigmoid, separate=False) == 0x05
            for pulses in (least, least + 1):
                table = build(start, start, high, pulses, 0, sigmoid=sigmoid, separate=False)
                assert min(table.pa) == 2 and table.na == pulses
    assert error(1000, 1000, 873, 2000, 0, separate=False) == 0x02
    assert error(1000, 1000, 872, 2000, 0, separate=False) is None
    assert error(1000, 1000, 1000, 2000, 0, separate=False) == 0x03
    assert error(1000, 1000, 1001, 2000, 0, separate=False) == 0x03
    assert [error(1000, rp, 200, 2000, 2000) for rp in (327, 328, 200)] == [0x04, None, 0x03]
    assert [error(1000, 1000, rh, 2000, 2000) for rh in (1, 0xFFF0)] == [0x01, 0x01]
    assert error(0x10, 1000, 2, 2000, 2000) == error(1000, 0x10, 2, 2000, 2000) == 0x01


@given(
    st.integers(0x11, 0xFFFF),
    st.integers(0x11, 0xFFFF),
    st.integers(2, 0xFFEF),
    st.integers(0, 0xFFFFFF),
    st.booleans(),
)
@verifies("P312-TBL-02", "P312-TBL-04", "P312-TBL-06")
def test_any_table(start: int, stop: int, high: int, total: int, sigmoid: bool) -> None:
    """Every setting gives an error number, or a table with the properties of P312-TBL-02.

    The expected values are computed with the formulas of the table engine.
    """
    try:
        table = build(start, stop, high, total, total, sigmoid=sigmoid)
    except SettingError as refused:
        assert refused.number in (1, 2, 3, 4, 5)
        return
    scale, slow = (65536 if sigmoid else 126), max(start, stop)
    weights = sigmoid_weights() if sigmoid else range(127)
    speed = [scale * high + (slow - high) * w for w in weights]
    full = (127 * 32768 if sigmoid else 8001) * (slow + high)
    assert sum(speed) == full
    assert table.rates == tuple((2 * scale * slow * high + d) // (2 * d) for d in speed)
    assert table.rates[0] == slow and table.rates[126] == high
    for pulses, first, rate in ((table.pa, table.sa, start), (table.pd, table.sd, stop)):
        if rate == slow:
            assert first == 0
        else:
            assert table.rates[first] >= rate and (first == 126 or table.rates[first + 1] < rate)
        rest, whole = 0, sum(speed[first:])
        for i in range(first, 127):
            share, rest = divmod(rest + total * speed[i], whole)
            assert pulses[i] == share >= 2
        assert rest == 0 and sum(pulses) == total and not any(pulses[:first])


@verifies("P312-CMD-41", "P312-CHK-09", "P312-CHK-10", "P312-CHK-11")
def test_read_back() -> None:
    blocks = [f"{header:02X} {len(body):02X} {body.hex(' ').upper()}" for header, body in read_back(T1)]
    assert len(blocks) == 55
    assert blocks[0] == "02 0A 41 7F 7F 00 00 07 D0 00 07 D0"
    assert blocks[1] == "00 0D 01 00 C8 00 C9 00 CB 00 CC 00 CD 00 CF"
    assert blocks[22] == "00 03 01 03 E8"
    assert blocks[23] == "00 0D 02 00 00 1B 00 00 1A 00 00 1A 00 00 19"
    assert blocks[54] == "01 0A 02 00 00 06 00 00 05 00 00 05"
    three = read_back(T3)
    assert three[0][1].hex() == "417f7f600007d00005dc"
    down = b"".join(body[1:] for _, body in three if body[0] == 3)
    assert (
        len(down) == 96 * 3
        and sum(down[k] << 16 | down[k + 1] << 8 | down[k + 2] for k in range(0, 288, 3)) == 1500
    )
    small = read_back(TH)
    assert [header for header, _ in small] == [2, 0, 0, 1] and small[0][1][:4].hex() == "41030203"


@verifies("P312-CHK-12")
def test_free_curve_by_three_blocks() -> None:
    transfer = FreeCurve(0x02, bytes([1, 3]))
    assert transfer.answer() == bytes([0, 3])
    transfer.add(0x00, bytes.fromhex("006400C80190"))
    assert transfer.answer() == bytes([1, 3])
    transfer.add(0x01, bytes.fromhex("000005000004000003"))
    assert transfer.answer().hex() == "0f00000c00000c"
    assert transfer.table == TF


def test_stages_of_the_small_tables() -> None:
    assert TF.rates[124:] == (400, 200, 100) and TF.pa[124:] == TF.pd[124:] == (3, 4, 5)
    assert (TF.sa, TF.sd, TG.sa, TG.sd, TH.sa, TH.sd) == (124, 124, 124, 125, 125, 124)
    assert TG.pd[124:] == (0, 4, 6) and TH.pa[124:] == (0, 4, 6) and TH.pd[124:] == (3, 4, 5)
    assert [TF.stage(x) for x in (401, 400, 201, 200, 100, 2)] == [123, 124, 124, 125, 126, 126]


def fails(blocks: list[tuple[int, str]]) -> int:
    """Return the error number of a free-curve transfer; the first pair is its code block."""
    with pytest.raises(SettingError) as refused:
        transfer = FreeCurve(blocks[0][0], bytes.fromhex(blocks[0][1]))
        for header, data in blocks[1:]:
            transfer.add(header, bytes.fromhex(data))
    return refused.value.number


OPEN, RATES = (2, "01 03"), (0, "0064 00C8 0190")


@pytest.mark.parametrize(
    ("number", "blocks"),
    [
        (0x10, [(3, "01 03")]),
        (0x10, [(3, "01")]),
        (0x11, [(2, "01 01")]),
        (0x11, [(2, "01 80")]),
        (0x11, [(2, "11 03")]),
        (0x11, [(2, "11 03 01")]),
        (0x11, [(2, "01 03 00 00")]),
        (0x16, [OPEN, (0, "0064 00")]),
        (0x16, [OPEN, (0, "0064 00C8 0190 0200")]),
        (0x16, [OPEN, RATES, (0, "000005 0000")]),
        (0x17, [OPEN, (1, "0064 00C8 0190")]),
        (0x17, [OPEN, RATES, (0, "000005 000004 000003")]),
        (0x18, [OPEN, (0, "0064 0001 0190")]),
        (0x18, [OPEN, (1, "0064 0001")]),
        (0x19, [OPEN, RATES, (1, "000005 000001 000003")]),
        (0x1A, [OPEN, RATES, (1, "FFFFFF 000004 000003")]),
    ],
)
@verifies("P312-CHK-13")
def test_free_curve_errors(number: int, blocks: list[tuple[int, str]]) -> None:
    assert fails(blocks) == number


@given(st.lists(st.integers(2, 0xFFFF), min_size=2, max_size=127), st.integers(2, 1000))
def test_any_curve_reads_back_as_given(rates: list[int], pulses: int) -> None:
    table: Table = curve(rates, [pulses] * len(rates), [pulses + 1] * max(2, len(rates) // 2))
    got = [body[1:] for _, body in read_back(table)[1:] if body[0] == 1]
    joined = b"".join(got)
    assert [joined[k] << 8 | joined[k + 1] for k in range(0, len(joined), 2)] == rates
    assert Fraction(table.na, pulses) == len(rates)
