"""Operator of a headless LinuxCNC: it switches the machine on, homes it, and executes MDI lines.

    python3 mdi.py LINE...

LinuxCNC starts it in place of a graphical interface, so it uses LinuxCNC's Python and its module `linuxcnc`.
After each line it prints the line, the angle of the indexer, and the digital inputs of M66.
"""

from __future__ import annotations

import sys
import time

import hal
import linuxcnc

component = hal.component("operator")  # only a component can read a pin
component.ready()
command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()


def until(condition: str) -> None:
    """Wait until an expression with `status` is true, at most 20 s."""
    end = time.monotonic() + 20
    while time.monotonic() < end:
        status.poll()
        if eval(condition):
            return
        time.sleep(0.05)
    sys.exit(f"not after 20 s: {condition}")


command.state(linuxcnc.STATE_ESTOP_RESET)
until("status.task_state == linuxcnc.STATE_ESTOP_RESET")
command.state(linuxcnc.STATE_ON)
until("status.task_state == linuxcnc.STATE_ON")
command.home(-1)
until("all(status.homed[:3])")
command.mode(linuxcnc.MODE_MDI)
command.wait_complete()
for line in sys.argv[1:]:
    command.mdi(line)
    command.wait_complete(60)
    until("status.interp_state == linuxcnc.INTERP_IDLE")
    angle = hal.get_value("indexer.1.position-fb")
    print(f"{line}: angle {angle:g}, inputs {status.din[:3]}, X {status.position[0]:g}", flush=True)
    if error := errors.poll():
        print(f"message: {error[1]}", flush=True)
