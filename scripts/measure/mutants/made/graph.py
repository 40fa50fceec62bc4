"""Sequential and-inverter graphs in the AIGER format (FMV report 07/1).

A literal is an even number for a signal and the next odd number for its inverse; 0 is false, 1 is true.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Graph:
    """Inputs, registers that begin at 0, and gates with two inputs.

    Attributes:
        size: number of signals.
        registers: literal of the output and of the input of each register.
        gates: literal of the output -> literals of both inputs; a gate follows those of its inputs.
    """

    size: int = 0
    inputs: list[int] = field(default_factory=list)
    registers: list[tuple[int, int]] = field(default_factory=list)
    gates: dict[int, tuple[int, int]] = field(default_factory=dict)
    _known: dict[tuple[int, int], int] = field(default_factory=dict)

    def new(self) -> int:
        """Return the literal of a new signal."""
        self.size += 1
        return 2 * self.size

    def input(self) -> int:
        """Return the literal of a new input."""
        self.inputs.append(self.new())
        return self.inputs[-1]

    def both(self, a: int, b: int) -> int:
        """Return the literal of a && b; an existing gate is used again."""
        if a > b:
            a, b = b, a
        if a == 0 or a == b ^ 1:
            return 0
        if a in (1, b):
            return b
        if (a, b) not in self._known:
            self._known[a, b] = self.new()
            self.gates[self._known[a, b]] = a, b
        return self._known[a, b]

    def either(self, a: int, b: int) -> int:
        """Return the literal of a || b."""
        return self.both(a ^ 1, b ^ 1) ^ 1

    def differ(self, a: int, b: int) -> int:
        """Return the literal of a != b."""
        return self.either(self.both(a, b ^ 1), self.both(a ^ 1, b))

    def chosen(self, first: int, a: int, b: int) -> int:
        """Return the literal of first ? a : b."""
        return self.either(self.both(first, a), self.both(first ^ 1, b))

    def any(self, literals: Iterable[int]) -> int:
        """Return the literal of the disjunction."""
        found = 0
        for one in literals:
            found = self.either(found, one)
        return found

    def copy(self, other: Graph, leaves: Mapping[int, int]) -> Callable[[int], int]:
        """Add the gates of another graph; return the function from its literals to those of this graph.

        Args:
            leaves: literal of each input and register output of the other graph -> literal of this graph.
        """
        here = [0] * (other.size + 1)
        for there, literal in leaves.items():
            here[there >> 1] = literal
        for out, (a, b) in other.gates.items():
            here[out >> 1] = self.both(here[a >> 1] ^ (a & 1), here[b >> 1] ^ (b & 1))
        return lambda literal: here[literal >> 1] ^ (literal & 1)

    def write(self, path: Path, outputs: Sequence[int]) -> None:
        """Write the outputs, and all that determines them, as a binary file."""
        registers, needed, todo = dict(self.registers), {0}, [output & ~1 for output in outputs]
        while todo:
            one = todo.pop()
            if one not in needed:
                needed.add(one)
                fanins = self.gates.get(one, (registers[one],) if one in registers else ())
                todo += [literal & ~1 for literal in fanins]
        inputs = [one for one in self.inputs if one in needed]
        stored = [one for one in registers if one in needed]
        inner = [out for out in self.gates if out in needed]
        number = {one: 2 * place for place, one in enumerate((0, *inputs, *stored, *inner))}

        def told(literal: int) -> int:
            return number[literal & ~1] | literal & 1

        sizes = len(number) - 1, len(inputs), len(stored), len(outputs), len(inner)
        head = f"aig {' '.join(map(str, sizes))}\n"
        ends = "".join(f"{told(one)}\n" for one in (*(registers[out] for out in stored), *outputs))
        data = bytearray((head + ends).encode())
        for out in inner:
            high, low = sorted(map(told, self.gates[out]), reverse=True)
            for delta in (number[out] - high, high - low):
                more = max(delta.bit_length() - 1, 0) // 7
                data += bytes(delta >> 7 * n & 127 | 128 for n in range(more)) + bytes([delta >> 7 * more])
        path.write_bytes(data)


def read(path: Path) -> tuple[Graph, dict[str, int], dict[str, int], list[list[str]]]:
    """Read a text file; return the graph, inputs and outputs by name, and all names of each register."""
    lines = iter(path.read_text(encoding="utf-8").splitlines())
    size, inputs, registers, outputs, gates = map(int, next(lines).split()[1:6])
    graph = Graph(size, [int(next(lines)) for _ in range(inputs)])
    for _ in range(registers):
        out, enter = map(int, next(lines).split()[:2])
        graph.registers.append((out, enter))
    ends = [int(next(lines)) for _ in range(outputs)]
    for _ in range(gates):
        out, a, b = map(int, next(lines).split())
        graph.gates[out] = a, b
    names: dict[str, dict[int, str]] = {"i": {}, "l": {}, "o": {}}
    for line in lines:
        if symbol := re.fullmatch(r"([ilo])(\d+) (.+)", line):
            names[symbol[1]][int(symbol[2])] = symbol[3]
    inputs_of = {text: graph.inputs[place] for place, text in names["i"].items()}
    outputs_of = {text: ends[place] for place, text in names["o"].items()}
    return graph, inputs_of, outputs_of, [names["l"].get(place, "").split() for place in range(registers)]
