"""Sessions of the PPMC-312's serial line for the playground: moves of stations, faults, a missing station."""

from __future__ import annotations

TABLE = "00 00 0140 00A0 000360"
"""8 MHz, linear, rates 320 to 160 (25 to 50 kpps), 864 pulses."""


def _start(station: int, pulses: int) -> str:
    code = 0x83 if pulses > 0 else 0xA3
    return f"axis {station}; > {TABLE}; < 90\n> {code:02X} 0000 {abs(pulses):08X}; < 90"


def _end(station: int, pulses: int) -> str:
    return f"axis {station}; idle; > 42; < A0 {pulses & 0xFFFFFFFF:08X}; count {abs(pulses)}"


PULSES = {station: (2080 - 112 * station) * (-1 if station & 1 else 1) for station in range(16)}
"""A station that starts later makes fewer pulses; odd stations move CCW."""
SESSIONS = {
    "Which stations reply": """
axis 0; ? 90       # poll: ready
axis 1; ? 90
axis 15; ? 90
> 41               # version
< A0 12
> 4D               # operation, condition, buffers
< A0 00 01 00
""",
    "Two stations move": f"""
axis 3
? 90               # ready
> {TABLE}
< 90
> 83 0000 000005DC # 1500 pulses CW, high speed
< 90
axis 5             # station 3 is moving
> {TABLE}
< 90
> A3 0000 000003E8 # 1000 pulses CCW, high speed
< 90
axis 3; idle       # poll until it is not busy
axis 5; idle
axis 3; > 42; < A0 000005DC   # the positions
axis 5; > 42; < A0 FFFFFC18
""",
    "Sixteen stations move": "\n".join(
        [
            *(_start(station, pulses) for station, pulses in PULSES.items()),
            *(_end(station, pulses) for station, pulses in PULSES.items()),
        ]
    ),
    "A wrong check byte": f"""
axis 2
> {TABLE}
< 90
m 92 38 32 00      # single pulse CW, but the checksum is 6B
s B2 34 31 0C      # error 41: nothing is executed
> 4F               # framing errors, overruns, checksum errors
< A0 00 00 01
m 92 38 32 6B
< 90               # executed
wait 2ms
count 1
""",
    "A station that does not reply": """
unplug 7           # its wire is out
axis 7
? -                # no reply within 25 ms
axis 6
? 90               # the others reply
plug 7
axis 7
? 90
> 47               # no such code in serial mode
< B0 47            # after 20 ms of silence
""",
    "Two stations start together": f"""
axis 3
> {TABLE}
< 90
axis 5
> {TABLE}
< 90
set run=0          # RUN of all stations holds the starts
axis 3
> 83 0000 000005DC
< 90
axis 5
> A3 0000 000003E8
< 90
set run=65535      # both start in the same cycle
axis 3
? B0 23            # RUN: the held move has started
axis 5
? B0 23
axis 3; idle; count 1500
axis 5; idle; count 1000
""",
    "A limit switch stops a station": f"""
axis 9
> {TABLE}
< 90
> 86 0000          # run on at high speed, CW
< 90
pulse 900
set fl_n[9]=0      # the limit switch of station 9
wait 1ms
? A0 33            # END code: limit
> 82               # single pulse CW
< B0 44            # rejected: the limit ahead is active
> A2               # single pulse CCW
< 90
wait 2ms
? A0 38            # END code: all pulses made
set fl_n[9]=1
> 42
<                  # the position
""",
}
