"""Rules for inner modules of the RTL: a module that breaks a rule is found."""

from __future__ import annotations

from scripts.measure.module_rules import MOST_LINES, MOST_PORTS, all_findings, findings, inner_modules

HEAD = "// x\nmodule x (\n    input  wire logic clk_i,\n"


def module(ports: int, comment: str = "  // level", lines: int = 0) -> str:
    """Return a module with clk_i, `ports` more ports, and `lines` lines after them."""
    text = "".join(f"    output logic p{n}_o,{comment}\n" for n in range(ports))
    return HEAD + text + "\n);\n" + "//\n" * lines + "endmodule\n"


def test_ports_at_the_limit() -> None:
    assert findings("x.sv", module(MOST_PORTS - 1)) == []
    assert findings("x.sv", module(MOST_PORTS)) == [
        f"x.sv: {MOST_PORTS + 1} ports, at most {MOST_PORTS}: combine related ports in a struct"
    ]


def test_lines_at_the_limit() -> None:
    rest = MOST_LINES - module(1).count("\n")
    assert findings("x.sv", module(1, lines=rest)) == []
    assert findings("x.sv", module(1, lines=rest + 1)) == [
        f"x.sv: {MOST_LINES + 1} lines, at most {MOST_LINES}"
    ]


def test_a_port_without_its_meaning() -> None:
    assert findings("x.sv", module(2, comment="")) == [
        "x.sv: logic p0_o: comment is missing",
        "x.sv: logic p1_o: comment is missing",
    ]


def test_the_tree() -> None:
    assert len(inner_modules()) > 100
    assert all_findings() == ""
