"""Tables of docs/bank/README.md: sessions on the golden model, and the cost."""

from __future__ import annotations

from collections.abc import Callable

from openppmc.model.bank.window import CONFIG, DATA, GO, INFO, MAP, MASK, POSITION, STATUS, STOP
from scripts.demo.bank.session import READ_FINISH, Access, Session
from scripts.measure.sizes import figures, size_page

AXES, CLK_HZ = 32, 100_000_000
RAMP = (0x0A, 0x63, 0x13, 0x64, 0x00)  # 5 to 25 kpps within 100 pulses
BITS = ((0x80, "ERR"), (4, "BUSY"), (2, "IBF"), (1, "OBF"))
Lines = list[tuple[str, int]]
"""Explanation, and the number of accesses up to it."""


def meaning(one: Access) -> str:
    """Return the name of a register."""
    names = {DATA: "data", CONFIG: "CONFIG", GO: "GO", STOP: "STOP"}
    if one.register == STATUS:
        return "command" if one.write else "status"
    if one.register in (MASK, MAP, INFO):
        name = {MASK: "MASK", MAP: "interrupt map", INFO: "INFO"}[one.register]
        return f"{name} byte {one.axis}"
    if POSITION <= one.register < POSITION + 4:
        return f"position byte {one.register - POSITION}"
    return names[one.register]


def flags(byte: int) -> str:
    """Return a status as text."""
    found = [name for bit, name in BITS if byte & bit]
    wanted = byte >> 4 & 7
    if wanted and not byte & 0x80:
        found.append(f"{wanted} more bytes expected" if wanted > 1 else "1 more byte expected")
    return ", ".join(found) or "ready"


def rows(accesses: list[Access], notes: Lines) -> list[str]:
    """Return one row for each access; equal polls are combined."""
    found, at = [], 0
    for note, end in notes:
        first = True
        while at < end:
            one, count = accesses[at], 1
            while at + count < end and _same(accesses[at + count], one):
                count += 1
            times = f" × {count}" if count > 1 else ""
            what = f"axis {one.axis}: {meaning(one)}" if one.register < MASK else meaning(one)
            said = f"{one.byte:02X}{times}"
            if one.register == STATUS and not one.write:
                said += f": {flags(one.byte)}"
            way = ("", said) if not one.write else (f"{one.byte:02X}", "")
            address = f"{one.axis << 4 | one.register:03X}"
            found.append(f"| {address} | {what} | {way[0]} | {way[1]} | {note if first else ''} |")
            first, at = False, at + count
    return found


def _same(one: Access, other: Access) -> bool:
    return not one.write and one[1:] == other[1:]


HEAD = ["| a | register | write | read | |", "|---|---|---|---|---|"]


def one_axis() -> str:
    """Return a session with axis 5: INFO, CONFIG, initialisation, a move, its end, its position."""
    host, notes = Session(AXES, CLK_HZ), []

    def note(text: str) -> None:
        notes.append((text, len(host.accesses)))

    for k in range(3):
        host.read(k, INFO)
    note("a bank, version 1 of the window, 32 axes")
    host.write(5, CONFIG, 0b11)
    note("base clock 500 kHz, plain rate formula (the levels after reset)")
    host.send(5, *RAMP)
    note("initialise: 4-phase motor, RL 99, RH 19, PA 100")
    host.send(5, 0x43, 0xE7, 0x03, 0x00)
    note("acceleration/deceleration move CW, 1000 pulses")
    host.t += 100_000
    host.position(5)
    note("1 ms later: current position")
    while host.model.busy(5):
        host.run(host.t + 1000)
    host.poll(5)
    note("later: stopped; `int_n` is L")
    host.read(0, MAP)
    note("bit 5: the motion of axis 5 ended")
    host.answer(5, READ_FINISH)
    note("finish status: a ramped move, complete; `int_n` = H")
    host.position(5)
    note("0x000003E8 = 1000")
    return "\n".join([*HEAD, *rows(host.accesses, notes)])


def group() -> str:
    """Return a session with axes 5 and 6 in a group, and STOP."""
    host = Session(AXES, CLK_HZ)
    for axis in (5, 6):
        host.send(axis, *RAMP)
        host.poll(axis)
    host.t += 20_000
    begin, notes = len(host.accesses), []

    def note(text: str) -> None:
        notes.append((text, len(host.accesses) - begin))

    host.write(0, MASK, 0x60)
    note("group: axes 5 and 6")
    host.send(5, 0x43, 0xE7, 0x03, 0x00)
    note("axis 5: 1000 pulses CW. BUSY = 1, no pulse yet")
    host.send(6, 0x4E)
    note("axis 6: continuous high speed CCW; also held")
    go = host.write(0, GO, 0)
    note("pulse 1 of both axes is at edge g + 4 + R + W")
    host.t += host.model.round + 5
    host.write(0, MASK, 0)
    note("R + 5 cycles later, not before: clear the group")
    host.t += 1_000_000
    stop = host.write(0, STOP, 0)
    note("10 ms later: all axes stop at the next edge")
    host.run(host.t + 1000)
    for axis in (5, 6):
        host.answer(axis, READ_FINISH)
    note("finish status: a stop ended both motions early")
    model = host.model
    assert {model.pulses(axis)[0] for axis in (5, 6)} == {go + 4 + model.round + model.timebase.w}
    assert max(max(model.pulses(axis)) for axis in (5, 6)) <= stop
    return "\n".join([*HEAD, *rows(host.accesses[begin:], notes)])


def cost() -> str:
    """Return size and clock rate over the number of axes."""
    return size_page.bank(figures.read())


TABLES: dict[str, Callable[[], str]] = {"axis-session": one_axis, "group-session": group, "cost": cost}
