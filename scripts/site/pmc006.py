"""Sessions of the PMC006B4 for the playground: a move, an emergency input, and the demo's program."""

from __future__ import annotations

from cocotb_tests.pmc006.demo_program import FINE, PROGRAM, START
from openppmc.model.pmc006.program import assemble

_WORDS = "\n".join(f"f W 0x{word:08X}" for word in assemble(PROGRAM).words[: 2 * PROGRAM.count("\n")])
_SET = """
f j                # status 1
f e 1500           # current, mA
f m 16             # microsteps
f u 4              # coefficients of acceleration and deceleration
f o 4
f L 1200           # start and stop speed, steps a second
f S 1200
f v 4800           # the highest speed
"""
SESSIONS = {
    "A move in microsteps": f"{_SET}\nf s 1024\nidle\nf c = 1024       # the position",
    "Stopped by an emergency input": f"""
{_SET}
f f 3              # both inputs are active
f s 100000
pulse 200
set ext1=0
wait 1ms
f j                # stopped by EXT1
f c
""",
    "A program without a host": f"""
f e 1500
f A 0
{_WORDS}
f A 0
f L {START * FINE}
f S {START * FINE}
f z                # it searches the switch at EXT1, then moves to and fro
pulse 160
set ext1=0
wait 3ms
set ext1=1
pulse 1200
""",
}
