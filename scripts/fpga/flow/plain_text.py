"""Make the output of yosys' `write_verilog` readable; the logic does not change.

The result has plain names, the comments of the sources, ports in the module header, and expressions in place
of numbered wires. Equal modules occur only once. Input and output are texts.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Mapping
from dataclasses import dataclass, field

WIDTH = 110  # maximum length of a line, and of an expression that results from the replacement of wires
_MODULE = re.compile(r"^module (\\\S+|\w+) ?\((.*?)\);\n(.*?)^endmodule$", re.S | re.M)
_DECLARED = re.compile(
    r"^  (?P<kind>input|output|inout|wire|reg)(?P<range> \[\d+:\d+\])? (?P<name>\w+)(?P<rest>.*);$"
)
_ESCAPED = re.compile(r"\\(\S+) ")
_NUMBERED = re.compile(r"\b_\d+_\b")
_ASSIGN = re.compile(r"^  assign (_\d+_) = (.*);$")
_BIT = re.compile(r"^  assign (_\d+_)\[(\d+)\] = (.*);$")
_CLEAR = re.compile(r"^    (\w+)\[\d+\] = ([^;]*);$")
_INDEX = re.compile(r"\[\$signed\(\{ \d+'h0+, ([^{}]*) \}\) \+: ")  # an index that is never negative
_ATOM = r"(?:\w+(?:\[[^\]]*\])?|\d+'h[0-9a-f]+)"
_OPERAND = rf"(?:{_ATOM}|\{{[^{{}}]*\}}|\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\))"
# Expressions whose value does not depend on the width of their context: operators with a one-bit result whose
# operands have a fixed width, and conditionals whose branches both have the width of the result.
_ANYWHERE = re.compile(
    rf"(?:! |~\| |[|&^] ){_OPERAND}|{_OPERAND} (?:&&|\|\||==|!=|<|<=|>|>=) {_OPERAND}"
    rf"|{_OPERAND} \? {_OPERAND} : {_OPERAND}"
)


@dataclass
class Module:
    """One module: name in yosys, ports in order, declarations (lines without `;`), other lines."""

    name: str
    ports: list[str]
    declared: dict[str, re.Match[str]] = field(default_factory=dict)
    register: set[str] = field(default_factory=set)
    lines: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Source:
    """Comments of a module's source: the header, and the comments after ports and signals."""

    head: tuple[str, ...]
    comments: Mapping[str, str]


def source(text: str) -> Source:
    """Return the comments of a SystemVerilog file of this project."""
    lines = text.splitlines()
    head = []
    for line in lines[1:]:
        if not line.startswith("//"):
            break
        head.append(line)
    comments: dict[str, str] = {}
    for line in lines:
        if match := re.match(
            r"^ +(?:input|output|inout|logic|\w+_t)\b[^=/]*?(\w+) *[,;]? *// *(\S.*)$", line
        ):
            comments.setdefault(match[1], match[2])
    return Source(tuple(head), comments)


def _plain_names(text: str) -> str:
    """Replace escaped names of signals: `\\a.b[3] ` becomes a_b_3, with another _ if that name is in use."""
    taken = set(re.findall(r"\b\w+\b", _ESCAPED.sub(" ", text)))
    names: dict[str, str] = {}

    def plain(match: re.Match[str]) -> str:
        if match[1] not in names:
            name = re.sub(r"\W+", "_", match[1]).strip("_")
            while name in taken:
                name += "_"
            taken.add(name)
            names[match[1]] = name
        return names[match[1]]

    return _ESCAPED.sub(plain, text)


def _parse(name: str, ports: str, body: str) -> Module:
    module = Module(name, [port.strip() for port in ports.replace("\n", "").split(",")])
    for line in body.splitlines():
        match = _DECLARED.match(line)
        if not match:
            module.lines.append(line)
            continue
        if match["kind"] == "reg":
            module.register.add(match["name"])
        if match["name"] not in module.declared or match["kind"] not in ("wire", "reg"):
            module.declared[match["name"]] = match
    return module


def _gather_bits(module: Module) -> None:
    """Replace the assignments of single bits of a numbered wire by one assignment of all bits."""
    bits: dict[str, dict[int, int]] = {}
    for number, line in enumerate(module.lines):
        if match := _BIT.match(line):
            bits.setdefault(match[1], {})[int(match[2])] = number
    for name, at in bits.items():
        high = re.match(r" \[(\d+):0\]$", module.declared[name]["range"] or "")
        values = [_BIT.match(module.lines[at[bit]])[3] for bit in sorted(at, reverse=True)]  # type: ignore[index]
        if high and len(at) == int(high[1]) + 1 and all(map(_one_bit, values)):
            for number in at.values():
                module.lines[number] = ""
            module.lines[min(at.values())] = f"  assign {name} = {{ {', '.join(values)} }};"
    module.lines = [line for line in module.lines if line]


def _one_bit(value: str) -> bool:
    return bool(
        re.fullmatch(
            rf"(?:!|~?\||[&^]) {_OPERAND}|{_OPERAND} (?:&&|\|\||==|!=|<|<=|>|>=) {_OPERAND}",
            value,
        )
        or re.fullmatch(r"1'h[01]|\w+\[\d+\]", value)
    )


def _inline(module: Module) -> None:
    """Replace each numbered wire that is used once with its expression if this does not change the value."""
    made, uses = {}, dict[str, list[int]]()
    for number, line in enumerate(module.lines):
        if match := _ASSIGN.match(line):
            made[match[1]] = number
        for name in _NUMBERED.findall(line):
            uses.setdefault(name, []).append(number)
    where = {name: [n for n in at if n != made.get(name)] for name, at in uses.items()}
    changed = True
    while changed:
        changed = False
        for name, number in list(made.items()):
            if len(where[name]) != 1:
                continue
            user, line = where[name][0], module.lines[number]
            value = _ASSIGN.match(line)[2]  # type: ignore[index]
            target = module.lines[user]
            if not _ANYWHERE.fullmatch(value) and not re.fullmatch(_ATOM, value):
                continue
            if len(target) + len(value) > WIDTH or re.search(rf"\b{name}\[|{name}\[[^=]* = ", target):
                continue
            if re.match(r"^ *(?:assign )?[^=]*\b" + name + r"\b[^=]*<?= ", target) and not re.match(
                r"^ *(?:if|else|else if) ", target
            ):
                continue  # the wire is on the left side of an assignment
            whole = re.search(rf"(?: = |<= |\(){name}[;)]", target) or re.fullmatch(_ATOM, value)
            module.lines[user] = re.sub(rf"\b{name}\b", lambda _: value if whole else f"({value})", target)  # noqa: B023
            module.lines[number] = ""
            del made[name], module.declared[name]
            for other in _NUMBERED.findall(value):
                where[other] = [user if n == number else n for n in where[other]]
            changed = True
    module.lines = [line for line in module.lines if line]


def _wide_not(module: Module) -> None:
    """Replace `!` by `~|` before an operand of more than one bit."""

    def nor(match: re.Match[str]) -> str:
        found = module.declared.get(match[1])
        wide = found is not None and bool(found["range"]) and not match[2]
        return f"~| {match[0][2:]}" if not match[1] or wide or ":" in (match[2] or "") else match[0]

    module.lines = [re.sub(r"! (?:\{|(\w+)\b(\[[^\]]*\])?)", nor, line) for line in module.lines]


def _pickers(module: Module) -> None:
    """Give names to the functions that represent a `case`, and to their arguments."""
    inside = False
    for number, line in enumerate(module.lines):
        inside = inside or line.startswith("  function ")
        if inside:
            for old, new in (("a", "others"), ("b", "values"), ("s", "which")):
                line = re.sub(rf"(?<!')\b{old}\b", new, line)
            module.lines[number] = line.replace(" // synopsys parallel_case", "")
        inside = inside and line != "  endfunction"
    functions = {match[1] for line in module.lines if (match := re.match(r"  function .*?(_\d+_);$", line))}
    for number, line in enumerate(module.lines):
        module.lines[number] = _NUMBERED.sub(
            lambda match: f"pick{match[0][:-1]}" if match[0] in functions else match[0], line
        )


def _one_clear(module: Module) -> None:
    """Replace lines that set every word of a memory to the same value by a loop."""
    lines, at = [], 0
    while at < len(module.lines):
        match = _CLEAR.match(module.lines[at])
        end = at
        while match and (row := _CLEAR.match(module.lines[end])) and row.groups() == match.groups():
            end += 1
        if match and end - at > 4 and module.lines[at - 1] == "  initial begin":
            lines.append(f"    for (i = 0; i < {end - at}; i = i + 1) {match[1]}[i] = {match[2]};")
            lines.insert(0, "  integer i;")
        else:
            end = max(end, at + 1)
            lines += module.lines[at:end]
        at = end
    first = [line for line in lines if line == "  integer i;"][:1]
    module.lines = first + [line for line in lines if line != "  integer i;"]


def _written(module: Module, said: Source, name: str) -> str:
    """Return the Verilog text of a module with its new name."""

    def declared(signal: str, kind: str, indent: str) -> str:
        match = module.declared[signal]
        return f"{indent}{kind}{match['range'] or ''} {signal}{match['rest']}"

    def with_comment(line: str, signal: str) -> str:
        comment = said.comments.get(signal.rstrip("_"))
        return f"{line}  // {comment}" if comment else line

    lines = [*said.head, f"module {name} ("]
    for number, port in enumerate(module.ports):
        match = module.declared[port]
        kind = f"{match['kind']:<6} {'reg' if port in module.register else 'wire'}"
        end = "," if number + 1 < len(module.ports) else ""
        lines.append(with_comment(declared(port, kind, "    ") + end, port))
    lines += [");", ""]
    inner = [signal for signal in module.declared if signal not in module.ports]
    for signal in sorted(inner, key=lambda one: (bool(_NUMBERED.fullmatch(one)), one in module.register)):
        kind = "reg" if signal in module.register else "wire"
        lines.append(with_comment(declared(signal, kind, "  ") + ";", signal))
    lines.append("")
    for line in module.lines:
        indent = " " * (len(line) - len(line.lstrip()) + 4)
        if len(line) > WIDTH and "//" not in line:
            lines += textwrap.wrap(
                line, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
            )
        else:
            lines.append(line)
    return "\n".join([*lines, "endmodule", ""])


def _children(text: str, names: Mapping[str, str]) -> str:
    return re.sub(r"^  (\\\S+|\w+) +(?=\S+ +\($)", lambda m: f"  {names.get(m[1], m[1])} ", text, flags=re.M)


def readable(text: str, top: str, sources: Mapping[str, str]) -> str:
    """Return the modules of yosys' file, with the top first.

    The names of other modules get the top's name as a prefix, so that the files of two parts share no name.

    Args:
        sources: SystemVerilog of each module, by its name; the comments are copied from it.
    """
    raw = {match[1]: match for match in _MODULE.finditer(text)}
    used = {
        name: {word for word in re.findall(r"^  (\\\S+|\w+) +\S+ +\($", match[3], re.M) if word in raw}
        for name, match in raw.items()
    }
    names: dict[str, str] = {}
    taken: dict[str, str] = {}
    written: dict[str, str] = {}
    while len(names) < len(raw):
        for yosys in sorted(name for name in raw if name not in names and used[name] <= names.keys()):
            base = yosys.lstrip("\\").split("$")[0]
            match = raw[yosys]
            body = _plain_names(_children(match[3], names))
            module = _parse(base, _plain_names(match[2]), body)
            module.lines = [_INDEX.sub(r"[{ \1 } +: ", line) for line in module.lines]
            _gather_bits(module)
            _wide_not(module)
            _inline(module)
            _pickers(module)
            _one_clear(module)
            said = source(sources[base]) if base in sources else Source((), {})
            whole = _written(module, said, "@")
            if whole not in taken:
                own = base if base == top or base.startswith(f"{top}_") else f"{top}_{base}"
                same = sum(1 for name in taken.values() if re.fullmatch(rf"{own}(_v\d+)?", name))
                taken[whole] = f"{own}_v{same + 1}" if same else own
                written[taken[whole]] = whole.replace("module @ (", f"module {taken[whole]} (", 1)
            names[yosys] = taken[whole]
    return "\n".join([written.pop(top), *(written[name] for name in sorted(written))])
