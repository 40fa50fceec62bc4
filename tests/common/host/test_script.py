"""The builder of op scripts and the parser of responses, by the table of ops and UB-ANS-01..04."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from openppmc.host.frames import Deframer, Frame, encode
from openppmc.host.script import BadAnswer, Identity, Result, Script, parse_answer
from openppmc.model.carrier.bridge import Bridge


class Memory:
    """Sixteen registers that store the bytes written; always ready, without faults, always with data
    to read.
    """

    def __init__(self) -> None:
        self.cells = dict.fromkeys(range(16), 0)
        self.cells[1] = 0x01

    def read(self, a: int) -> int:
        return self.cells[a]

    def write(self, a: int, byte: int) -> None:
        if a != 1:
            self.cells[a] = byte


def ask(bridge: Bridge, script: Script, seq: int = 0) -> bytes:
    """Return the response to a script, without its first byte SEQ."""
    (item,) = Deframer().feed(bridge.receive(encode(bytes([seq]) + bytes(script))))
    assert isinstance(item, Frame)
    assert item.seq == seq
    return item.payload[1:]


@pytest.mark.parametrize(
    ("script", "code"),
    [
        (Script().call(0x0A, 9, 4, 4, 0), "55 0A 09 04 04 00"),
        (Script().call(0x43, 13, 0, 0), "54 43 0D 00 00"),
        (Script().call(0x80).get(1), "51 80 61"),
        (Script().call(0x83).get(3), "51 83 63"),
        (Script().ident(), "01"),
        (Script().rate(4).events(True).timeout(0x1234), "02 04 03 01 04 34 12"),
        (Script().reset().pins().straps(0xFE).count().zero().nop(), "05 06 07 FE 08 09 00"),
        (Script().write(3, 0x7E).read(15).read_many(2, 255), "13 7E 2F 32 FF"),
        (Script().post(1, b"ab").write_many(0, b"c"), "41 02 61 62 80 01 63"),
        (Script().wait(1, 4, 0), "71 04 00"),
        (Script().count(2).zero(2).count(1).zero(1), "0A 0B 08 09"),
    ],
)
def test_op_codes(script: Script, code: str) -> None:
    """The examples of docs/uart_bridge.md and one example of each op are encoded correctly."""
    assert bytes(script) == bytes.fromhex(code)


@pytest.mark.parametrize(
    "build",
    [
        lambda s: s.rate(7),
        lambda s: s.rate(-1),
        lambda s: s.timeout(65536),
        lambda s: s.straps(256),
        lambda s: s.count(0),
        lambda s: s.count(3),
        lambda s: s.zero(3),
        lambda s: s.write(16, 0),
        lambda s: s.write(0, 256),
        lambda s: s.read(-1),
        lambda s: s.read_many(0, 0),
        lambda s: s.read_many(0, 256),
        lambda s: s.post(0, b""),
        lambda s: s.post(0, bytes(256)),
        lambda s: s.call(0x43, *range(15)),
        lambda s: s.call(256),
        lambda s: s.get(0),
        lambda s: s.get(16),
        lambda s: s.wait(0, 256, 0),
        lambda s: s.write_many(0, b""),
        lambda s: s.read_many(0, 255).read_many(0, 2),
        lambda s: s.post(0, bytes(250)).nop().nop(),
    ],
)
def test_operands_are_checked(build: Callable[[Script], Script]) -> None:
    with pytest.raises(ValueError, match=r"outside|longer|more than"):
        build(Script())


OPS: list[st.SearchStrategy[Callable[[Script], Script]]] = [
    st.just(lambda s: s.nop()),
    st.just(lambda s: s.ident()),
    st.just(lambda s: s.pins()),
    st.just(lambda s: s.count()),
    st.builds(lambda a, b: lambda s: s.write(a, b), st.integers(0, 15), st.integers(0, 255)),
    st.builds(lambda a: lambda s: s.read(a), st.integers(0, 15)),
    st.builds(lambda a, n: lambda s: s.read_many(a, n), st.integers(0, 15), st.integers(1, 20)),
    st.builds(lambda d: lambda s: s.post(0, d), st.binary(min_size=1, max_size=9)),
    st.builds(lambda d: lambda s: s.call(*d), st.binary(min_size=1, max_size=15)),
    st.builds(lambda n: lambda s: s.get(n), st.integers(1, 15)),
    st.builds(lambda m: lambda s: s.wait(1, m, m & 1), st.integers(0, 255)),
]


@given(st.lists(st.one_of(OPS), max_size=12))
def test_answers_of_the_golden_model_fit_every_script(build: list[Callable[[Script], Script]]) -> None:
    script = Script()
    for add in build:
        add(script)
    answer = parse_answer(script, ask(Bridge(Memory()), script))
    assert answer.result is Result.DONE
    assert [len(value) for value in answer.values] == [
        op.response_size for op in script.ops if op.response_size
    ]


@given(st.lists(st.one_of(OPS), max_size=6), st.lists(st.one_of(OPS), max_size=3))
def test_a_script_that_fails_in_the_middle(
    before: list[Callable[[Script], Script]], after: list[Callable[[Script], Script]]
) -> None:
    """UB-ANS-03, -04: the parser returns the failed op, the last byte, and the data read before it."""
    script = Script()
    for add in before:
        add(script)
    values = sum(1 for op in script.ops if op.response_size)
    script.timeout(0).wait(1, 0xFF, 0x55)
    for add in after:
        add(script)
    answer = parse_answer(script, ask(Bridge(Memory()), script))
    assert answer.result is Result.TIMED_OUT
    assert answer.failed is not None and answer.failed.name == "WAIT"
    assert answer.last == 0x01
    assert len(answer.values) == values


@given(st.binary(max_size=30))
def test_a_bad_answer_never_gets_through_as_something_else(body: bytes) -> None:
    script = Script().call(0x80).get(1).count()
    try:
        answer = parse_answer(script, body)
    except BadAnswer:
        return
    if answer.result is Result.DONE:
        assert len(body) == 1 + script.response_size
    else:
        assert answer.failed in script.ops


@pytest.mark.parametrize("body", ["", "00", "00 01 02 03 04 05 06 07", "06", "01 00", "01 01 00", "01 02 00"])
def test_answers_that_do_not_fit(body: str) -> None:
    with pytest.raises(BadAnswer):
        parse_answer(Script().call(0x80).get(1).count(), bytes.fromhex(body))


def test_identity() -> None:
    script = Script().ident()
    body = ask(Bridge(Memory(), 104, 12_000_000, 16_000_000, datasheet=True), script)
    identity = Identity.parse(parse_answer(script, body).values[0])
    assert identity == Identity(1, 104, True, True, 5, 16_000_000, 12_000_000)
    body = ask(Bridge(Memory(), 2104, 12_000_000, 16_000_000, axes=2), script)
    identity = Identity.parse(parse_answer(script, body).values[0])
    assert identity == Identity(1, 2104, False, True, 5, 16_000_000, 12_000_000, axes=2)
    with pytest.raises(BadAnswer):
        Identity.parse(b"PPMX" + bytes(12))
    with pytest.raises(BadAnswer):
        Identity.parse(b"PPMC")


def test_patience_counts_waits_and_one_mailbox_limit() -> None:
    assert Script().read(1).patience == 0
    assert Script().call(0x80).get(1).call(0x81).patience == 0.25
    assert Script().timeout(1000).wait(1, 4, 0).wait(1, 4, 0).timeout(100).get(1).patience == 2.1


def test_patience_of_a_script_inside_another() -> None:
    inside = Script().timeout(1000).wait(1, 4, 0).get(1)
    assert Script().write(3, 5).extend(inside).patience == inside.patience == 2
    assert Script().timeout(2000).extend(Script().read(1)).wait(1, 4, 0).patience == 2
    assert Script().extend(Script().timeout(2000)).wait(1, 4, 0).patience == 2


def test_a_number_is_one_value() -> None:
    script = Script().read(1).read_number(4, 4).read(2)
    assert bytes(script) == bytes([0x21, 0x24, 0x25, 0x26, 0x27, 0x22]) and script.response_size == 6
    assert parse_answer(script, b"\0abcdef").values == (b"a", b"bcde", b"f")
    for count in (0, 5):
        with pytest.raises(ValueError, match="count"):
            Script().read_number(4, count)
