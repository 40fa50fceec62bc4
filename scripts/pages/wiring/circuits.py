"""The circuit of each pin of a board, and its components. Reasons: docs/boards.md, sections 4 to 9."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from scripts.fpga.boards.pads import Fitted, Pad

WEAK, STRONG = "2.2 kΩ", "1 kΩ"
STRONG_FPGA = ("artix7", "cyclone5")
"""Families whose internal pull-ups need the stronger resistor."""


@dataclass(frozen=True)
class Item:
    """A line of an order list.

    Attributes:
        number: number of pins of a circuit -> quantity.
    """

    what: str
    order: str
    number: Callable[[int], int]


def each(count: int = 1) -> Callable[[int], int]:
    """Return a function for `count` items for each pin."""
    return lambda pins: count * pins


def chips(channels: int) -> Callable[[int], int]:
    """Return a function for the number of chips with `channels` channels."""
    return lambda pins: -(-pins // channels)


def fixed(count: int) -> Callable[[int], int]:
    """Return a function for `count` items in total."""
    return lambda pins: count


CAPACITOR = "100 nF ceramic, at each chip"


@dataclass(frozen=True)
class Circuit:
    """The circuit of a group of pins.

    Attributes:
        ports: ports of the carrier.
        chip: name of the chip in the drawing; it has `channels` channels.
        far: connection of a pin on the other side, with the signal level `level`.
        pull: connection of a pin's resistor at the FPGA's side, "" without a resistor.
        items: items of the order list.
        note: text below the drawing.
    """

    key: str
    title: str
    ports: frozenset[str]
    chip: str
    channels: int
    far: Callable[[Pad], str]
    level: str
    pull: Callable[[Pad], str] = lambda pad: ""
    items: tuple[Item, ...] = ()
    note: str = ""


def _ports(text: str) -> frozenset[str]:
    return frozenset(text.split())


def _idle(pad: Pad) -> str:
    """Return "3.3 V" for the resistor of an output that is inactive when high, else "GND"."""
    return "3.3 V" if pad.port.endswith("_n") else "GND"


FROM_ONE = ("gpi", "gpo")
"""Ports whose bit 0 has the number 1 on the old chip."""


def _old(pad: Pad) -> str:
    """Return the name in the data sheet of the old chip."""
    name, bracket, bit = pad.bit.partition("[")
    star = "*" if name.endswith("_n") else ""
    number = bit.rstrip("]")
    if name in ("s1", "s2"):
        return f"S{number}{name[1]}"  # phase and axis, as in the data sheet of the PPMC-2104
    if bracket and name in FROM_ONE:
        number = str(int(number) + 1)
    return f"{name.removesuffix('_n').upper()}{number}{star}"


def _gate(pad: Pad) -> str:
    return "" if pad.port == "clk_o" else _idle(pad)


CIRCUITS = (
    Circuit(
        "data",
        "Data bus of the old host (HOST=bus)",
        _ports("d d_oe"),
        "74LVC8T245",
        9,
        lambda pad: "DIR" if pad.port == "d_oe" else f"{_old(pad)} of the old socket",
        "5 V",
        lambda pad: "GND" if pad.port == "d_oe" else "",
        (
            Item("bus transceiver with two supplies", "SN74LVC8T245PW, on a TSSOP-24 adapter", fixed(1)),
            Item("100 nF ceramic, VCCA and VCCB", "K104K15X7RF5TL2", fixed(2)),
        ),
        "VCCA = 3.3 V, VCCB = 5 V of the old board, OE* to GND. DIR is an input of the 3.3 V side.",
    ),
    Circuit(
        "control",
        "Control lines of the old host (HOST=bus)",
        _ports("a0 cs_n rd_n wr_n host_rst_n ds_wrs_n rw_rds_n rs oe_n we_n errint_n"),
        "74LVC245, to the FPGA",
        8,
        lambda pad: "RESET, L = reset" if pad.port == "host_rst_n" else f"{_old(pad)} of the old socket",
        "5 V in",
        items=(
            Item("buffer at 3.3 V, inputs tolerate 5 V", "SN74LVC245AN (DIP-20)", chips(8)),
            Item(CAPACITOR, "K104K15X7RF5TL2", chips(8)),
            Item("33 Ω, in series at the host's side", "CFR-25JB-52-33R", each()),
        ),
        note="VCC = 3.3 V, OE* to GND, direction strapped. Unused inputs to GND.",
    ),
    Circuit(
        "request",
        "Interrupt and wait lines (HOST=bus)",
        _ports("int_n irq_n wrq_n"),
        "74LVC1G07",
        1,
        lambda pad: f"{_old(pad)} of the old socket, 4.7 kΩ to 5 V there",
        "5 V, open drain",
        lambda pad: "3.3 V",
        (
            Item("open-drain buffer, at 3.3 V", "SN74LVC1G07DBVR, on a SOT-23 adapter", each()),
            Item("4.7 kΩ to 5 V, if not on the old board", "CFR-25JB-52-4K7", each()),
            Item(CAPACITOR, "K104K15X7RF5TL2", each()),
        ),
    ),
    Circuit(
        "switches",
        "Limits, alarm: fail-safe, 24 V",
        _ports("l1_n l2_n l3_n l4_n alm_n mon fl_n bl_n fhl_n bhl_n ext1 ext2"),
        "opto",
        1,
        lambda pad: f"{_old(pad)}: normally closed contact to 24 V",
        "24 V, isolated",
        items=(
            Item("optocoupler", "PC817X2CSP9F or LTV-817", each()),
            Item("2.2 kΩ 0.5 W, in series with the LED", "CFR-50JB-52-2K2", each()),
            Item("1 kΩ, from the pin to GND", "CFR-25JB-52-1K", each()),
            Item("10 nF, at the pin to GND", "K103K15X7RF5TH5", each()),
        ),
        note="One for each pin, collector to 3.3 V, emitter to the pin. Dark or wire broken = L = active.",
    ),
    Circuit(
        "origin",
        "Origin",
        _ports("cnp_n org_n"),
        "opto_open",
        1,
        lambda pad: f"{_old(pad)}: contact to 24 V",
        "24 V, isolated",
        lambda pad: "3.3 V",
        (
            Item("optocoupler", "PC817X2CSP9F or LTV-817", each()),
            Item("2.2 kΩ 0.5 W, in series with the LED", "CFR-50JB-52-2K2", each()),
        ),
        "One for each pin. Collector to the pin, emitter to GND: lit = L = active.",
    ),
    Circuit(
        "steps",
        "Pulse and direction: a driver carrier",
        _ports("pout_n dir hold"),
        "DRV8825 carrier",
        3,
        lambda pad: {
            "pout_n": "STEP",
            "dir": "DIR",
            "hold": "N-MOSFET at VREF: less current at standstill",
        }[pad.port],
        "3.3 V",
        lambda pad: "3.3 V" if pad.port == "pout_n" else "",
        (),
        "Direct, no shifter. nENBL to GND, RESET* and SLEEP* to 3.3 V, 100 µF at VMOT.",
    ),
    Circuit(
        "phases",
        "Phases: unipolar motor, H = on",
        _ports("s s1 s2"),
        "ULN2003A",
        7,
        lambda pad: f"winding {_old(pad)}",
        "motor supply, ≤ 50 V",
        lambda pad: "GND",
        (
            Item("driver, seven channels", "ULN2003AN (DIP-16)", chips(7)),
            Item("Zener diode, about the motor voltage", "1N5359B at 24 V", chips(7)),
        ),
        "COM through the Zener diode to the motor's supply, E to GND. Bipolar: docs/boards.md, section 7.",
    ),
    Circuit(
        "drive",
        "Servo drive with 5 V inputs",
        _ports("pout exon_n cd_n cclr_n aclr_n zclmp_n intlk_n dir312 clk_o"),
        "74HCT244 at 5 V",
        8,
        lambda pad: f"{_old(pad)} of the drive",
        "5 V",
        _gate,
        (
            Item("buffer at 5 V, accepts 3.3 V", "SN74HCT244N (DIP-20)", chips(8)),
            Item(CAPACITOR, "K104K15X7RF5TL2", chips(8)),
        ),
        "VCC = 5 V of the drive's side, both G* to GND.",
    ),
    Circuit(
        "outputs",
        "General outputs",
        _ports("auxo aux_n auxo_n gpo"),
        "74HCT244 at 5 V",
        8,
        lambda pad: f"{_old(pad)} of the machine",
        "5 V",
        _idle,
        (
            Item("buffer at 5 V, accepts 3.3 V", "SN74HCT244N (DIP-20)", chips(8)),
            Item(CAPACITOR, "K104K15X7RF5TL2", chips(8)),
        ),
        "Relays and lights: add a ULN2803A.",
    ),
    Circuit(
        "inputs",
        "Encoder, events, clocks, general inputs",
        _ports("auxi gpi run extck clock evt0_n evt1_n epin epdir index_n end_n fset_n"),
        "74LVC245, to the FPGA",
        8,
        lambda pad: f"{_old(pad)} of the machine",
        "3.3 or 5 V in",
        items=(
            Item("buffer at 3.3 V, inputs tolerate 5 V", "SN74LVC245AN (DIP-20)", chips(8)),
            Item(CAPACITOR, "K104K15X7RF5TL2", chips(8)),
            Item("10 kΩ, from each used input to 3.3 V", "CFR-25JB-52-10K", each()),
        ),
        note="VCC = 3.3 V, OE* to GND. Leave unused inputs open at the board.",
    ),
    Circuit(
        "straps",
        "Straps",
        _ports("csel vsel busc hsp mod adr"),
        "jumper",
        1,
        lambda pad: "jumper to GND = L, open = H",
        "GND or open",
        items=(Item("jumper 2.54 mm with two pins", "M20-9990245 and M7582-05", each()),),
        note="Only a jumper to GND: never connect a voltage.",
    ),
    Circuit(
        "line",
        "RS-485 line, two wires",
        _ports("rs485_rxd rs485_txd rs485_de"),
        "MAX3485",
        3,
        lambda pad: {"rs485_rxd": "RO", "rs485_txd": "DI", "rs485_de": "DE and RE*"}[pad.port],
        "A, B: RS-485",
        lambda pad: "GND" if pad.port == "rs485_de" else "3.3 V" if pad.port == "rs485_rxd" else "",
        (
            Item("transceiver at 3.3 V", "MAX3485CPA+ (DIP-8)", fixed(1)),
            Item("120 Ω, at both ends of the line", "CFR-25JB-52-120R", fixed(1)),
            Item(CAPACITOR, "K104K15X7RF5TL2", fixed(1)),
        ),
        "VCC = 3.3 V. A and B through 120 Ω only at the ends of the line.",
    ),
    Circuit(
        "eeprom",
        "EEPROM",
        _ports("scl sda"),
        "24LC32A",
        2,
        lambda pad: pad.port.upper(),
        "3.3 V",
        lambda pad: "3.3 V",
        (
            Item("EEPROM, 4 KiB", "24LC32A-I/P (DIP-8)", fixed(1)),
            Item(CAPACITOR, "K104K15X7RF5TL2", fixed(1)),
        ),
        "VCC = 3.3 V, A0, A1, A2, WP to GND.",
    ),
    Circuit(
        "bridges",
        "Power stage of the microstep drive",
        _ports("m10 m11 m20 m21 bridge_a_en bridge_b_en pwm_a_ref pwm_b_ref cmp_a cmp_b"),
        "power stage",
        10,
        lambda pad: {
            "pwm_a_ref": "low-pass, reference of comparator A",
            "pwm_b_ref": "low-pass, reference of comparator B",
            "cmp_a": "comparator A, H = reached",
            "cmp_b": "comparator B, H = reached",
        }.get(pad.port, "half bridge" if pad.port.startswith("m") else "enable of both half bridges"),
        "3.3 V logic",
        lambda pad: "GND" if pad.way == "out" and not pad.port.startswith("pwm") else "",
        (),
        "Select it for the motor: docs/pmc006/README.md, Power stage.",
    ),
    Circuit(
        "spi",
        "SPI host",
        _ports("sck mosi spi_cs_n miso int_n_spi"),
        "microcontroller",
        5,
        lambda pad: pad.port.removesuffix("_n").upper(),
        "3.3 V only",
        items=(Item("33 Ω, in series at the sender", "CFR-25JB-52-33R", each()),),
        note="3.3 V pins of the microcontroller direct, 5 V pins through a 74LVC245.",
    ),
    Circuit(
        "direct",
        "Direct, 3.3 V",
        _ports("ext1_pu ext2_pu mon_step mon_dir conv adc_stb bemf_stb hold_only"),
        "header",
        1,
        lambda pad: {
            "ext1_pu": f"{WEAK} to ext1",
            "ext2_pu": f"{WEAK} to ext2",
            "mon_step": "a scope",
            "mon_dir": "a scope",
        }.get(pad.port, "converter at 3.3 V, if there is one"),
        "3.3 V only",
    ),
)
OWN_GROUPS = 1
"""Number of groups at the beginning of the list whose circuits are on the board itself."""


@dataclass(frozen=True)
class Use:
    """A circuit with its pins."""

    circuit: Circuit
    pads: tuple[Pad, ...]
    strong: bool

    @property
    def resistor(self) -> str:
        """Value of the resistors at the FPGA's side."""
        return STRONG if self.strong else WEAK

    @property
    def channels(self) -> int:
        """Number of pins that use a channel."""
        return sum(pad.port != "d_oe" for pad in self.pads)


def _circuit_of(fitted: Fitted, pad: Pad) -> str:
    """Return the key of a pin's circuit; raise ValueError if the pin has no circuit."""
    servo = fitted.on.row.folder == "ppmc312"
    port = pad.port
    if port == "dir" and servo:
        return "drive"
    if port == "hold" and not any(other.port == "pout_n" for other in fitted.pads):
        return "outputs"
    if port == "int_n" and "spi" in fitted.on.hosts:
        return "spi"
    found = next((one.key for one in CIRCUITS if port in one.ports), None)
    if found is None:
        raise ValueError(
            f"{fitted.board.name} {fitted.on.name}: {pad.bit} has no circuit; add it to scripts/pages/wiring"
        )
    return found


def uses(fitted: Fitted) -> list[Use]:
    """Return the circuits of a part on a board, in order; raise ValueError for a pin without a circuit."""
    own = {pad.bit for group in fitted.groups if group.title == "Board" for pad in group.pads}
    own |= {"uart_rxd", "uart_txd"}
    pads: dict[str, list[Pad]] = {}
    for pad in fitted.pads:
        if pad.bit not in own:
            pads.setdefault(_circuit_of(fitted, pad), []).append(pad)
    if "steps" in pads:
        # Sorted by motor, because a driver carrier counts as a chip.
        pads["steps"].sort(
            key=lambda pad: int(pad.bit.rstrip("]").rpartition("[")[2]) if "[" in pad.bit else 0
        )
    strong = fitted.board.family in STRONG_FPGA
    return [Use(one, tuple(pads[one.key]), strong) for one in CIRCUITS if one.key in pads]


def order(found: list[Use]) -> list[tuple[int, str, str]]:
    """Return quantity, description and order number; equal items of several circuits are one line."""
    lines: dict[tuple[str, str], int] = {}
    for use in found:
        for item in use.circuit.items:
            key = (item.what, item.order)
            lines[key] = lines.get(key, 0) + item.number(use.channels)
        if pulls := sum(bool(use.circuit.pull(pad)) for pad in use.pads):
            value = "2K2" if not use.strong else "1K"
            key = (f"{use.resistor}, at the FPGA's side (see the drawing)", f"CFR-25JB-52-{value}")
            lines[key] = lines.get(key, 0) + pulls
        if use.circuit.key == "steps":
            axes = sum(pad.port == "pout_n" for pad in use.pads)
            rows = [
                ("driver carrier, one for each motor", "Pololu 2133 (DRV8825)"),
                ("100 µF 50 V at VMOT", "EEU-FR1H101"),
            ]
            if any(pad.port == "hold" for pad in use.pads):
                rows.append(("N-MOSFET, current at standstill", "2N7000"))
            for row in rows:
                lines[row] = lines.get(row, 0) + axes
    return [(number, *key) for key, number in lines.items()]
