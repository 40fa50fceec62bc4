"""Write a LiteX SoC with motors: `python -m tests.common.litex.soc FOLDER SOURCES [PROGRAM]`.

The SoC has a PPMC-104 and, if SOURCES contains SystemVerilog, a bank. The Verilog and the headers for the
program are written to FOLDER; PROGRAM is the content of its ROM. The module runs as a separate process,
because LiteX keeps the last SoC in global variables.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

from litex.build.generic_platform import GenericPlatform, Pins, Subsignal
from litex.build.io import CRG
from litex.soc.integration.builder import Builder
from litex.soc.integration.common import get_mem_data
from litex.soc.integration.soc_core import SoCCore

from openppmc.litex import add_part

CLK_HZ = 16_000_000
AXES = 4
ROM, RAM = 0x8000, 0x2000
FILES, INCLUDE = "sources.txt", "+incdir+"
"""FILES: file that lists the other sources, one path per line. INCLUDE: first word of a line with an include
folder.
"""


def pads(*names: tuple[str, int]) -> list[Subsignal]:
    """Return pads for a simulation, in which nothing is connected to pins."""
    return [Subsignal(name, Pins(width)) for name, width in names]


IO = [
    ("sys_clk", 0, Pins(1)),
    (
        "serial",
        0,
        *pads(("source_valid", 1), ("source_ready", 1), ("source_data", 8)),
        *pads(("sink_valid", 1), ("sink_ready", 1), ("sink_data", 8)),
    ),
    ("stepper", 0, *pads(("pout_n", 1), ("dir", 1), ("s", 5), ("l1_n", 1))),
]
BANK_IO = [("bank", 0, *pads(("pout_n", AXES), ("dir", AXES)))]


class Bench(GenericPlatform):
    """A platform that only writes Verilog."""

    def __init__(self) -> None:
        super().__init__("none", [*IO], name="bench")

    def build(self, fragment, build_dir, **_) -> object:
        """Write soc.v, the contents of memories in the same folder, and the names of the other sources."""
        os.chdir(build_dir)
        fragment = fragment.get_fragment()
        self.finalize(fragment)
        output = self.get_verilog(fragment, name="soc")
        output.write("soc.v")
        names = [f"{INCLUDE}{path}" for path in self.verilog_include_paths]
        names += [entry[0] for entry in self.sources]
        Path(FILES).write_text("\n".join([*names, ""]), encoding="utf-8")
        return output.ns


class Soc(SoCCore):
    """VexRiscv, ROM, RAM, UART on parallel pads, and motors."""

    def __init__(self, sources: str, program: list[int]) -> None:
        platform = Bench()
        super().__init__(
            platform,
            CLK_HZ,
            cpu_type="vexriscv",
            integrated_rom_size=ROM,
            integrated_rom_init=program,
            integrated_sram_size=RAM,
            uart_name="sim",
            with_timer=False,
        )
        self.crg = CRG(platform.request("sys_clk"))
        add_part(self, "stepper", sources, pads=platform.request("stepper"), XTAL_HZ=CLK_HZ)
        # A folder of plain Verilog contains the bridge for only one of the two devices.
        if (Path(sources) / "packages").is_dir():
            platform.add_extension(BANK_IO)
            add_part(self, "bank", sources, part="bank", pads=platform.request("bank"), AXES=AXES)


def main() -> int:
    """Write the SoC; return the exit code."""
    folder, sources, *program = sys.argv[1:]
    sources = str(Path(sources).resolve())
    rom = get_mem_data(program[0], data_width=32, endianness="little") if program else [0]
    builder = Builder(Soc(sources, rom), output_dir=folder, compile_software=False, compile_gateware=False)
    builder.build()
    return 0


if __name__ == "__main__":
    sys.exit(main())
