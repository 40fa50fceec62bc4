"""Cell counts of a mapped netlist: LUTs, flip-flops and block RAMs."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path

# Number of LUTs of each cell of iCE40, ECP5 and Gowin. On Gowin, an adder bit (ALU) occupies a LUT. A CCU2C
# is two LUTs, as in the ECP5 packer.
LUT_CELLS = {
    **{"SB_LUT4": 1, "LUT4": 1, "CCU2C": 2, "TRELLIS_DPR16X4": 6},
    **{"LUT1": 1, "LUT2": 1, "LUT3": 1, "ALU": 1, "RAM16SDP4": 4},
}
RAM_CELLS = {"SB_RAM40_4K", "DP16KD", "PDPW16KD", "SP", "SDPB", "DPB", "SPX9", "SDPX9B", "DPX9B"}
FF_CELLS = ("SB_DFF", "TRELLIS_FF", "DFF")  # prefixes of the names of flip-flops


def counts(path: Path, top: str) -> dict[str, int]:
    """Return the number of LUTs (lut), flip-flops (ff) and block RAMs (ram) of a flattened netlist."""
    cells = json.loads(path.read_text())["modules"][top]["cells"].values()
    kinds = Counter(cell["type"] for cell in cells)
    return {
        "lut": sum(LUT_CELLS.get(kind, 0) * number for kind, number in kinds.items()),
        "ff": sum(number for kind, number in kinds.items() if kind.startswith(FF_CELLS)),
        "ram": sum(number for kind, number in kinds.items() if kind in RAM_CELLS),
    }
