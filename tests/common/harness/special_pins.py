"""Pins of the boards in constraints/ that also have another function on the board, with the sources.

The sources are public: constraint files and schematics of the manufacturers and of other open projects.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto


class Kind(Enum):
    """Kind of the other function of a pin. The kind determines which uses of the pin are excluded."""

    NEVER = auto()  # configuration, flash, JTAG, control lines of a monitor: not usable
    # another chip on the board can drive the pin: not usable as an output, or as a limit or alarm input
    DRIVEN = auto()
    SOCKET = auto()  # in a socket or a section of the header that can be left empty
    # connected to an LED, converter or amplifier, in a bank with another voltage, or used during
    # configuration
    LOADED = auto()
    NEAR_5V = auto()  # next to a header pin that carries 5 V


@dataclass(frozen=True)
class Special:
    """Pins of a board that have the same other function, and the source of this information."""

    pins: tuple[str, ...]
    kind: Kind
    job: str
    source: str


def pins(text: str) -> tuple[str, ...]:
    """Return the names in a text; they are separated by spaces, and 36-39 represents four names."""
    names = []
    for word in text.split():
        first, _, last = word.partition("-")
        names += [str(number) for number in range(int(first), int(last) + 1)] if last else [word]
    return tuple(names)


LITEX = "https://github.com/litex-hub/litex-boards/tree/master/litex_boards/platforms/"
AMARANTH = "https://github.com/amaranth-lang/amaranth-boards/tree/main/amaranth_boards/"
SIPEED9 = "https://github.com/sipeed/TangNano-9K-example/tree/main/spi_lcd/src/lcd114_test.cst"
SIPEED4 = "https://github.com/sipeed/TangNano-4K-example/tree/main/"
SIPEED = "https://github.com/sipeed/TangNano-20K-example/tree/main/"
MISTERY_NANO = "https://github.com/harbaum/MiSTeryNano/tree/main/src/tang/nano20k/"
CHUBBY75 = "https://github.com/q3k/chubby75/tree/master/5a-75b/hardware_V7.0.md"
BUFFERS = CHUBBY75 + ", https://github.com/kittennbfive/5A-75B-tools/tree/master/buffer_overview"
ULX3S = "https://github.com/emard/ulx3s/tree/master/"
APICULA = "https://github.com/YosysHQ/apicula (pin functions of the package in its chip database)"
DIGILENT = "https://digilent.com/reference/programmable-logic/arty-a7/reference-manual"
EFINIX = "https://github.com/Efinix-Inc/xyloni/tree/master/"
TERASIC = "DE10-Nano User Manual, Terasic: figure of the two 40-pin expansion headers"

SPECIAL: dict[str, tuple[Special, ...]] = {
    "icebreaker": (
        Special(pins("12-17"), Kind.NEVER, "configuration flash", LITEX + "icebreaker.py"),
        Special(
            pins("18 19 20 21 23 25 26 27"), Kind.SOCKET, "break-off section, PMOD 2", LITEX + "icebreaker.py"
        ),
    ),
    "icestick": (
        Special(pins("67 68 70 71"), Kind.NEVER, "configuration flash", AMARANTH + "icestick.py"),
        Special(pins("105-107"), Kind.NEVER, "IrDA transceiver", AMARANTH + "icestick.py"),
        Special(pins("1-4 7"), Kind.DRIVEN, "control lines of the USB-UART", AMARANTH + "icestick.py"),
    ),
    "ulx3s": (
        Special(
            pins("R2 U3 W2 V2 W1 Y2"),
            Kind.NEVER,
            "configuration flash",
            ULX3S + "doc/constraints/ulx3s_v20.lpf",
        ),
        Special(pins("T5 R5 U5 V4"), Kind.NEVER, "JTAG", ULX3S + "doc/constraints/ulx3s_v20.lpf"),
        Special(pins("L2"), Kind.LOADED, "ESP32 GPIO0, GPIO22 on v3.1", ULX3S + "doc/constraints/prototype"),
        Special(pins("F4 E3 G3 F3"), Kind.DRIVEN, "ESP32", ULX3S + "doc/constraints/ulx3s_v20.lpf"),
        Special(
            pins("H4 G5"),
            Kind.LOADED,
            "ESP32, inputs of it",
            ULX3S + "doc/constraints/ulx3s_v20.lpf",
        ),
        Special(
            pins("U18 U17 N17 P16 N16 M17 L16 L17"),
            Kind.LOADED,
            "inputs of the converter",
            ULX3S + "doc/constraints/ulx3s_v20.lpf",
        ),
        Special(
            pins("B11 C11 A10 A11 A9 B10 B9 C10 A7 A8 C8 B8 C6 C7 A6 B6 A4 A5 A2 B1 C4 B4"),
            Kind.LOADED,
            "bank voltage of J5",
            ULX3S + "gpio.sch",
        ),
        Special(pins("D13 E13"), Kind.NEAR_5V, "near 5 V", ULX3S + "gpio.sch"),
    ),
    "ulx3s_v31": (
        Special(
            pins("R2 U3 W2 V2 W1 Y2"),
            Kind.NEVER,
            "configuration flash",
            ULX3S + "doc/constraints/prototype/ulx3s_v316.lpf",
        ),
        Special(pins("T5 R5 U5 V4"), Kind.NEVER, "JTAG", ULX3S + "doc/constraints/prototype/ulx3s_v316.lpf"),
        Special(pins("F1"), Kind.LOADED, "ESP32 GPIO0", ULX3S + "doc/constraints/prototype/ulx3s_v316.lpf"),
        Special(
            pins("G3 F3 H4 G5"), Kind.DRIVEN, "ESP32", ULX3S + "doc/constraints/prototype/ulx3s_v316.lpf"
        ),
        Special(
            pins("B11 C11 A10 A11 A9 B10 B9 C10 A7 A8 C8 B8 C6 C7 A6 B6 A4 A5 A2 B1 C4 B4"),
            Kind.LOADED,
            "bank voltage of J5",
            ULX3S + "gpio.sch",
        ),
        Special(pins("D13 E13"), Kind.NEAR_5V, "near 5 V", ULX3S + "gpio.sch"),
    ),
    "tangnano20k": (
        Special(pins("25 26"), Kind.NEVER, "HDMI CEC and hot plug; LCD", LITEX + "sipeed_tang_nano_20k.py"),
        Special(pins("57 59-63"), Kind.NEVER, "configuration flash", MISTERY_NANO + "atarist.cst"),
        Special(pins("5-9"), Kind.NEVER, "JTAG, RECONFIG_N", APICULA),
        Special(pins("52 53"), Kind.DRIVEN, "HDMI DDC", LITEX + "sipeed_tang_nano_20k.py"),
        Special(pins("75 76 86 13"), Kind.DRIVEN, "BL616", MISTERY_NANO + "atarist.cst"),
        Special(
            pins("27-42 48 49 77"),
            Kind.SOCKET,
            "LCD",
            SIPEED + "rgb_lcd, " + MISTERY_NANO + "atarist_lcd.cst",
        ),
        Special(pins("80-85"), Kind.SOCKET, "card socket", LITEX + "sipeed_tang_nano_20k.py"),
        Special(pins("51 54-56"), Kind.LOADED, "audio amplifier", SIPEED + "audio/src/audio.cst"),
        Special(pins("15-18"), Kind.LOADED, "LEDs 1 to 4", LITEX + "sipeed_tang_nano_20k.py"),
        Special(pins("19 20"), Kind.LOADED, "LEDs 5 and 6", LITEX + "sipeed_tang_nano_20k.py"),
        Special(pins("79"), Kind.LOADED, "RGB LED", SIPEED + "ws2812/src/ws2812.cst"),
        Special(pins("87"), Kind.NEVER, "MODE1", APICULA),
        Special(pins("88"), Kind.LOADED, "MODE0", APICULA),
    ),
    "tangnano9k": (
        Special(pins("59-62"), Kind.NEVER, "configuration flash", LITEX + "sipeed_tang_nano_9k.py"),
        Special(pins("5-9 87 88"), Kind.NEVER, "JTAG, RECONFIG_N, MODE", APICULA),
        Special(pins("86"), Kind.NEVER, "LCD backlight", LITEX + "sipeed_tang_nano_9k.py"),
        Special(pins("4"), Kind.LOADED, "JTAGSEL_N", APICULA),
        Special(pins("79-85"), Kind.LOADED, "1.8 V", LITEX + "sipeed_tang_nano_9k.py"),
        Special(pins("36-39"), Kind.SOCKET, "card socket", LITEX + "sipeed_tang_nano_9k.py"),
        Special(pins("68-75"), Kind.SOCKET, "HDMI and LCD", LITEX + "sipeed_tang_nano_9k.py"),
        Special(
            pins("33-35 40-42 48 49 51 76 77"),
            Kind.SOCKET,
            "LCD connectors",
            LITEX + "sipeed_tang_nano_9k.py, " + SIPEED9,
        ),
        Special(pins("53-57"), Kind.SOCKET, "LCD, configuration", APICULA),
    ),
    "colorlight_v70": (
        Special(pins("N8 T7 T8"), Kind.NEVER, "configuration flash", AMARANTH + "colorlight_5a75b_r7_0.py"),
        Special(pins("M8 M9 T6 R6"), Kind.NEVER, "configuration", CHUBBY75),
        Special(pins("P5"), Kind.LOADED, "reset of the Ethernet chips", CHUBBY75),
        Special(
            pins("M1 N1 M5 N5 M6 N6 M16 P13 N13 P14 M15 L15 T2"),
            Kind.DRIVEN,
            "Ethernet chips",
            AMARANTH + "colorlight_5a75b_r7_0.py",
        ),
        Special(pins("M13"), Kind.LOADED, "button J28", CHUBBY75),
        Special(pins("P11"), Kind.LOADED, "LED", CHUBBY75),
        Special(
            pins(
                "F3 F1 G3 G2 H3 H5 J4 K3 G1 K4 C2 E3 H4 K5 P1 R1 L5 F2 P4 R2 H13 J13 H12 G14 H14 G15 "
                "A15 F16 A14 E13 B14 A13"
            ),
            Kind.LOADED,
            "74HC245 to the header",
            BUFFERS,
        ),
        Special(pins("M11 N11 P12 K15 N12 L16 K16 J15"), Kind.LOADED, "74HC245 U9 to the header", BUFFERS),
    ),
    "tangnano4k": (
        Special(pins("1 2 47 48"), Kind.NEVER, "configuration flash", LITEX + "sipeed_tang_nano_4k.py"),
        Special(pins("3 4 6-9"), Kind.NEVER, "JTAG, JTAGSEL_N, DONE", APICULA),
        Special(pins("10"), Kind.NEVER, "MODE1, LED", APICULA),
        Special(pins("27-35"), Kind.NEVER, "HDMI, 2.5 V", SIPEED4 + "camera_hdmi/src/dk_video.cst"),
        Special(pins("13-23"), Kind.LOADED, "1.8 V", SIPEED4 + "key_blink/src/key_blink.cst, " + APICULA),
        Special(pins("39-44 46"), Kind.SOCKET, "camera", SIPEED4 + "camera_hdmi/src/dk_video.cst"),
    ),
    "arty_a7": (
        Special(pins("C2"), Kind.LOADED, "USB-UART through JP2", DIGILENT),
        Special(
            pins("G13 B11 A11 D12 D13 B18 A18 K16 D4 D3 F4 F3 E2 D2 H2 G2"),
            Kind.LOADED,
            "200 Ω in series",
            DIGILENT,
        ),
    ),
    "de10nano": (
        Special(pins("AF4 AD5"), Kind.NEAR_5V, "beside 5 V", TERASIC),
        Special(pins("AG26 AG25"), Kind.NEAR_5V, "beside 5 V", TERASIC),
    ),
    "xyloni": (
        Special(pins("J4 H4 F4 H3"), Kind.NEVER, "configuration flash", EFINIX + "bsp/build.py"),
        Special(pins("G5 G4 J3 J2"), Kind.NEVER, "card socket", EFINIX + "bsp/build.py"),
        Special(
            pins("F8 E7 F7 E6 F6 F5 G9 H9 J9 J8 G8 H8 J7 E8 D9 B9 D6 C8 B8 A9 A8 C7 C6 B6"),
            Kind.LOADED,
            "bank voltage of J1 and J2",
            EFINIX + "README.md",
        ),
        Special(
            pins("B3 C5 D7 D8 J6"), Kind.LOADED, "configuration", EFINIX + "docs/xyloni-github-headers.md"
        ),
        Special(pins("A5 G3 G1"), Kind.NEAR_5V, "near 5 V", EFINIX + "docs/xyloni-github-headers.md"),
    ),
}
