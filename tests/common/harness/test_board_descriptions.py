"""Descriptions of FPGA boards: a new board gets top and constraints; each mistake is reported in one line."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from cocotb_tests.harness.project import ProjectError
from scripts.fpga.boards import carrier, constraints, top
from scripts.fpga.boards.__main__ import all_files, left_over
from scripts.fpga.boards.description import Description, load
from scripts.fpga.boards.pads import Fitted, fit
from tests.common.harness.test_boards import clocks, pins, ports_of

BOARD = """
title: Breadboard
place: 9
chip: LFE5U-12F
family: ecp5
devices:
  bread: {title: Breadboard, device: LFE5U-12F, route: [--12k]}
suffix: .bit
loader: bread
port: the only one
clock: {port: clk_50m, pin: A1, mhz: 50, what: oscillator}
reset: {port: btn, pin: A2, active: 1, pull: down, what: button}
leds:
  active: 0
  pins:
    - {port: led_n, pin: A3, shows: moving, what: red LED}
uart: {title: UART, rxd: {pin: A4, what: from the PC}, txd: {pin: A5, what: to the PC}}
ties: {usb_dp: {pin: A6, level: 0, what: USB, reason: No device is there.}}
pads: {standard: LVCMOS33, drive: 4}
headers: {X1: {X1-1: B1, X1-2: B2, X1-3: B3, X1-4: B4, X1-5: B5, X1-6: B6}}
parts:
  ppmc104:
    mhz: 50
    hosts: [uart]
    low: {auxi: nothing is connected}
    pins:
      "X1: motor":
        pout_n: X1-1
        dir: "X1-2, green wire"
        s: [X1-3, X1-4]
      "X1: limits":
        l1_n: X1-5
        auxi: [X1-6]
code: BREA
"""


def described(folder: Path, text: str = BOARD) -> Description:
    """Load this text as the description of a board with the name bread."""
    path = folder / "bread" / "board.yml"
    path.parent.mkdir()
    path.write_text(text)
    return load(path)


def fitted(folder: Path, text: str = BOARD) -> Fitted:
    """Return the board with the first part that it supports, and the pads of the part's ports."""
    board = described(folder, text)
    on = board.parts[0]
    return fit(board, on, carrier.read(carrier.path_of(on.row), on.set))


def test_a_new_board_needs_its_description_only(tmp_path: Path) -> None:
    """From board.yml alone, a top and a pin file with the same ports are generated."""
    one = fitted(tmp_path)
    ((name, text),) = top.file(one.board, one).items()
    assert name == "boards/bread/board_bread_ppmc104.sv"
    assert "Written by `make boards` from constraints/bread/board.yml" in text.splitlines()[1]
    assert "module board_bread_ppmc104 #(" in text
    assert "localparam int unsigned ClkHz = 50_000_000;" in text
    ((file, pin_text),) = constraints.files(one).items()
    assert file == "bread/ppmc104/pins.lpf"
    found = pins(pin_text, ".lpf")
    declared = ports_of(text)
    assert sorted(bit for bit, _ in found) == sorted(bit for port in declared.values() for bit in port.bits)
    assert dict(found)["s[2]"] == "B4"
    assert clocks(pin_text, ".lpf") == {"clk_50m": 50}
    assert {name: port.direction for name, port in declared.items()} == {
        **dict.fromkeys(("clk_50m", "btn", "uart_rxd", "l1_n", "auxi"), "input"),
        **dict.fromkeys(("uart_txd", "s", "pout_n", "dir", "led_n", "usb_dp"), "output"),
    }


def test_what_has_no_pin(tmp_path: Path) -> None:
    """An input without a pin reads as 1, or as 0 if the description sets 0; an output without a pin
    is open.
    """
    ((_, text),) = top.file((one := fitted(tmp_path)).board, one).items()
    joined = re.sub(r" +", "", text)
    for words in (
        ".l2_n(1'b1)",
        ".auxi({3'b000,auxi})",
        ".hold()",
        ".d_i('1)",
        ".s(part_s)",
        '.HOST("UART")',
    ):
        assert words in joined
    assert "assign s = part_s[2:1];" in re.sub(r" +", " ", text)
    assert "assign led_n = ~leds[1];" in re.sub(r" +", " ", text)
    assert "// No device is there.\n  assign usb_dp = 1'b0;" in text
    assert ".lock_i(1'b1)" in joined and ".req_ni(!btn)" in joined


def test_a_board_without_a_button(tmp_path: Path) -> None:
    """Without `reset`, the top has no button, and only power-on resets the part."""
    line = "reset: {port: btn, pin: A2, active: 1, pull: down, what: button}\n"
    one = fitted(tmp_path, BOARD.replace(line, ""))
    ((_, text),) = top.file(one.board, one).items()
    assert ".req_ni(1'b1)" in re.sub(r" +", "", text) and "btn" not in ports_of(text)
    ((_, pin_text),) = constraints.files(one).items()
    assert "A2" not in dict(pins(pin_text, ".lpf")).values()


@pytest.mark.parametrize(
    ("was", "new", "said"),
    [
        ("loader: bread\n", "", "loader is missing"),
        ("title: Breadboard\nplace", "place", "title is missing"),
        ("suffix: .bit", "sufix: .bit", "unknown key sufix"),
        ("pull: down", "pul: down", "reset: unknown key pul"),
        ("    mhz: 50\n", "", "parts: ppmc104: mhz is missing"),
        ("    mhz: 50", "mhz: 50", "line 24: mapping values"),
        ("hosts: [uart]", "hosts: [usb]", "hosts: usb: expected uart, bus, spi"),
        ("shows: moving", "shows: red", "shows red: expected link, moving"),
        ("family: ecp5", "family: ecp6", "family ecp6: expected ice40"),
        ("  ppmc104:", "  ppmc999:", "there is no such part"),
        ("l1_n: X1-5", "l9_n: X1-5", "l9_n: ppmc104_carrier has no such port"),
        ("s: [X1-3, X1-4]", '"s[6]": X1-3', "s[6]: ppmc104_carrier has s[1] to s[5]"),
        ("l1_n: X1-5", "l1_n: X2-5", "l1_n: X2-5 is not a header pin"),
        ("l1_n: X1-5", "l1_n: X1-1", "B1 is used twice"),
        ("auxi: [X1-6]", "hold: [X1-6, X1-5]", "hold: 2 pins for 1 bits"),
    ],
)
def test_a_mistake_is_one_line(tmp_path: Path, was: str, new: str, said: str) -> None:
    assert BOARD.count(was) == 1
    with pytest.raises(ProjectError) as caught:
        fitted(tmp_path, BOARD.replace(was, new))
    assert said in str(caught.value)
    assert str(caught.value).startswith("constraints/bread/board.yml: ") and "\n" not in str(caught.value)


def test_bits_in_the_middle_are_not_left_out(tmp_path: Path) -> None:
    one = fitted(tmp_path, BOARD.replace("s: [X1-3, X1-4]", '"s[2]": X1-3'))
    with pytest.raises(ProjectError, match="s: only high bits may lack a pin"):
        top.file(one.board, one)


def test_written_files_are_fresh() -> None:
    """Except for spaces, all generated files are up to date, and no file of a removed board remains.

    `make lint` also compares the spaces, because it has the program that formats the tops.
    """
    expected = all_files(layout=str)
    same = {
        path: "".join(path.read_text(encoding="utf-8").split()) == "".join(expected[path].split())
        for path in expected
    }
    assert all(same.values()), [path.name for path, fresh in same.items() if not fresh]
    assert not left_over(expected)


VECTORS = """
module tiny_carrier #(
    parameter int unsigned AXES = 4,
    parameter string       HOST = "UART"
) (
    input  wire logic              clk,
    input  wire logic [  AXES-1:0] l1_n,
    output logic      [5*AXES-1:0] s,
    output logic                   miso_o,
    output logic                   miso_oe
);
endmodule
"""


def test_vectors_as_wide_as_a_parameter(tmp_path: Path) -> None:
    """If the width of a port depends on a parameter, it follows the default or the value that the
    board sets.
    """
    path = tmp_path / "tiny_carrier.sv"
    path.write_text(VECTORS)
    for given, axes in ((None, 4), ({"AXES": 8}, 8)):
        found = carrier.read(path, given)
        assert (found.ports["l1_n"].width, found.ports["s"].width) == (axes, 5 * axes)
        assert found.ports["s"].bit_names()[-1] == f"s[{5 * axes - 1}]"
        assert found.two_way() == {"miso": "miso_o"} and found.side("miso").output


@pytest.mark.parametrize("wrong", ["HOST-1", "AXIS-1", "AXES"])
def test_a_width_that_cannot_be_known(tmp_path: Path, wrong: str) -> None:
    """If the width of a port depends on anything other than a parameter, this is rejected in one line."""
    path = tmp_path / "tiny_carrier.sv"
    path.write_text(VECTORS.replace("5*AXES-1", wrong))
    with pytest.raises(ProjectError, match=rf"^\[{wrong}:0\]: expected a number or \[n\*\]PARAMETER-1$"):
        carrier.read(path)
