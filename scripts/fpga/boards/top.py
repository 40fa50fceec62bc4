"""The top of a board as SystemVerilog: pads, PLL, power-on reset and LEDs around <part>_carrier."""

from __future__ import annotations

from cocotb_tests.harness.header import Parameter
from cocotb_tests.harness.project import ProjectError
from scripts.fpga.boards.carrier import Port
from scripts.fpga.boards.description import SHOWS, Description
from scripts.fpga.boards.pads import HOST_RESET, Fitted
from scripts.fpga.boards.texts import clk, head, title, wrapped
from scripts.fpga.boards.verilog import declaration, instance, literal, part_select, without_comma

OWN_LEDS = ("lock", "req_n", "lamps")
"""Ports of a carrier that contains reset and LED logic; for other carriers, the top adds ppmc_board_leds."""


class Top:
    """Writer of one top; its methods are in the order of the sections in the file."""

    def __init__(self, fitted: Fitted) -> None:
        self.fitted = fitted
        self.board, self.on, self.carrier = fitted.board, fitted.on, fitted.carrier
        self.pll = self.board.clock.get("module")
        self.clk = "clk" if self.pll else self.board.clock["port"]
        self.own_leds = all(port in self.carrier.ports for port in OWN_LEDS)
        self.two_way = self.carrier.two_way()
        self.fixed = {"HOST": literal(self.on.hosts[0].upper())} if len(self.on.hosts) == 1 else {}
        self.fixed |= {name: literal(value) for name, value in (self.on.set or {}).items()}
        self.wires: list[str] = []
        self.unused: list[str] = []
        self.assigns: list[str] = []

    def parameters(self) -> list[Parameter]:
        """Return the parameters of the top: those of the carrier, with the defaults for this board."""
        hidden = {"CLK_HZ", *self.fixed, *(self.on.omit or {})}
        return [parameter for parameter in self.carrier.parameters.values() if parameter.name not in hidden]

    def comment(self) -> list[str]:
        """Return the header comment of the file."""
        what = f"{self.fitted.top}: {title(self.fitted)} ({self.board.chip}), {clk(self.fitted)}."
        pages = f"Rules:  pins, LEDs, wiring: docs/boards.md; constraints/{self.board.constraints(self.on)}."
        return wrapped("//", what, f"{pages} {self.on.note}", f"Timing: see {self.carrier.name}.")

    def header(self) -> list[str]:
        """Return the module declaration with parameters and ports."""
        chosen = []
        for parameter in self.parameters():
            value = self.board.defaults.get(parameter.name)
            default = parameter.value if value is None else literal(value, parameter.type)
            text = f"  // {parameter.about}" if parameter.about else ""
            chosen.append((f"    parameter {parameter.type} {parameter.name} = {default}", text))
        last = len(chosen) - 1
        lines = [f"{line}{'' if n == last else ','}{text}" for n, (line, text) in enumerate(chosen)]
        start = [f"module {self.fitted.top} #(", *lines, ") ("]
        ports = self.ports()
        ports[-1] = without_comma(ports[-1])
        return [*start, *ports, ");", ""]

    def ports(self) -> list[str]:
        """Return the ports in this order: of the board, of the carrier, LEDs, constant outputs."""
        reset = self.board.reset
        lines = [declaration("in", [self.board.clock["port"]], f"{self.board.clock['mhz']:g} MHz")]
        if reset:
            lines.append(declaration("in", [reset["port"]], f"{reset['active']}: reset"))
        if self.fitted.bits(HOST_RESET):
            lines.append(declaration("in", [HOST_RESET], "0: reset, from the host"))
        group = ""
        for port in self.carrier.ports.values():
            name = next((pin for pin in self.two_way if self.carrier.side(pin) is port), port.name)
            bits = [] if self.own_connection(port)[0] else self.fitted.bits(name)
            if not bits:
                continue
            if port.group != group:
                group = port.group
                lines.append(f"    // {group}")
            way = "out" if port.output else "inout" if name in self.two_way else "in"
            lines.append(declaration(way, bits, port.text))
        return lines + self.board_outputs()

    def board_outputs(self) -> list[str]:
        """Return the ports of LEDs and constant outputs."""
        lines = []
        if self.on.leds:
            lines.append(f"    // LEDs, {self.board.leds['active']} = on")
            for name in dict.fromkeys(led["port"].split("[")[0] for led in self.board.leds["pins"]):
                lines.append(declaration("out", self.fitted.bits(name), ""))
        if self.board.ties:
            lines.append("    // constant")
            lines += [declaration("out", [name], tie["what"]) for name, tie in self.board.ties.items()]
        return lines

    def clock(self) -> list[str]:
        """Return the instance of the PLL, if the board has one."""
        if not self.pll:
            return []
        port = self.board.clock["port"]
        values = {**self.board.clock.get("set", {}), **(self.on.pll or {})}
        params = {name: literal(value) for name, value in values.items()}
        self.wires += ["clk", "lock"]
        return instance(self.pll, params, "u_clock", {f"{port}_i": port, "clk_o": "clk", "lock_o": "lock"})

    def reset_request(self) -> str:
        """Return an expression that is 0 while the button or the host requests a reset."""
        reset = self.board.reset
        lines = [f"{'!' if reset['active'] else ''}{reset['port']}"] if reset else []
        return " && ".join([*lines, *([HOST_RESET] if self.fitted.bits(HOST_RESET) else [])]) or "1'b1"

    def led_block(self) -> list[str]:
        """Return the instance for power-on reset and LEDs."""
        if self.own_leds:
            return []
        leds = {"link_i": "led_link", "moving_i": "led_moving", "switch_i": "led_switch", "leds_o": "leds"}
        self.wires += ["rst_n", *list(leds.values())[:3]]
        lock = "lock" if self.pll else "1'b1"
        start = {"clk_i": self.clk, "lock_i": lock, "req_ni": self.reset_request(), "rst_no": "rst_n"}
        return instance("ppmc_board_leds", {"ClkHz": "ClkHz"}, "u_leds", {**start, **leds})

    def own_connection(self, port: Port) -> tuple[bool, str | None]:
        """Return (True for a port of clock, reset or LEDs; its connection) for a carrier port."""
        if port.name == "clk":
            return True, None if self.clk == "clk" else self.clk
        if self.own_leds and port.name in OWN_LEDS:
            lock = None if self.pll else "1'b1"
            return True, {"lock": lock, "req_n": self.reset_request(), "lamps": "leds"}[port.name]
        return port.name in ("rst_n", "led_link", "led_moving", "led_switch"), None

    def connection(self, port: Port) -> str | None:
        """Return the expression connected to a port of the carrier; None for the signal of the same name."""
        own, known = self.own_connection(port)
        if own:
            return known
        name, _, role = port.name.rpartition("_")
        if name in self.two_way and role in ("i", "o"):
            if not self.fitted.bits(name):
                return "" if port.output else self.idle(port, port.width)
            return name if role == "i" else self.wire(f"part_{name}", port)
        bits = self.fitted.bits(port.name)
        if name in self.two_way and role == "oe" and self.fitted.bits(name):
            if not bits:
                self.wires.append(port.name)
            return None
        if len(bits) == port.width:
            return None
        if not bits:
            return "" if port.output else self.idle(port, port.width)
        if bits != port.bit_names()[: len(bits)]:
            raise ProjectError(
                f"{self.board.source}: parts: {self.on.name}: {port.name}: only high bits may lack a pin"
            )
        if not port.output:
            return f"{{{self.idle(port, port.width - len(bits))}, {port.name}}}"
        whole = self.wire(f"part_{port.name}", port)
        used, rest = port.bit_names()[: len(bits)], port.bit_names()[len(bits) :]
        self.assigns.append(f"  assign {port.name} = {part_select(whole, used)};")
        self.unused.append(part_select(whole, rest))
        return whole

    def wire(self, name: str, port: Port) -> str:
        """Declare a signal with the width of a port and return its name."""
        span = f"[{port.bits[-1]}:{port.bits[0]}] " if port.bits else ""
        self.wires.append(f"{span}{name}")
        return name

    def idle(self, port: Port, width: int) -> str:
        """Return the constant to which an input without a pin is connected."""
        level = "0" if port.name in (self.on.low or {}) else "1"
        return f"'{level}" if width == port.width > 1 else f"{width}'b{level * width}"

    def part(self) -> list[str]:
        """Return the instance of the carrier."""
        names = [name for name in self.carrier.parameters if name not in (self.on.omit or {})]
        params = {name: self.fixed.get(name, "ClkHz" if name == "CLK_HZ" else name) for name in names}
        ports = {port.name: self.connection(port) for port in self.carrier.ports.values()}
        return instance(self.carrier.name, params, "u_carrier", ports)

    def pads(self) -> list[str]:
        """Return the assignments of bidirectional pins, and of ports whose high bits have no pin."""
        lines = []
        for name, drives in self.two_way.items():
            if self.fitted.bits(name):
                level = f"part_{name}" if drives else "1'b0"
                lines.append(f"  assign {name} = {name}_oe ? {level} : 'z;")
        return lines + self.assigns

    def leds(self) -> list[str]:
        """Return the assignments of the LEDs."""
        shown = {led["port"]: SHOWS.index(led["shows"]) for led in self.board.leds["pins"]}
        if not self.on.leds:
            self.unused.append("leds")
            return []
        turned = "" if self.board.leds["active"] else "~"
        lines = []
        for name in dict.fromkeys(port.split("[")[0] for port in shown):
            order = [shown[bit] for bit in self.fitted.bits(name)]
            word = ", ".join(f"leds[{n}]" for n in reversed(order))
            word = "leds" if order == [0, 1, 2, 3] else word if len(order) == 1 else f"{{{word}}}"
            lines.append(f"  assign {name} = {turned}{word};")
        dark = [n for n in range(len(SHOWS)) if n not in shown.values()]
        self.unused += [part_select("leds", [f"[{n}]" for n in dark])] if dark else []
        return lines

    def ties(self) -> list[str]:
        """Return the assignments of the constant outputs, each with its reason."""
        lines = []
        for name, tie in self.board.ties.items():
            lines += ["", f"  // {tie['reason']}", f"  assign {name} = 1'b{tie['level']};"]
        return lines

    def text(self) -> str:
        """Return the whole file, not yet formatted."""
        start = [*head(self.fitted, "//"), *self.comment(), "`default_nettype none", "", *self.header()]
        blocks = [*self.clock(), *self.led_block(), *self.part()]
        ends = [*self.pads(), *self.leds(), *self.ties()]
        if self.unused:
            self.wires.append("unused")
            ends += [*([""] if ends else []), f"  assign unused = ^{{{', '.join(self.unused)}}};"]
        rate = f"{round(self.on.mhz * 1e6):_}"
        signals = [f"  localparam int unsigned ClkHz = {rate};", "", *self.signals(), ""]
        lines = [*start, *signals, *blocks, *ends, "", "endmodule", "", "`default_nettype wire", ""]
        return "\n".join(lines)

    def signals(self) -> list[str]:
        """Return the declarations of the signals between the blocks; one line contains all single bits."""
        single = [wire for wire in self.wires if "[" not in wire]
        wide = ["[3:0] leds", *(wire for wire in self.wires if "[" in wire)]
        lines = [f"  logic {', '.join(single)};"] if single else []
        return lines + [f"  logic {wire};" for wire in wide]


def file(board: Description, fitted: Fitted) -> dict[str, str]:
    """Return the text of the top of a board with a part, by its name below rtl/."""
    return {f"boards/{board.name}/{fitted.top}.sv": Top(fitted).text()}
