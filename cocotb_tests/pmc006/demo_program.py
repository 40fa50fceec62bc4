"""Program of `make demo PART=pmc006`: a host, and a motor on the bridges of the part.

The host makes three moves of the same distance, each with finer steps than the previous one. Then it loads a
program, which homes to a switch and moves to and fro without a host. The motor is connected only during the
moves, because its comparators change often.
"""

from __future__ import annotations

from cocotb_tests.harness import Config
from cocotb_tests.harness.sessions import DemoLog
from cocotb_tests.pmc006.stepping import MotorHost
from openppmc.model.pmc006.bench.motor import Motor
from openppmc.model.pmc006.program import assemble

BUILD = Config("demo8m", clk_hz=8_000_000, extra=(("BAUD", 115_200), ("T_OFF_NS", 40_000)))
MOTOR = Motor(ohm=1.0, henry=4e-3, volt=24.0)
CURRENT = 1500
"""Motor current in mA."""
WAY = 64
"""Number of full steps of a move."""
SPEED, START, LEAD = 300, 75, 20
"""Speeds in full steps per second (maximum; start and end); full steps from the start back to the switch."""
MOVES = ((4, 2), (16, 4), (32, 5))
"""Microsteps per full step, and the acceleration coefficient that results in 1700 full steps/s^2 with them.
"""
FINE = 8
"""Microsteps per full step in the program."""
LONG = 2_000_000
"""Longest wait in microseconds."""
PROGRAM = f"""\
        MIC   {FINE}
        ACC   5
        VSET  fixed, {500 * FINE}
        EXTEN on
        DIR   backward
        ROT   100000
        WAIT  busy, low        ; the switch has stopped it
        CLR1
        DIR   forward
        ROT   {40 * FINE}
        WAIT  busy, low
        OUT   gpo1, on           ; homed
again:  ROT   {50 * FINE}
        WAIT  busy, low
        OUT   gpo2, on
        DIR   backward
        ROT   {50 * FINE}
        WAIT  busy, low
        OUT   gpo2, off
        DIR   forward
        CNTI
        CMP   counter, 2
        JNE   again
        OUT   gpo1, off
        END
"""


async def run_program(host: MotorHost, demo_log: DemoLog) -> None:
    """Run the complete program on a part that has just booted."""
    host.attach(MOTOR)
    with demo_log.chapter("set", "settings"):
        await host.ask("j")
        await host.ok(e=CURRENT, f=1)
        await host.ms(5)
    for number, (fine, coefficient) in enumerate(MOVES):
        with demo_log.chapter(f"move{fine}", f"{WAY} full steps in {fine} microsteps each"):
            await move(host, fine, coefficient, forward=number != 1)
    with demo_log.chapter("load", "load a program"):
        await host.ok(A=0)
        for word in assemble(PROGRAM).words[: 2 * PROGRAM.count("\n")]:
            await host.ask("W", word)
        await host.ok(A=0, L=START * FINE, S=START * FINE)
    host.detach()
    await host.pins(cmp_a=0, cmp_b=0)
    with demo_log.chapter("program", "home and shuttle without a host"):
        await host.ask("z")
        await homing(host)
        await host.until("gpo[0]", 0, LONG)
        await host.ms(4)


async def move(host: MotorHost, fine: int, coefficient: int, forward: bool) -> None:
    """Make a move with this number of microsteps and poll until its end."""
    await host.ok(
        m=fine,
        v=SPEED * fine,
        L=START * fine,
        S=START * fine,
        u=coefficient,
        o=coefficient,
        d=int(forward),
    )
    await host.ask("s", WAY * fine)
    while await host.ask("j") & 1:
        await host.ms(20)
    await host.ask("c")


async def homing(host: MotorHost) -> None:
    """Close the switch while the motor is beyond the switch position, until the program has set GPO1."""
    bench, steps = host.bench, host.steps()
    place = (len(MOVES) % 2) * WAY * FINE
    while not bench.level("gpo[0]"):
        place += sum(1 if bench.level_at("mon_dir", t) else -1 for t in steps)
        await host.pins(ext1=int(place > -LEAD * FINE))
        steps = await host.next_steps(host.t + host.us(LONG))
