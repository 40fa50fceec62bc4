"""Rules for the RTL modules: each violation of a rule is reported."""

from __future__ import annotations

import pytest

from scripts.measure.module_rules import (
    MOST_LINES,
    MOST_PORTS,
    all_findings,
    findings,
    inner_modules,
    name_findings,
    type_findings,
)

HEAD = "// x\nmodule x (\n    input  wire logic clk_i,\n"


def module(ports: int, comment: str = "  // level", lines: int = 0) -> str:
    """Return a module with clk_i, `ports` other ports, and `lines` lines after the ports."""
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


@pytest.mark.parametrize(
    ("good", "bad", "net"),
    [
        (".rst_ni(rst_core_n)", ".rst_ni(rst_core)", "rst_core"),
        (".rst_no(part_rst_no)", ".rst_no (rst)", "rst"),
        (".rst_n   (rst_both_n),", ".rst_n   (rst_both),", "rst_both"),
        ("always_ff @(posedge clk or negedge rst_n)", "always_ff @(posedge clk or negedge reset)", "reset"),
    ],
)
def test_an_active_low_reset(good: str, bad: str, net: str) -> None:
    """A net with an active-low reset must end in _n; the lock of a PLL is exempt, although it also resets."""
    assert name_findings("x.sv", good) == name_findings("x.sv", ".rst_ni(lock_i)") == []
    assert name_findings("x.sv", f"{bad} // {good}") == [
        f"x.sv: {net}: the name of an active-low reset must end in _n"
    ]


def test_a_number_of_cycles() -> None:
    """A parameter or constant that counts cycles must end in Cycles."""
    text = "    parameter int unsigned EdgeClk = 2,\n  localparam int WaitCycles = EdgeClk;\n"
    assert name_findings("x.sv", text) == ["x.sv: EdgeClk: use the suffix Cycles, not Clk"]
    assert name_findings("x.sv", "  localparam int unsigned StepClk = ClkHz / 1000;\n") == [
        "x.sv: StepClk: use the suffix Cycles, not Clk"
    ]
    assert name_findings("x.sv", "  localparam int unsigned ClkHz = 1;  // not EdgeClk = 1\n") == []


@pytest.mark.parametrize("comment", ["it", "the same", "This one.", "what", "when", "where", "and its level"])
def test_a_port_comment_without_a_noun(comment: str) -> None:
    """The comment of a port must contain a noun and must not continue the comment of the line above."""
    assert name_findings("x.sv", f"    input  wire logic [7:0] d_i,  // {comment}\n") == [
        f"x.sv: d_i: comment without a noun: {comment}"
    ]
    assert name_findings("x.sv", f"    input  wire logic [7:0] d_i,  // level, {comment}\n") == []
    assert name_findings("x.sv", f"  // {comment}\n") == []


def test_a_type_of_two_packages() -> None:
    """A type name may occur in only one package; the two packages with parallel names are exempt."""
    enum = "  typedef enum logic {\n    A,\n    B\n  } kind_e;\n"
    struct = "  typedef struct packed {logic a, b;} pair_t;\n  typedef logic [3:0] word_t;\n"
    packages = {
        name: f"package {name};\n{body}endpackage\n"
        for name, body in (("a_pkg", enum + struct), ("b_pkg", enum), ("c_pkg", struct), ("d_pkg", ""))
    }
    assert type_findings(packages.values()) == [
        "kind_e: defined in a_pkg and b_pkg; use two names",
        "pair_t: defined in a_pkg and c_pkg; use two names",
        "word_t: defined in a_pkg and c_pkg; use two names",
    ]
    parallel = [f"package {name};\n{enum}endpackage\n" for name in ("ppmc2104_pkg", "ppmc_code_pkg")]
    assert type_findings(parallel) == []
    assert type_findings([*parallel, packages["b_pkg"]]) == [
        "kind_e: defined in b_pkg and ppmc2104_pkg and ppmc_code_pkg; use two names"
    ]


def test_the_tree() -> None:
    assert len(inner_modules()) > 100
    assert all_findings() == ""
