"""A PPMC-104, or a bank of its axes, on the Wishbone bus of a LiteX SoC.

Requires the extra `litex`.

    from openppmc.litex import add_part
    add_part(soc, "stepper", "/where/openppmc/is", pads=platform.request("stepper"))

`sources` is one of these folders:

    - a checkout of OpenPPMC,
    - its archive openppmc-rtl (SystemVerilog, for Verilator and other tools that read it),
    - the plain Verilog of a release (for yosys).

The program finds the part at STEPPER_BASE in generated/mem.h and uses the C driver of the project, see
docs/integration.md.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .errors import PpmcError, needs

needs("litex", "openppmc.litex", "litex", "migen")

from litex.gen import LiteXModule  # noqa: E402
from litex.soc.integration.soc import SoCRegion  # noqa: E402
from litex.soc.interconnect import wishbone  # noqa: E402
from litex.soc.interconnect.csr_eventmanager import EventManager, EventSourceLevel  # noqa: E402
from migen import ClockSignal, Instance, ResetSignal, Signal  # noqa: E402


class SourcesError(PpmcError):
    """The sources are missing, or they are plain Verilog with other parameters."""


class PadsError(PpmcError):
    """A pad does not match a port of the part in name or width."""


@dataclass(frozen=True)
class Part:
    """A part that can be added to the SoC.

    Attributes:
        address: port with `bits` address lines.
        parameters: parameters with their defaults.
        inputs: name of each input, with its width and the level of all its bits if it has no pad.
        outputs: name of each output, with its width.

    A width is text: a number of bits, or `*` followed by the number of bits per axis.
    """

    top: str
    files: str
    address: str
    bits: int
    parameters: Mapping[str, int | str]
    inputs: Mapping[str, tuple[str, int]]
    outputs: Mapping[str, str]

    def width(self, text: str, parameters: Mapping[str, Any]) -> int:
        """Return the number of bits of a port whose width is `text`, with these parameters."""
        return int(text[1:]) * int(parameters["AXES"]) if text.startswith("*") else int(text)


SWITCHES = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n")
PARTS = {
    "ppmc104": Part(
        "ppmc104",
        "ppmc104",
        "a0",
        1,
        {"CLK_HZ": 16_000_000, "XTAL_HZ": 16_000_000, "TIMING": "FAST", "PHASE_IDLE": 1},
        {
            **{name: ("1", 1) for name in ("csel", "vsel", *SWITCHES)},
            **{"clock": ("1", 0), "auxi": ("4", 0)},
        },
        {"s": "5", "hold": "1", "pout_n": "1", "dir": "1", "auxo": "4", "aux_n": "1"},
    ),
    "bank": Part(
        "ppmc_bank",
        "ppmc_bank",
        "a",
        10,
        {"AXES": 32, "CLK_HZ": 100_000_000, "XTAL_HZ": 16_000_000, "PHASE_IDLE": 1},
        {name: ("*1", 1) for name in SWITCHES},
        {"s": "*5", "hold": "*1", "pout_n": "*1", "dir": "*1"},
    ),
}
"""Parts for `add_part`, by name. PHASE_IDLE must be 0 if a high level switches a coil on."""
BRIDGE = "ppmc_wishbone"
_BUILT_IN = re.compile(r"^//   (\w+) += (\S+)", re.M)


def _plain(path: Path, expected: Mapping[str, Any]) -> None:
    """Check that a file of plain Verilog has the expected parameters. Raises SourcesError."""
    head = path.read_text(encoding="utf-8").partition("`default_nettype")[0]
    for name, value in _BUILT_IN.findall(head):
        has = re.sub(r"^\d+'[bd]", "", value)
        if name in expected and has != str(expected[name]):
            raise SourcesError(
                f"{path.name} was made with {name} = {value}, this SoC needs {expected[name]}; run "
                f"make verilog TOP={path.stem} PARAMS={name}={expected[name]}"
            )


def add_sources(platform: Any, sources: Path | str, part: Part, parameters: Mapping[str, Any]) -> bool:
    """Add the source files to the platform; a file that is already there is not added again.

    Returns:
        True if the parameters are fixed in the files (plain Verilog).
    """
    folder = Path(sources)
    listed = folder / "packages" / f"{part.files}.f"
    present = {entry[0] for entry in platform.sources}
    if listed.is_file():
        lines = listed.read_text(encoding="utf-8").splitlines()
        for line in (line for line in lines if line and not line.startswith(("//", "--"))):
            word, _, place = line.rpartition("+incdir+")
            path = (listed.parent / place).resolve()
            if line.startswith("+incdir+"):
                if str(path) not in platform.verilog_include_paths:
                    platform.add_verilog_include_path(str(path))
            elif str(path) not in present:
                platform.add_source(str(path), "systemverilog")
        return False
    bridge, own = folder / f"{BRIDGE}.v", folder / f"{part.top}.v"
    for path in (own, bridge):
        if not path.is_file():
            raise SourcesError(f"{folder}: has neither packages/{part.files}.f nor {path.name}")
    _plain(own, parameters)
    _plain(bridge, {"AddrBits": part.bits})
    for path in (own, bridge):
        if str(path.resolve()) not in present:
            platform.add_source(str(path.resolve()), "verilog")
    return True


class PpmcPart(LiteXModule):  # type: ignore[misc]
    """A part and its Wishbone bridge.

    The module has the Wishbone interface `bus`, its `size` in bytes, and the event `ev.finish`, which is
    active while `int_n` is low. The register map is in docs/integration.md.

    Args:
        platform: receives the sources.
        pads: record whose fields have the names of ports of the part. An input without a pad has its idle
            level; an output without a pad is not connected.
        parameters: parameters of the part. CLK_HZ is the clock of the SoC, 8 to 200 MHz.

    Raises:
        SourcesError: sources are missing or have other parameters.
        PadsError: a pad does not match the part.
    """

    def __init__(
        self,
        platform: Any,
        clk_freq: float,
        sources: Path | str,
        part: str = "ppmc104",
        pads: Any = None,
        **parameters: Any,
    ) -> None:
        if part not in PARTS:
            raise SourcesError(f"part {part}: expected {' or '.join(PARTS)}")
        of = PARTS[part]
        if strange := sorted(parameters.keys() - (of.parameters.keys() - {"CLK_HZ"})):
            raise SourcesError(f"{strange[0]}: {part} has no such parameter")
        values = {**of.parameters, **parameters, "CLK_HZ": int(clk_freq)}
        built_in = add_sources(platform, sources, of, values)
        self.size = 8 << of.bits
        self.bus = bus = wishbone.Interface(data_width=32, adr_width=30, addressing="word")
        self.ev = EventManager()
        self.ev.finish = EventSourceLevel(description="A motion has ended.")
        self.ev.finalize()

        chosen, read, write, interrupt = Signal(), Signal(), Signal(), Signal()
        address, to_part, from_part = Signal(of.bits), Signal(8), Signal(8)
        reset = ~ResetSignal("sys")
        self.specials += Instance(
            BRIDGE,
            **({} if built_in else {"p_AddrBits": of.bits}),
            i_clk_i=ClockSignal("sys"),
            i_rst_ni=reset,
            i_cyc_i=bus.cyc,
            i_stb_i=bus.stb,
            i_we_i=bus.we,
            i_adr_i=bus.adr[: of.bits + 1],
            i_sel_i=bus.sel,
            i_dat_i=bus.dat_w,
            o_dat_o=bus.dat_r,
            o_ack_o=bus.ack,
            o_err_o=bus.err,
            o_irq_o=self.ev.finish.trigger,
            o_cs_no=chosen,
            o_rd_no=read,
            o_wr_no=write,
            o_a_o=address,
            o_d_o=to_part,
            i_d_i=from_part,
            i_int_ni=interrupt,
        )
        self.specials += Instance(
            of.top,
            **({} if built_in else {f"p_{name}": value for name, value in values.items()}),
            i_clk=ClockSignal("sys"),
            i_rst_n=reset,
            **{f"i_{of.address}": address},
            i_cs_n=chosen,
            i_rd_n=read,
            i_wr_n=write,
            i_d_i=to_part,
            o_d_o=from_part,
            o_int_n=interrupt,
            **self._pins(of, pads, values),
        )

    @staticmethod
    def _pins(of: Part, pads: Any, values: Mapping[str, Any]) -> dict[str, Any]:
        """Return the ports of a part as arguments of the instance, connected to pads or to idle levels."""
        found = {}
        named = {} if pads is None else {field[0]: getattr(pads, field[0]) for field in pads.layout}
        for name, (text, level) in of.inputs.items():
            width = of.width(text, values)
            found[f"i_{name}"] = named.pop(name, Signal(width, reset=((1 << width) - 1) * level))
            _fits(name, found[f"i_{name}"], width)
        for name, text in of.outputs.items():
            if name in named:
                found[f"o_{name}"] = named.pop(name)
                _fits(name, found[f"o_{name}"], of.width(text, values))
        if named:
            ports = ", ".join((*of.inputs, *of.outputs))
            raise PadsError(f"pad {next(iter(named))}: {of.top} has no such port (it has {ports})")
        return found


def _fits(name: str, pad: Any, width: int) -> None:
    if len(pad) != width:
        raise PadsError(f"pad {name} has {len(pad)} bits, the port {width}")


def add_part(
    soc: Any,
    name: str,
    sources: Path | str,
    part: str = "ppmc104",
    pads: Any = None,
    origin: int | None = None,
    **parameters: Any,
) -> PpmcPart:
    """Add a part to a SoC with a Wishbone bus. Its interrupt is connected if the CPU has interrupts.

    Args:
        name: name of the module, of its region (NAME_BASE in generated/mem.h) and of its interrupt
            (NAME_INTERRUPT).
        origin: base address, in a region that is not cached; `None` lets LiteX select one.

    Other arguments are those of `PpmcPart`.

    Returns:
        The module.
    """
    module = PpmcPart(soc.platform, soc.sys_clk_freq, sources, part, pads, **parameters)
    soc.add_module(name, module)
    soc.bus.add_slave(name, module.bus, SoCRegion(origin=origin, size=module.size, cached=False))
    if soc.irq.enabled:
        soc.irq.add(name, use_loc_if_exists=True)
    return module
