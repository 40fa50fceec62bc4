"""The parts of the playground, with their builds and the devices at their pins. Source: docs/playground.md.

Each part has one build, whose parameters are those for which the sessions of the manuals were written. It has
further builds with the parameters of the boards, with which the page compares the edges of a board.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from cocotb_tests.bank.bench import B8
from cocotb_tests.harness.config import F16, Config
from cocotb_tests.harness.part import PARTS, Part
from cocotb_tests.pmc006.builds import F8B
from cocotb_tests.ppmc312.line.setting import BIT, F8L, FASTEST, STATIONS
from openppmc import parts
from scripts.fpga.flow.board_table import DESCRIPTIONS
from scripts.site.stations import Stations


@dataclass(frozen=True)
class Motor:
    """A motor and its machine model.

    Attributes:
        step: the pin that outputs the steps: a bit of an output, or, with `phases`, the lowest of five bits.
        edge: level after the edge of a step.
        dir: pin of the direction, which is CCW at level `ccw`.
        switches: input pins in the order of tb/board/plant.h (CW and CCW limit, CW and CCW slow-down limit,
            origin, alarm), "" for a missing switch; a closed switch is low.
        windings: pins of the phases for the picture, S1 first.
        encoder: pins of the encoder pulse and of its direction.
    """

    step: str
    switches: tuple[str, ...]
    dir: str = ""
    edge: int = 0
    ccw: int = 1
    phases: bool = False
    windings: tuple[str, ...] = ()
    encoder: tuple[str, ...] = ()


@dataclass(frozen=True)
class WebPart:
    """A part in the playground.

    Attributes:
        bus: kind of host (site/src/engine).
        idle: levels of the straps of the part.
        busy: status bits that a host polls until they are 0.
        bits: names of the bits in the status register, bit 7 first.
        straps: pins with a button in addition to the switches.
        hint: example of an input, which the page shows to the user.
        phase_on: level of the pin of an energised winding.
        settle: cycles from the reset to the first access.
        first: number that the first axis has in statements.
        stations: stations of a line; each station is one of the motors.
        name_shown: title of the part in the page, if not the one of the table of parts.
        bit: duration of a bit on a line in cycles, if no parameter BAUD defines it.
    """

    name: str
    bus: str
    motors: tuple[Motor, ...]
    straps: tuple[str, ...] = ()
    hint: str = ""
    bits: tuple[str, ...] = ()
    busy: int = 0x04
    phase_on: int = 1
    settle: int = 4
    first: int = 1
    config: Config = F16
    idle: Mapping[str, int] = field(default_factory=dict)
    stations: Stations | None = None
    bit: float = 0
    name_shown: str = ""

    @property
    def title(self) -> str:
        """Title of the part in the page."""
        return self.name_shown or parts.PARTS[self.name].title

    @property
    def device(self) -> Part:
        """The pins of the top module with the parameters of this build."""
        part = PARTS[parts.PARTS[self.name].folder if self.stations else self.name]
        return part.built(part.params(self.config))

    @property
    def part(self) -> Part:
        """The pins of the module: those of the part, or those of all stations."""
        return self.stations.pins(self.device) if self.stations else self.device

    @property
    def params(self) -> dict[str, object]:
        """The parameters of its top module."""
        return dict(self.device.params(self.config))


def _phases(port: str) -> tuple[str, ...]:
    return tuple(f"{port}[{n}]" for n in range(1, 6))


LIMITS = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n")
FLAGS = ("ERR", "N2", "N1", "N0", "0", "BUSY", "IBF", "OBF")


def _axis(n: int) -> Motor:
    switches = tuple(f"{pin}[{n}]" for pin in ("fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n"))
    return Motor(f"pout_n[{n}]", switches, f"dir[{n}]", windings=_phases(f"s{n}_n"))


def _bank_axis(n: int) -> Motor:
    switches = tuple(f"{pin}[{n}]" for pin in (*LIMITS, "alm_n"))
    return Motor(f"pout_n[{n}]", switches, f"dir[{n}]", windings=tuple(f"s[{5 * n + k}]" for k in range(5)))


def _station(n: int) -> Motor:
    switches = tuple(f"{pin}[{n}]" for pin in ("fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n"))
    return Motor(f"pout[{n}]", switches, f"dir[{n}]", edge=1, encoder=(f"epin[{n}]", f"epdir[{n}]"))


LINE = Stations(
    STATIONS,
    "adr",
    # The serial mode at 83 333 baud. The pins of the parallel bus and the unused clock are inactive.
    {"mode": 0, "mod": FASTEST, "hsp": 1} | {"d_i": 0, "rs": 0, "cs_n": 1, "we_n": 1, "oe_n": 1, "extck": 0},
    ("d_o", "d_oe", "wrq_n", "irq_n"),
    states=("u_serial.u_rx_frame.state_q", "u_core.u_axis.u_motion.state_q"),
    period=1600,  # multiple of 64 and of 50 us
)
WEB_PARTS: dict[str, WebPart] = {
    part.name: part
    for part in (
        WebPart(
            "ppmc104",
            "byte",
            (Motor("pout_n", (*LIMITS, "alm_n"), "dir", windings=_phases("s")),),
            straps=("csel", "vsel"),
            hint="c 43 d E7 d 03 d 00",
            bits=FLAGS,
        ),
        WebPart(
            "ppmc2104",
            "byte",
            (_axis(1), _axis(2)),
            straps=("run[1]", "run[2]", "csel[1]", "csel[2]", "errint_n"),
            hint="c 43 d E7 d 03 d 00",
            bits=("ERROR", "0", "CMND2", "CMND1", "BUSY2", "BUSY1", "IBF", "OBF"),
            busy=0x0C,
            phase_on=0,
        ),
        WebPart(
            "stmc",
            "byte",
            (Motor("s[1]", (*LIMITS, "mon"), phases=True, windings=_phases("s")),),
            hint="c 43 d 1F d 03 d 00",
            bits=FLAGS,
        ),
        WebPart(
            "ppmc312",
            "block",
            (
                Motor(
                    "pout",
                    ("fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n"),
                    "dir",
                    edge=1,
                    encoder=("epin", "epdir"),
                ),
            ),
            straps=("run", "evt0_n", "evt1_n", "end_n", "index_n"),
            hint="> 03 04 86 00 01F4",
            bits=("0", "EWRQ", "EWIRQ", "ERIRQ", "MWEF", "MREF", "0", "0"),
        ),
        WebPart(
            "ppmc312-serial",
            "line",
            tuple(_station(n) for n in range(STATIONS)),
            straps=("run", "evt0_n", "evt1_n", "end_n", "index_n"),
            hint="axis 3; > 84 01F4 00000064",
            config=F8L,
            bit=BIT,
            settle=24,
            first=0,
            stations=LINE,
            name_shown="PPMC-312 line",
        ),
        WebPart(
            "pmc006",
            "frame",
            (
                Motor(
                    "mon_step",
                    ("ext1", "ext2", "", "", "", ""),
                    "mon_dir",
                    edge=1,
                    ccw=0,
                    windings=("phase_a_ref", "phase_b_ref"),
                ),
            ),
            straps=("fset_n", *(f"gpi[{n}]" for n in range(5))),
            hint="f s 2000",
            bits=("0", "0", "0", "stalled", "reduced", "EXT2", "EXT1", "busy"),
            config=F8B,
            settle=1200,
            # The EEPROM has no supply here, so its data line is low, and the part boots immediately.
            idle={"sda_i": 0},
        ),
        WebPart(
            "bank",
            "window",
            tuple(_bank_axis(n) for n in range(8)),
            hint="axis 3 c 43 d E7 d 03 d 00",
            bits=FLAGS,
            config=B8,
            settle=24,
            first=0,
        ),
    )
}


def on_boards(part: WebPart) -> Iterator[tuple[str, WebPart]]:
    """Yield the builds of a part for the boards whose bitstreams can have a recorder, by their names.

    The values are those of the board.yml files. The name of a build contains the values that differ from
    those of the part in the page. Boards with the same values have the same build.
    """
    for of in DESCRIPTIONS if parts.PARTS[part.name].number else ():
        for on in of.parts:
            if on.part != part.name or "uart" not in on.hosts or "RECORD" in (on.omit or {}):
                continue
            given = {**of.defaults, **(on.set or {}), "CLK_HZ": round(on.mhz * 1e6)}
            old = {**part.config.params, **dict(part.config.extra)}
            new = {name: given.get(name, value) for name, value in old.items()}
            name = "_".join([part.name, *(str(new[key]) for key in part.params if new[key] != old[key])])
            fixed = (new["CLK_HZ"], new["XTAL_HZ"], new["TIMING"], new["PHASE_IDLE"])
            extra = tuple((key, new[key]) for key, _ in part.config.extra)
            settle = part.settle * fixed[0] // part.config.clk_hz
            yield name, replace(part, config=Config(name, *fixed, extra), settle=settle)


BOARD_BUILDS: dict[str, dict[str, WebPart]] = {
    name: dict(on_boards(part)) for name, part in WEB_PARTS.items()
}
"""Builds for boards, by part and by name."""
BUILDS: dict[str, WebPart] = {
    name: build
    for part, one in WEB_PARTS.items()
    for name, build in {part: one, **BOARD_BUILDS[part]}.items()
}
"""All builds by name: those of WEB_PARTS, each with its builds for boards."""
