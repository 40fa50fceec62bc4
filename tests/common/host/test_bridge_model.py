"""The golden model of the bridge follows the rules of docs/uart_bridge.md."""

from __future__ import annotations

import pytest

from openppmc.model.carrier.bridge import Bridge, frame
from openppmc.model.carrier.carrier import Plant
from openppmc.model.ppmc104 import Carrier

NAK = {code: frame(bytes([0x81, code])) for code in range(1, 9)}


class Bus:
    """A device that returns values from a list and logs all accesses."""

    def __init__(self, status: int = 0x00) -> None:
        self.status = [status]
        self.data = list(range(0xA0, 0x100)) * 20
        self.log: list[tuple[object, ...]] = []
        self.levels = 0xFF
        self.value = -2
        self.ms = 0.0

    def read(self, a: int) -> int:
        self.log.append(("r", a))
        if a == 1:
            return self.status.pop(0) if len(self.status) > 1 else self.status[0]
        return self.data.pop(0)

    def write(self, a: int, byte: int) -> None:
        self.log.append(("w", a, byte))

    def reset(self) -> None:
        self.log.append(("reset",))

    def straps(self, levels: int) -> None:
        self.log.append(("straps", levels))

    def pins(self) -> int:
        return self.levels

    def count(self, axis: int = 1) -> int:
        return self.value * axis + axis - 1

    def zero(self, *axis: int) -> None:
        self.log.append(("zero", *axis))

    def now_ms(self) -> float:
        self.ms += 0.001
        return self.ms

    def skip(self, limit_ms: float) -> None:
        self.ms += min(limit_ms, 1.0)

    @property
    def writes(self) -> list[tuple[object, ...]]:
        return [entry for entry in self.log if entry[0] == "w"]


def talk(bridge: Bridge, seq: int, script: str) -> bytes:
    return bridge.receive(frame(bytes([seq]) + bytes.fromhex(script)))


def reply(seq: int, body: str) -> bytes:
    return frame(bytes([seq]) + bytes.fromhex(body))


# ---------------------------------------------------------------------- line and frames


def test_ub_lin_02_rates_available() -> None:
    for clk_hz, best in (
        (8_000_000, 4),
        (10_000_000, 5),
        (14_999_999, 5),
        (15_000_000, 6),
        (1_200_000, 1),
        (9e5, 0),
    ):
        bridge = Bridge(Bus(), clk_hz=int(clk_hz))
        identity = talk(bridge, 0, "01")
        assert identity == bridge.receive(frame(b"\x00\x01"))
        for code in range(8):
            result = talk(bridge, 0, f"02 {code:02X}")
            assert (result == reply(0, "00")) == (code <= best), (clk_hz, code)


def test_ub_lin_06_break_brings_rate_and_hunt() -> None:
    bridge = Bridge(Bus())
    assert talk(bridge, 0, "02 06") == reply(0, "00")
    assert bridge.rate == 6
    assert bridge.receive_bad(0) == NAK[1]
    assert bridge.rate == 0
    assert bridge.receive(b"\x01\x02") == b"", "hunting"
    assert talk(bridge, 1, "00") == reply(1, "00")


def test_ub_lin_05_framing_error_keeps_the_rate() -> None:
    bridge = Bridge(Bus())
    talk(bridge, 0, "02 06")
    bridge.receive_bad(0x41)
    assert bridge.rate == 6


def test_ub_lin_07_rate_falls_back_without_a_good_frame() -> None:
    bridge = Bridge(Bus())
    talk(bridge, 0, "02 03")
    bridge.idle(999)
    assert bridge.rate == 3
    bridge.idle(1)
    assert bridge.rate == 0
    talk(bridge, 0, "02 03")
    bridge.receive(b"\x7e\x01\x02\x03\x04\x7e")
    bridge.idle(1000)
    assert bridge.rate == 0, "a broken frame does not count"
    talk(bridge, 0, "02 03")
    talk(bridge, 1, "00")
    bridge.idle(5000)
    assert bridge.rate == 3, "a good one does"


@pytest.mark.parametrize(
    ("line", "nak"),
    [
        ("7E 01 02 03 04 7E", 2),
        ("7E 01 02 7E", 4),
        ("7E 01 7E", 4),
        ("7E 01 02 03 7D 7E", 6),
        ("7E" + "00" * 257, 3),
    ],
)
def test_ub_frm_06_faults(line: str, nak: int) -> None:
    bus = Bus()
    bridge = Bridge(bus)
    data = bytes.fromhex(line)
    assert bridge.receive(data[:-1]) == b"", "not before the fault is known"
    assert bridge.receive(data[-1:]) == NAK[nak]
    assert not bus.log
    following = reply(1, "00")
    good = frame(b"\x01\x00")
    assert bridge.receive(good if nak == 3 else good[1:]) == following


def test_ub_frm_04_longest_request() -> None:
    bridge = Bridge(Bus())
    assert talk(bridge, 0, "00" * 253) == reply(0, "00")
    assert talk(bridge, 0, "00" * 254) != reply(0, "00")
    assert talk(bridge, 1, "") == reply(1, "00"), "an empty script is fine"


def test_ub_frm_06_framing_error_and_silence() -> None:
    bridge = Bridge(Bus())
    assert bridge.receive_bad(0x41) == b"", "nothing in the hunt"
    bridge.receive(b"\x7e\x01")
    assert bridge.receive_bad(0x41) == NAK[1]
    bridge.receive(b"\x7e")
    assert bridge.idle(10_000) == b"", "between frames the line may be silent"
    bridge.receive(b"\x01")
    assert bridge.idle(99) == b""
    assert bridge.idle(1) == NAK[5]
    assert bridge.receive(b"\x02\x03\x04\x7e") == b"", "hunting"


def test_ub_frm_07_bytes_during_a_script() -> None:
    bus = Bus()
    bridge = Bridge(bus)
    request, other = frame(b"\x01\x10\x55"), frame(b"\x02\x10\x66")
    assert bridge.receive(request + b"\x7e\x7e") == reply(1, "00"), "flags do not count"
    bus.log.clear()
    assert bridge.receive(frame(b"\x03\x10\x55") + other) == reply(3, "00") + NAK[7]
    assert bus.writes == [("w", 0, 0x55)]
    assert bridge.receive(other[1:]) == b"", "hunting"
    assert bridge.receive(other) == reply(2, "00")


def test_ub_frm_07_a_wait_is_cut_short() -> None:
    bridge = Bridge(Bus())
    assert bridge.receive(frame(b"\x01\x71\xff\x01\x00") + b"x") == reply(1, "05 00 00") + NAK[7]
    assert bridge.receive(frame(b"\x02\x71\xff\x00") + b"x") == reply(2, "00 00") + NAK[7], "already true"


# ---------------------------------------------------------------------- requests and responses


def test_ub_seq_02_repeats_are_not_executed() -> None:
    bus = Bus()
    bridge = Bridge(bus)
    first = talk(bridge, 5, "20 10 01")
    assert talk(bridge, 5, "20 10 02") == first
    assert bus.writes == [("w", 0, 1)]
    assert talk(bridge, 6, "20 10 03") != first
    assert talk(bridge, 5, "20 10 04") != first
    assert [entry[2] for entry in bus.writes] == [1, 3, 4]
    talk(bridge, 0, "10 07")
    talk(bridge, 0, "10 07")
    assert [entry[2] for entry in bus.writes] == [1, 3, 4, 7, 7], "SEQ 0 is always executed"


def test_ub_seq_03_high_numbers() -> None:
    bus = Bus()
    bridge = Bridge(bus)
    assert talk(bridge, 128, "10 01") == NAK[8]
    assert talk(bridge, 255, "10 01") == NAK[8]
    assert not bus.log


@pytest.mark.parametrize(
    "op",
    [
        "0A",
        "0F",
        "90",
        "FF",
        "50",
        "60",
        "10",
        "02",
        "02 07",
        "02 FF",
        "03",
        "03 02",
        "04 01",
        "07",
        "30",
        "30 00",
    ]
    + ["40", "40 00", "40 02 11", "80 00", "80 03 01 02", "53 43 0D", "71", "71 FF"],
)
def test_ub_ans_02_illegal_ops_do_nothing(op: str) -> None:
    bus = Bus()
    bridge = Bridge(bus)
    code = bytes.fromhex(op)
    assert bridge.receive(frame(b"\x01\x21" + code)) == reply(1, "03 01 00 00")
    assert bus.log == [("r", 1)]


def test_ub_ans_02_part_refuses() -> None:
    bus = Bus(0x94)
    bridge = Bridge(bus)
    assert talk(bridge, 1, "00 54 43 01 02 03 10 00") == reply(1, "02 01 94")
    assert bus.writes == [("w", 1, 0x43)], "the rest is not sent"


def test_ub_ans_02_too_much_data() -> None:
    bridge = Bridge(Bus())
    answer = talk(bridge, 1, "30 FF 20 20 10 00")
    assert answer == frame(bytes([1, 4, 3, (data := bytes((list(range(0xA0, 0x100)) * 3)[:256]))[-1]]) + data)
    assert talk(bridge, 2, "30 FF 01")[:4] == bytes([0x7E, 2, 4, 2])


@pytest.mark.parametrize("op", ["20", "6F", "71 00 00", "52 86 05", "01", "06", "08"])
def test_ub_ans_05_no_room_nothing_done(op: str) -> None:
    bus = Bus(0x01)
    answer = talk(Bridge(bus), 1, "32 FF 22 " + op)
    assert len(bus.log) == 256
    assert answer[1:4] == b"\x01\x04\x03"
    assert not bus.writes


def test_ub_ans_04_partial_data() -> None:
    bus = Bus()
    bus.status = [0x01, 0x01, 0x00]
    bridge = Bridge(bus)
    assert talk(bridge, 1, "04 00 00 06 64") == reply(1, "01 04 00 FF A0 A1")


def test_ub_msg_02_events() -> None:
    bus = Bus()
    bridge = Bridge(bus)
    assert bridge.interrupt() == b"", "off after reset"
    assert talk(bridge, 1, "03 01") == reply(1, "00")
    bus.levels = 0xFE
    event = frame(b"\x80\xfe")
    assert bridge.interrupt() == event
    assert talk(bridge, 2, "03 00 03 01") == reply(2, "00") + event, "enabled with int_n low"
    assert talk(bridge, 3, "03 00") == reply(3, "00")
    assert talk(bridge, 4, "03 01 03 00") == reply(4, "00"), "disabling forgets"


def test_ub_msg_01_event_waits_for_the_answer_and_precedes_the_nak() -> None:
    class Interrupting(Bus):
        def write(self, a: int, byte: int) -> None:
            self.levels = 0xFE
            assert bridge.interrupt() == b""
            assert bridge.interrupt() == b""

    bus = Interrupting()
    bridge = Bridge(bus)
    talk(bridge, 1, "03 01")
    sent = bridge.receive(frame(b"\x02\x10\x00") + b"x")
    assert sent == reply(2, "00") + frame(b"\x80\xfe") + NAK[7]


# ---------------------------------------------------------------------- ops


def test_ident() -> None:
    bridge = Bridge(Bus(), part=2104, clk_hz=24_000_000, xtal_hz=9_830_400, datasheet=True, counter=False)
    expected = b"PPMC\x01" + (2104).to_bytes(2, "little") + b"\x61" + (9_830_400).to_bytes(4, "little")
    assert talk(bridge, 0, "01") == frame(b"\x00\x00" + expected + (24_000_000).to_bytes(4, "little"))


def test_two_axes() -> None:
    """UB-OPS-02: ops of axis 2 exist only if IDENT reports two axes."""
    bus = Bus()
    assert talk(Bridge(bus), 1, "0A") == talk(Bridge(bus), 1, "0B") == reply(1, "03 00 00")
    bridge = Bridge(bus, part=2104, axes=2)
    assert talk(bridge, 1, "0A 0B 08 09") == reply(1, "00 FD FF FF FF FE FF FF FF")
    assert bus.log == [("zero", 2), ("zero",)]
    assert talk(bridge, 2, "0D") == reply(2, "03 00 00")
    identity = b"PPMC\x01" + (2104).to_bytes(2, "little") + b"\x66"
    assert identity in talk(bridge, 3, "01")


def test_ops_of_the_bridge() -> None:
    bus = Bus()
    bridge = Bridge(bus)
    assert talk(bridge, 1, "00 05 06 07 FE 08 09") == reply(1, "00 FF FE FF FF FF")
    assert bus.log == [("reset",), ("straps", 0xFE), ("zero",)]


def test_ops_on_registers() -> None:
    bus = Bus(0x01)
    bridge = Bridge(bus)
    assert talk(bridge, 1, "1F 77 2E 3D 02 8C 02 01 02") == reply(1, "00 A0 A1 A2")
    assert bus.log == [("w", 15, 0x77), ("r", 14), ("r", 13), ("r", 13), ("w", 12, 1), ("w", 12, 2)]


def test_post_waits_before_each_byte() -> None:
    bus = Bus()
    bus.status = [0x02, 0x00, 0x02, 0x02, 0x80]
    bridge = Bridge(bus)
    assert talk(bridge, 1, "40 02 11 22") == reply(1, "00"), "an error bit does not matter here"
    assert bus.log == [("r", 1)] * 2 + [("w", 0, 0x11)] + [("r", 1)] * 3 + [("w", 0, 0x22)]


def test_call_waits_before_and_after_each_byte() -> None:
    bus = Bus()
    bus.status = [0x02, 0x00, 0x02, 0x10, 0x02, 0x00, 0x42, 0x44]
    bridge = Bridge(bus)
    assert talk(bridge, 1, "52 86 05") == reply(1, "00 44")
    assert bus.log == (
        [("r", 1)] * 2
        + [("w", 1, 0x86)]
        + [("r", 1)] * 2
        + [("r", 1)] * 2
        + [("w", 0, 0x05)]
        + [("r", 1)] * 2
    )


def test_ub_wait_01_limits() -> None:
    for limit in (0, 5, 250):
        bus = Bus()
        bridge = Bridge(bus)
        assert talk(bridge, 1, f"04 {limit:02X} 00 71 01 01") == reply(1, "01 03 00")
        assert limit <= bus.ms <= limit + 1
        assert len(bus.log) >= 1
    bus = Bus()
    assert talk(Bridge(bus), 1, "71 01 01") == reply(1, "01 00 00")
    assert 250 <= bus.ms <= 251, "the limit at the beginning of each script"


def test_the_golden_part_behind_the_bridge() -> None:
    """The examples of docs/uart_bridge.md work with the model of the PPMC-104."""
    board = Carrier(Plant())
    bridge = Bridge(board)
    assert talk(bridge, 0, "55 0A 09 04 04 00") == reply(0, "00 00")
    assert talk(bridge, 1, "54 43 0D 00 00") == reply(1, "00 04")
    assert talk(bridge, 2, "71 04 00 08 51 80 61 51 83 63") == reply(2, "00 00 0E 00 00 00 01 83 01 00 00 00")
    assert talk(bridge, 3, "54 43 0D 00") == reply(3, "03 00 00")
    assert talk(bridge, 4, "51 87") == reply(4, "02 00 80")
