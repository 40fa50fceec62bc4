"""IP-XACT packages: a part with an AXI4-Lite bridge as plain Verilog, for a vendor's IP catalogue (D-126).

A package is a folder with plain Verilog and its description, component.xml, in the version that Vivado reads:
IEEE 1685-2009.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

from systemrdl.node import AddrmapNode, FieldNode, Node, RegfileNode, RegNode

from cocotb_tests.harness.project import top_file
from openppmc import __version__
from openppmc.parts import Row, tops
from scripts.fpga.boards.carrier import Port, read
from scripts.fpga.flow.plain import Value
from scripts.fpga.flow.plain_file import FOLDER, write
from scripts.fpga.packages.registers import elaborated, text

CLK_HZ = 100_000_000
"""Default of CLK_HZ in a package, the usual rate of an AXI bus."""
SPIRIT = "http://www.spiritconsortium.org/XMLSchema/SPIRIT/1685-2009"
XILINX = "http://www.xilinx.com"
FAMILIES = "artix7 artixuplus kintex7 kintexu kintexuplus spartan7 virtex7 virtexu virtexuplus zynq zynquplus"
HIGH = ("csel", "vsel", "run", "mon", "rxd")
"""Inputs that are tied high if they are not used, in addition to the active-low inputs."""


@dataclass(frozen=True)
class Fit:
    """Connection of the bridge to the bus of a part.

    Attributes:
        file: SystemRDL file.
        bits: number of address lines.
        ties: inputs of the part with a fixed level.
    """

    file: str
    bits: int
    address: str
    read: str
    write: str
    interrupt: str
    ties: Mapping[str, int]


FITS = {
    "ppmc104": Fit("mailbox", 1, "a0", "rd_n", "wr_n", "int_n", {}),
    "stmc": Fit("mailbox", 1, "a0", "rd_n", "wr_n", "int_n", {}),
    "ppmc2104": Fit("ppmc2104", 1, "a0", "rw_rds_n", "ds_wrs_n", "int_n", {"busc": 0}),
    "ppmc312": Fit("ppmc312", 3, "rs", "oe_n", "we_n", "irq_n", {"mode": 1}),
    "ppmc_bank": Fit("ppmc_bank", 10, "a", "rd_n", "wr_n", "int_n", {}),
}
NAMES = {f"{top}_axil": top for top in FITS}
"""Top module of the part, by package."""
# AXI4-Lite signals: direction as seen from the package, and highest bit ("": one bit, "a": an address).
AXI = {
    **{"awaddr": "ia", "awvalid": "i", "awready": "o", "wdata": "i31", "wstrb": "i3", "wvalid": "i"},
    **{"wready": "o", "bresp": "o1", "bvalid": "o", "bready": "i", "araddr": "ia", "arvalid": "i"},
    **{"arready": "o", "rdata": "o31", "rresp": "o1", "rvalid": "o", "rready": "i"},
}


def row_of(top: str) -> Row:
    """Return the row of a part in the table of parts."""
    return next(row for row in tops() if row.top == top)


def part_ports(top: str, params: Mapping[str, Value]) -> dict[str, Port]:
    """Return the ports of a part that are also ports of its package."""
    fit, found = FITS[top], read(top_file(row_of(top)), params).ports
    bus = ("clk", "rst_n", "cs_n", "d_i", "d_o", "d_oe", fit.address, fit.read, fit.write, fit.interrupt)
    return {name: port for name, port in found.items() if name not in (*bus, *fit.ties)}


def ports(top: str, params: Mapping[str, Value]) -> list[Port]:
    """Return all ports of a package."""
    found = [Port(f"s_axi_{name}", False, None, "", "") for name in ("aclk", "aresetn")]
    for name, how in AXI.items():
        high = how[1:].replace("a", str(FITS[top].bits + 2))
        found.append(Port(f"s_axi_{name}", how[0] == "o", range(int(high) + 1) if high else None, "", ""))
    irq = Port("irq", True, None, "", "interrupt, high: pending")
    return [*found, irq, *part_ports(top, params).values()]


def wrapper(name: str, params: Mapping[str, Value]) -> str:
    """Return the top module of a package: the bridge and the part."""
    top = NAMES[name]
    fit = FITS[top]
    heads = ",\n".join(
        f"  {'output' if port.output else 'input '} wire {vector(port)}{port.name}"
        for port in ports(top, params)
    )
    axi = [f".{signal}_{how[0]}(s_axi_{signal})" for signal, how in AXI.items()]
    bus = {"cs_n": "cs_n", fit.read: "rd_n", fit.write: "wr_n", fit.address: "a", "d_i": "to_part"}
    bus |= {"d_o": "from_part", "d_oe": "unused_oe", fit.interrupt: "int_n"}
    bus |= {"clk": "s_axi_aclk", "rst_n": "s_axi_aresetn"}
    bus |= {pin: f"1'b{level}" for pin, level in fit.ties.items()}
    bus |= {pin: pin for pin in part_ports(top, params)}
    pins = ",\n    ".join(f".{pin}({net})" for pin, net in bus.items())
    return f"""// SPDX-License-Identifier: Apache-2.0
// {name}: {top} with an AXI4-Lite bridge. OpenPPMC {__version__}; written by `make verilog`.
`default_nettype none

module {name} (
{heads}
);

  wire cs_n, rd_n, wr_n, int_n, unused_oe;
  wire [{fit.bits - 1}:0] a;
  wire [7:0] to_part, from_part;

  {bridge(fit)} u_bridge (
    .clk_i(s_axi_aclk), .rst_ni(s_axi_aresetn), .irq_o(irq),
    {", ".join(axi)},
    .cs_no(cs_n), .rd_no(rd_n), .wr_no(wr_n), .a_o(a), .d_o(to_part), .d_i(from_part), .int_ni(int_n)
  );

  {top} u_part (
    {pins}
  );

endmodule

`default_nettype wire
"""


def vector(port: Port) -> str:
    """Return the range of a port in Verilog, empty for one bit."""
    return f"[{port.bits[-1]}:{port.bits[0]}] " if port.bits else ""


def bridge(fit: Fit) -> str:
    """Return the name of the bridge module, which packages with the same number of address lines share."""
    return f"ppmc_axil_{fit.bits}"


# ------------------------------------------------------------------------------------------ description


def tag(name: str, /, *inner: ET.Element | str, **attributes: str) -> ET.Element:
    """Return an XML element with these children, or with a text."""
    made = ET.Element(name, attributes)
    for one in inner:
        if isinstance(one, str):
            made.text = one
        else:
            made.append(one)
    return made


def memory(node: Node) -> Iterator[ET.Element]:
    """Yield the registers and arrays of registers of an address map."""
    for child in node.children():
        name = tag("name", child.inst_name)
        if isinstance(child, AddrmapNode):
            yield from memory(child)
        elif isinstance(child, RegfileNode | RegNode):
            offset = tag("addressOffset", str(child.raw_address_offset))
            dim = [tag("dim", str(child.n_elements))] if child.is_array else []
            if isinstance(child, RegfileNode):
                size = child.array_stride if child.is_array else child.size
                yield tag("registerFile", name, *dim, offset, tag("range", str(size)), *memory(child))
            else:
                fields = [field(one) for one in child.fields()]
                size = tag("size", str(child.get_property("regwidth")))
                yield tag("register", name, tag("description", text(child)), *dim, offset, size, *fields)


def field(one: FieldNode) -> ET.Element:
    """Return a field of a register."""
    ways = ("read" if one.is_sw_readable else "", "write" if one.is_sw_writable else "")
    access = "-".join(filter(None, ways)) if all(ways) else f"{''.join(ways)}-only"
    return tag(
        "field",
        tag("name", one.inst_name),
        *([tag("description", text(one))] if text(one) else []),
        tag("bitOffset", str(one.low)),
        tag("bitWidth", str(one.width)),
        tag("volatile", str(one.is_hw_writable).lower()),
        tag("access", access),
        *([tag("readAction", "modify")] if one.get_property("onread") else []),
    )


def interface(name: str, kind: str, logical: Mapping[str, str], output: bool, **values: Value) -> ET.Element:
    """Return a bus interface; `values` are its parameters."""
    library = "interface" if kind == "aximm" else "signal"
    vlnv = {"vendor": "xilinx.com", "library": library, "version": "1.0"}
    maps = [
        tag("portMap", tag("logicalPort", tag("name", of)), tag("physicalPort", tag("name", pin)))
        for of, pin in logical.items()
    ]
    portmaps, more = tag("portMaps", *maps), list[ET.Element]()
    bus, way = tag("busType", name=kind, **vlnv), tag("master" if output else "slave")
    if kind == "aximm":
        way.append(tag("memoryMapRef", memoryMapRef="S_AXI"))
    if values:
        more = [tag("parameters", *(parameter(key, value) for key, value in values.items()))]
    kinds = tag("abstractionType", name=f"{kind}_rtl", **vlnv)
    return tag("busInterface", tag("name", name), bus, kinds, way, portmaps, *more)


def parameter(name: str, value: Value) -> ET.Element:
    """Return a fixed parameter of a component or interface."""
    return tag("parameter", tag("name", name), tag("value", str(value)))


def port_of(port: Port) -> ET.Element:
    """Return the description of a port. An input has the level of an unused pin as default value."""
    wire = tag("wire", tag("direction", "out" if port.output else "in"))
    if port.bits:
        wire.append(tag("vector", tag("left", str(port.bits[-1])), tag("right", str(port.bits[0]))))
    if not port.output and not port.name.startswith("s_axi_"):
        high = port.name.endswith("_n") or port.name in HIGH
        wire.append(tag("driver", tag("defaultValue", str((1 << port.width) - 1 if high else 0))))
    about = [tag("description", port.text)] if port.text else []
    return tag("port", tag("name", port.name), *about, wire)


def views(name: str) -> ET.Element:
    """Return the views for synthesis and simulation."""
    files = tag("fileSetRef", tag("localName", "verilog"))
    inner = tag("language", "verilog"), tag("modelName", name), files
    return tag(
        "views",
        *(
            tag("view", tag("name", kind), tag("envIdentifier", f":vivado.xilinx.com:{kind}"), *inner)
            for kind in ("synthesis", "simulation")
        ),
    )


def extensions(name: str) -> ET.Element:
    """Return Vivado's entries: supported families, place and name in the catalogue."""
    family = [tag(f"{{{XILINX}}}family", one) for one in FAMILIES.split()]
    for one in family:
        one.set(f"{{{XILINX}}}lifeCycle", "Beta")
    place = tag(f"{{{XILINX}}}taxonomies", tag(f"{{{XILINX}}}taxonomy", "/UserIP"))
    core = tag(f"{{{XILINX}}}coreExtensions", tag(f"{{{XILINX}}}supportedFamilies", *family), place)
    core.append(tag(f"{{{XILINX}}}displayName", f"OpenPPMC {name}"))
    core.append(tag(f"{{{XILINX}}}coreRevision", "1"))
    return tag("vendorExtensions", core)


def component(name: str, params: Mapping[str, Value]) -> str:
    """Return the description of a package."""
    top = NAMES[name]
    fit, row = FITS[top], row_of(top)
    axi = {signal.upper(): f"s_axi_{signal}" for signal in AXI}
    values = {key: one.default for key, one in read(top_file(row), params).parameters.items()} | params
    sizes = {"baseAddress": 0, "range": 8 << fit.bits, "width": 32}
    block = [tag("name", "registers"), *(tag(key, str(value)) for key, value in sizes.items())]
    # IEEE 1685-2009 requires that the registers precede the arrays of registers.
    block += sorted(memory(elaborated(fit.file, f"{top}_bus")), key=lambda one: one.tag)
    files = [f"{name}.v", f"{bridge(fit)}.v", f"{top}.v"]
    root = tag(
        "component",
        tag("vendor", "openppmc"),
        tag("library", "ppmc"),
        tag("name", name),
        tag("version", ".".join(__version__.split(".")[:2])),
        tag(
            "busInterfaces",
            interface("S_AXI", "aximm", axi, False, PROTOCOL="AXI4LITE"),
            interface(
                "s_axi_aclk",
                "clock",
                {"CLK": "s_axi_aclk"},
                False,
                ASSOCIATED_BUSIF="S_AXI",
                ASSOCIATED_RESET="s_axi_aresetn",
                FREQ_HZ=values["CLK_HZ"],
            ),
            interface("s_axi_aresetn", "reset", {"RST": "s_axi_aresetn"}, False, POLARITY="ACTIVE_LOW"),
            interface("irq", "interrupt", {"INTERRUPT": "irq"}, True, SENSITIVITY="LEVEL_HIGH"),
        ),
        tag("memoryMaps", tag("memoryMap", tag("name", "S_AXI"), tag("addressBlock", *block))),
        tag("model", views(name), tag("ports", *(port_of(port) for port in ports(top, params)))),
        tag(
            "fileSets",
            tag(
                "fileSet",
                tag("name", "verilog"),
                *(tag("file", tag("name", file), tag("fileType", "verilogSource")) for file in files),
            ),
        ),
        tag("description", f"OpenPPMC: {top} on AXI4-Lite. Its parameters are fixed in the Verilog."),
        tag("parameters", *(parameter(key, value) for key, value in values.items())),
        extensions(name),
    )
    ET.register_namespace("spirit", SPIRIT)
    ET.register_namespace("xilinx", XILINX)
    for one in root.iter():
        if not one.tag.startswith("{"):
            one.tag = f"{{{SPIRIT}}}{one.tag}"
            one.attrib = {f"{{{SPIRIT}}}{key}": value for key, value in one.attrib.items()}
    ET.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{ET.tostring(root, encoding="unicode")}\n'


def write_package(name: str, folder: Path = FOLDER / "ip", given: Mapping[str, Value] | None = None) -> Path:
    """Write a package into a folder below `folder`; return the path of component.xml."""
    top, params = NAMES[name], {"CLK_HZ": CLK_HZ, **(given or {})}
    place = folder / name
    shutil.rmtree(place, ignore_errors=True)
    write(top, place, params)
    axil = write("ppmc_axil", place, {"AddrBits": FITS[top].bits})
    own = bridge(FITS[top])
    code = re.sub(r"^(module |  )ppmc_axil(?=\w* )", rf"\1{own}", axil.read_text("utf-8"), flags=re.M)
    (place / f"{own}.v").write_text(code, "utf-8")
    axil.unlink()
    (place / f"{name}.v").write_text(wrapper(name, params), "utf-8")
    made = place / "component.xml"
    made.write_text(component(name, params), "utf-8")
    return made
