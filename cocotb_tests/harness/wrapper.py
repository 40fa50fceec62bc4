"""Makes one top module of many block instances: ports are called <instance>_<port>."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Block:
    """One instance: module, its ports as "name[:width[:cast type]]" and its parameters.

    Names that end in _i or _ni are inputs. clk_i and rst_ni are added unless `bare`.
    """

    module: str
    text: str
    params: Mapping[str, int] = field(default_factory=dict)
    bare: bool = False

    @property
    def ports(self) -> list[tuple[str, int, str]]:
        """(name, width, cast type or "") of every port."""
        words = self.text.split() if self.bare else ["clk_i", "rst_ni", *self.text.split()]
        cells = [(word + "::").split(":", 2) for word in words]
        return [(name, int(width or 1), cast.strip(":")) for name, width, cast in cells]


def is_input(port: str) -> bool:
    """True for a port that the test drives."""
    return port.endswith(("_i", "_ni"))


def wrapper_text(top: str, blocks: Mapping[str, Block]) -> str:
    """SystemVerilog of the top module; `chosen` is the number, from 1, of the instance that is clocked."""
    # Inputs start at random levels: only the chosen instance has a clock, so no other one can complain.
    pins, body = [], ["  logic [7:0] chosen = 8'd0;"]
    for number, (name, block) in enumerate(blocks.items(), 1):
        links = []
        for port, width, cast in block.ports:
            kind = "input wire logic" if is_input(port) else "output logic"
            pins.append(f"    {kind} [{width - 1}:0] {name}_{port}")
            if port == "clk_i":
                links.append(f".clk_i({name}_clk_i && chosen == 8'd{number})")
                continue
            links.append(f".{port}({cast}'({name}_{port}))" if cast else f".{port}({name}_{port})")
        values = ", ".join(f".{key}({value})" for key, value in block.params.items())
        body.append(f"  {block.module} #({values}) u_{name} ({', '.join(links)});")
    return "\n".join([f"module {top} (", ",\n".join(pins), ");", *body, "endmodule", ""])
