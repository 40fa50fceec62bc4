"""Ports: errors when a port is opened, and when it disappears."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from openppmc.host import Disconnected, Link, NoAnswer, PortError, ProtocolError, WrongDevice, open_port
from openppmc.host.frames import Deframer, Frame, encode
from openppmc.host.script import Script
from openppmc.model.carrier.carrier import Plant
from openppmc.sim.common.machine import parse_machine
from scripts.measure.fire.line import Fault, FaultyLine, Kind


def test_no_port_named() -> None:
    with pytest.raises(PortError, match="--port or OPENPPMC_PORT"):
        open_port("")


def test_no_such_port() -> None:
    with pytest.raises(PortError, match=r"/dev/ttyNOPE9: no such port; "):
        open_port("/dev/ttyNOPE9")


def test_a_file_is_not_a_serial_port(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("x")
    with pytest.raises(PortError, match="not a serial port"):
        open_port(str(file))
    with pytest.raises(PortError, match="not a serial port"):
        open_port(str(tmp_path))


def test_a_port_that_is_taken() -> None:
    master, slave = pytest.importorskip("pty").openpty()
    try:
        first = open_port(os.ttyname(slave))
        with pytest.raises(PortError, match="another program has this port open"):
            open_port(os.ttyname(slave))
        first.close()
        first.close()
        open_port(os.ttyname(slave)).close()
    finally:
        os.close(master)
        os.close(slave)


def test_the_adapter_is_asked_for_low_latency(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[bool] = []
    monkeypatch.setattr("serial.Serial.set_low_latency_mode", lambda port, on: asked.append(on))
    master, slave = pytest.importorskip("pty").openpty()
    try:
        open_port(os.ttyname(slave)).close()
    finally:
        os.close(master)
        os.close(slave)
    assert asked == [True]


def test_no_permission(monkeypatch: pytest.MonkeyPatch) -> None:
    """Root may open any port, so a replacement raises the error."""
    pytest.importorskip("grp")
    monkeypatch.setattr("sys.platform", "linux")

    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("serial.Serial", refuse)
    with pytest.raises(PortError, match=r"no permission: add yourself to its group \(\w+\): sudo usermod"):
        open_port("/dev/null")


def test_unplugging_a_real_port() -> None:
    master, slave = pytest.importorskip("pty").openpty()
    name = os.ttyname(slave)
    port = open_port(name)
    os.close(slave)
    os.close(master)
    with pytest.raises(Disconnected, match="plug the board in"):
        for _ in range(50):
            port.write(b"x")
            port.read(0.05)
    port.close()


def test_nothing_answers() -> None:
    master, slave = pytest.importorskip("pty").openpty()
    try:
        with pytest.raises(NoAnswer, match="is the board powered"):
            Link(os.ttyname(slave))
    finally:
        os.close(master)
        os.close(slave)


class Fake:
    """A port whose responses are computed by a function. Each read advances its clock."""

    name = "fake"

    def __init__(self, answer: object) -> None:
        self._answer = answer
        self._out = b""
        self._time = 0.0
        self._deframer = Deframer()
        self.closed = False

    def read(self, timeout: float) -> bytes:
        out, self._out = self._out, b""
        self._time += 0.001 if out else timeout
        return out

    def write(self, data: bytes) -> None:
        for item in self._deframer.feed(data):
            if isinstance(item, Frame):
                self._out += self._answer(item.payload)  # type: ignore[operator]

    def set_baud(self, baud: int) -> None:
        pass

    def clock(self) -> float:
        return self._time

    def close(self) -> None:
        self.closed = True


def identity(version: int = 1, part: int = 104) -> bytes:
    return b"PPMC" + bytes([version]) + part.to_bytes(2, "little") + b"\x62" + bytes(8)


@pytest.mark.parametrize(
    ("answer", "kind", "text"),
    [
        (lambda request: b"", NoAnswer, "no answer: is the board powered"),
        (lambda request: b"login: " * 9, WrongDevice, "no answer of a PPMC bridge"),
        (lambda request: encode(request[:1] + b"\x00" + b"X" * 16), WrongDevice, "no PPMC bridge"),
        (lambda request: encode(request[:1] + b"\x00XX"), WrongDevice, "no PPMC bridge"),
        (
            lambda request: encode(request[:1] + b"\x00" + identity(2)),
            WrongDevice,
            "version 2, .* renew this package",
        ),
        (
            lambda request: encode(request[:1] + b"\x00" + identity(0)),
            WrongDevice,
            "renew the board's bitstream",
        ),
        (
            lambda request: encode(request[:1] + b"\x00" + identity(1, 312)),
            WrongDevice,
            "PPMC-312, not a PPMC-104",
        ),
    ],
)
def test_wrong_things_at_the_port(answer: object, kind: type[Exception], text: str) -> None:
    port = Fake(answer)
    with pytest.raises(kind, match=text):
        Link(port, part=104)
    assert port.closed


@pytest.mark.parametrize("damaged", [1, 2])
def test_an_answer_that_does_not_match_its_script_is_requested_again(damaged: int) -> None:
    """If the CRC of an answer ends with 00, the answer is also valid without this 00, or with two. The host
    requests such an answer again; after two answers of the wrong length, an error is raised.
    """
    asked: list[bytes] = []

    def answer(request: bytes) -> bytes:
        if request[1:] == b"\x01":
            return encode(request[:1] + b"\x00" + identity())
        if request[1:] != b"\x08":
            return encode(request[:1] + b"\x00")
        asked.append(request)
        return encode(request[:1] + b"\x00" + bytes(3 if len(asked) <= damaged else 4))

    link = Link(Fake(answer), baud=115_200)
    if damaged == 1:
        assert link.execute(Script().count()).number(0) == 0
        assert len(asked) == 2 and asked[0] == asked[1] and link.repeats == 1
    else:
        with pytest.raises(ProtocolError, match="bad answer .3 data bytes where COUNT gives 4"):
            link.execute(Script().count())


def test_a_rate_that_is_none() -> None:
    with pytest.raises(PortError, match="9600 baud is not a rate of the bridge: it has 115200"):
        Link("model:", baud=9600)


@pytest.mark.parametrize(("clk", "asked", "got"), [(16, 1_000_000, 1_000_000), (16, 3_000_000, 3_000_000)])
def test_the_rate_is_raised(clk: int, asked: int, got: int) -> None:
    with Link(f"model:speed=max,clk={clk}000000", baud=asked) as link:
        assert link.baud == got
        link.execute(Script().pins())
        assert link.repeats == 0


def test_a_rate_that_the_board_has_not() -> None:
    with Link("model:speed=max,clk=8000000", baud=3_000_000) as link:
        assert link.baud == 115_200


def test_a_rate_that_does_not_get_through(monkeypatch: pytest.MonkeyPatch) -> None:
    """If the cable damages everything above 115 200 baud, the link falls back to 115 200 baud."""
    port = open_port("model:speed=max")
    rates = [115_200]
    write, set_baud = port.write, port.set_baud

    def switch(baud: int) -> None:
        rates.append(baud)
        set_baud(baud)

    def cable(data: bytes) -> None:
        write(data if rates[-1] == 115_200 else bytes(byte ^ 0x10 for byte in data))

    monkeypatch.setattr(port, "set_baud", switch)
    monkeypatch.setattr(port, "write", cable)
    with Link(port, baud=1_000_000) as link:
        assert link.baud == 115_200
        assert rates == [115_200, 1_000_000, 115_200]
        assert link.execute(Script().pins()).byte(0) & 1


@pytest.mark.parametrize("to_board", [False, True])
def test_one_lost_byte_costs_no_rate(to_board: bool) -> None:
    """If any single byte of the connection is lost, the link still works at the requested rate.

    If the answer to RATE is lost, the bridge already works at the new rate, and the repeated requests arrive
    as framing errors.
    """
    line = FaultyLine(open_port("model:speed=max"))
    Link(line, baud=1_000_000)
    for place in range(line.passed[to_board]):
        damaged = FaultyLine(open_port("model:speed=max"), [Fault(Kind.LOSE, to_board, place)])
        assert Link(damaged, baud=1_000_000).baud == 1_000_000, place


def test_an_adapter_that_refuses_the_rate(monkeypatch: pytest.MonkeyPatch) -> None:
    port = open_port("model:speed=max")
    set_baud = port.set_baud

    def refuse(baud: int) -> None:
        if baud > 115_200:
            raise PortError("cannot")
        set_baud(baud)

    monkeypatch.setattr(port, "set_baud", refuse)
    with Link(port, baud=1_000_000) as link:
        assert link.baud == 115_200
        assert link.execute(Script().pins()).byte(0) & 1


def test_the_first_bytes_wake_the_bridge() -> None:
    """UB-LIN-06: the host first sends bytes that are a break at any higher rate, then 7D 7E, which ends an
    open frame as invalid.
    """
    port = Fake(
        lambda request: encode(request[:1] + b"\x00" + (identity() if request[1:] == b"\x01" else b""))
    )
    sent: list[bytes] = []
    write = port.write
    port.write = lambda data: (sent.append(data), write(data))[1]  # type: ignore[method-assign]
    Link(port, baud=115_200)
    assert b"".join(sent).startswith(b"\x00\x00\x7d\x7e" + encode(b"\x00\x01"))


def test_a_bridge_that_was_left_at_a_high_rate_is_woken_up() -> None:
    port = open_port("model:speed=max")
    link = Link(port, baud=3_000_000)
    link.execute(Script().pins())
    port.set_baud(115_200)
    again = Link(port, baud=115_200)
    assert again.execute(Script().pins()).byte(0) & 1


def test_closing_leaves_a_quiet_board() -> None:
    port = open_port("model:speed=max")
    Link(port).close()
    assert port.bridge.rate == 0  # type: ignore[attr-defined]
    assert port.bridge.interrupt() == b""  # type: ignore[attr-defined]


def test_unplugging_the_model() -> None:
    with Link("model:speed=max,unplug=5") as link:
        with pytest.raises(Disconnected, match="plug the board in"):
            link.pause(10)
        with pytest.raises(Disconnected):
            link.execute(Script().pins())
    with pytest.raises(Disconnected, match="closed"):
        link.execute(Script().pins())


def test_machine_text() -> None:
    machine = parse_machine("start=-5, cw=9,alarm=-3..4,vcd=x.vcd")
    assert (machine.part, machine.plants) == ("ppmc104", (Plant(start=-5, cw=9, alarm=(-3, 4)),))
    assert machine.others == {"vcd": "x.vcd"}
    assert parse_machine("").plants == (Plant(),)
    machine = parse_machine("cw2=77,part=PPMC2104,start=1,alarm2=1..2")
    assert (machine.part, machine.others) == ("ppmc2104", {})
    assert machine.plants == (Plant(start=1), Plant(cw=77, alarm=(1, 2)))
    for text in ("start", "start=", "cw=1.5", "alarm=5", "alarm=9..1", "alarm=a..b", f"cw={1 << 31}"):
        with pytest.raises(ValueError, match=r"form|number|outside|exceed"):
            parse_machine(text)
    for text, complaint in (
        ("part=ppmc999", "part=ppmc999: there are ppmc104, ppmc2104"),
        ("cw2=5,start=3", "cw2=5: a ppmc104 has one axis"),
        ("part=ppmc2104,alarm2=5", "alarm2=5 is not of the form alarm2=100..200"),
    ):
        with pytest.raises(ValueError, match=complaint):
            parse_machine(text)


def test_plant_levels() -> None:
    plant = Plant(cw=100, ccw=-10, slow_cw=90, slow_ccw=5, origin=0, alarm=(50, 60))

    def active(position: int) -> set[str]:
        return {name for name, level in plant.levels(position).items() if not level}

    assert active(40) == set()
    assert active(50) == active(60) == {"alarm"}
    assert active(61) == set()
    assert active(90) == {"slow_cw"}
    assert active(100) == {"limit_cw", "slow_cw"}
    assert active(5) == {"slow_ccw"}
    assert active(0) == {"slow_ccw", "origin"}
    assert active(-10) == {"limit_ccw", "slow_ccw", "origin"}


@pytest.mark.parametrize(
    "text",
    ["foo=1", "speed=0", "speed=fast", "clk=1", "timing=SLOW", "clk=x", "unplug=x", "cw", "cw2=4", "part=x"],
)
def test_bad_model_texts(text: str) -> None:
    with pytest.raises(PortError, match="^model:"):
        open_port("model:" + text)
