"""Contracts of ppmc_command, ppmc_setup, ppmc_finish_status and ppmc_proc_time (parts with one axis)."""

from __future__ import annotations

from math import ceil

import cocotb

from ..harness import Block, BlockDriver, rng, same

KINDS = "undefined init halt decel operation read switching aux_out exc_off aux_on aux_off".split()
ACTIONS = "init start halt decel exc_off aux_on aux_off aux_out switching read".split()
HARMLESS = ("aux_out", "exc_off", "aux_on", "aux_off")
STOPS = ("halt", "decel")
# A row contains the code byte, its kind, and the number of bytes that follow.
CODES = [
    (0x1A, "init", 4),
    (0x08, "undefined", 0),
    (0x40, "halt", 0),
    (0x41, "decel", 0),
    (0x42, "operation", 0),
    (0x43, "operation", 3),
    (0x44, "operation", 4),
    (0x47, "operation", 1),
    (0x80, "read", 0),
    (0x84, "switching", 2),
    (0x86, "aux_out", 1),
    (0xC0, "exc_off", 0),
    (0xC1, "aux_on", 0),
    (0xC2, "aux_off", 0),
    (0xFF, "undefined", 0),
]
PROC_TIME_PORTS = (
    "act_i:10:ppmc_code_pkg::action_t code_i:8 params_i:32 code_held_i:8 params_held_i:32 base_i:3 open_o"
    " act_o:10 code_o:8 params_o:32 base_o:3 initialised_i building_i steps_i:{steps} phase_init_o ready_o"
    " ramp_i single_i stop_i pulse_i last_i final_i go_o end_delay_o"
)
# Name -> clock, crystal, number of bits of PA, minimum and maximum of PA, whether forced decelerations and
# triangular profiles have DATASHEET times.
VARIANTS = {
    "sister": (16_000_000, 16_000_000, 14, 4, 11_220, 1),
    "plain": (11_059_200, 16_000_000, 16, 0, 65_535, 0),
    "quick": (8_000_000, 20_000_000, 16, 0, 65_535, 0),
}
BLOCKS = {
    "command": Block(
        "ppmc_command",
        "ready_i command_i byte_i:8 open_i stops_only_i take_o decoded_i:7:ppmc_code_pkg::decoded_t data_i:8"
        " param_error_i:3:ppmc_code_pkg::cmd_error_e is_checked_i busy_i ramp_i decelerating_i initialised_i"
        " status_o:4 act_o:10 code_o:8 params_o:32 code_held_o:8 params_held_o:32",
    ),
    **{
        f"setup{idle}": Block(
            "ppmc_setup",
            "init_i code_i:8:ppmc_code_pkg::init_code_t phase_init_i positive_i ready_i off_i setup_o:6"
            " initialised_o",
            {"PhaseIdle": idle},
        )
        for idle in (0, 1)
    },
    **{
        f"finish{unread_flag}": Block(
            "ppmc_finish_status",
            "start_i op_code_i:8:ppmc_code_pkg::op_code_t done_i cause_i:4 read_i select_i:3 remaining_i:24"
            " inputs_i:8 outputs_i:8 auxi_i:4 answer_o:24 int_no",
            {"UnreadFlag": unread_flag},
        )
        for unread_flag in (0, 1)
    },
    "fast": Block("ppmc_proc_time", PROC_TIME_PORTS.format(steps=14)),
    **{
        f"proc_time_{name}": Block(
            "ppmc_proc_time",
            PROC_TIME_PORTS.format(steps=bits),
            {
                "Datasheet": 1,
                "ClkHz": clk,
                "XtalHz": xtal,
                "StepBits": bits,
                "StepsMin": low,
                "StepsMax": high,
                "RampTimes": timed,
            },
        )
        for name, (clk, xtal, bits, low, high, timed) in VARIANTS.items()
    },
}


def action(*names: str) -> int:
    """Return a packed action_t with these bits set."""
    return sum(1 << len(ACTIONS) - 1 - ACTIONS.index(name) for name in names)


def judge_code(kind: str, params: int, state: dict[str, int]) -> tuple[int | None, int]:
    """Return (error number or None, action) for a code, according to P104-ERR-01 and the J105 STMC."""
    stop, busy = kind in STOPS, state["busy_i"]
    if kind == "undefined" or (stop and not busy):
        return 0, 0
    if busy and not stop and kind not in HARMLESS:
        return 1, 0
    if kind == "operation" and not state["initialised_i"]:
        return 2, 0
    if kind == "decel" and state["ramp_i"] and state["decelerating_i"]:
        return 7, 0
    if params:
        return None, 0
    name = {"operation": "start", "exc_off": "aux_on" if busy else "exc_off"}.get(kind, kind)
    return None, action(name)


@cocotb.test()
async def command_random(dut):
    """For random codes, data and states, the status, actions and parameters are those of the tables."""
    rand = rng()
    u = BlockDriver(dut, "command", BLOCKS, "take_o act_o")
    await u.reset()
    error, number, code, kind, data = 0, 0, 0, "undefined", []
    finished = 0
    for n in range(4000):
        expected = not error and number > 0
        is_command = rand.random() < (0.1 if expected else 0.8)
        pick = rand.choice(CODES) if is_command else (rand.getrandbits(8), "undefined", 0)
        byte, new_kind, params = pick
        kept, value = rand.getrandbits(8), rand.choice((0, 0, 0, 4, 5))
        state = {name: rand.randrange(2) for name in ("busy_i", "ramp_i", "decelerating_i", "initialised_i")}
        state["busy_i"] &= rand.randrange(2)
        if expected and kind != "aux_out":
            state["busy_i"] = 0  # no other command collects parameters during a motion
        decoded = KINDS.index(new_kind) << 3 | params
        gate = {"open_i": rand.random() < 0.8, "stops_only_i": rand.random() < 0.2}
        state["is_checked_i"] = rand.random() < 0.8
        u.put(command_i=is_command, byte_i=byte, data_i=kept, param_error_i=value, decoded_i=decoded, **state)
        got = await u.clk(ready_i=0, **gate)
        same(f"byte {n}: nothing without ready_i", got, (0, 0))
        takes = gate["open_i"] and (not gate["stops_only_i"] or (is_command and new_kind in STOPS))
        act = 0
        if takes and is_command:
            refused, act = judge_code(new_kind, params, state)
            error, number = (0, params) if refused is None else (1, refused)
            code, kind, data = byte, new_kind, []
        elif takes and not expected:
            error, number = 1, 6 if state["busy_i"] else 3
        elif takes:
            data.append(kept)
            if number == 1 and value and state["is_checked_i"]:
                error, number = 1, value
            else:
                number -= 1
                if not number:
                    act = action({"operation": "start"}.get(kind, kind))
        where = f"byte {n} ({byte:02x}, {new_kind}), {state}"
        same(f"{where}: take, action", await u.settle(ready_i=1), (int(takes), act))
        if act and not is_command:
            finished += 1
            same(f"{where}: code", u.get("code_o"), code)
            together = sum(part << 8 * at for at, part in enumerate(data))
            same(f"{where}: parameters", u.get("params_o") >> 32 - 8 * len(data), together)
        await u.clk()
        await u.settle(ready_i=0)
        same(f"{where}: status", u.get("status_o"), error << 3 | number)
        if act and not is_command:
            same(f"{where}: kept", u.get("params_held_o") >> 32 - 8 * len(data), together)
            same(f"{where}: kept code", u.get("code_held_o"), code)
    assert finished > 100, f"only {finished} codes with parameters got to their end"


@cocotb.test()
@cocotb.parametrize(idle=[0, 1])
async def setup_frozen(dut, idle):
    """The first initialisation sets all values; later ones do not change the frozen bits until off_i."""
    rand = rng()
    u = BlockDriver(dut, f"setup{idle}", BLOCKS, "setup_o initialised_o")
    await u.reset()
    chop, positive, half, motor, ready = 0, 1 - idle, 0, 0, 0
    same("reset", await u.settle(), (positive << 3, 0))
    for n in range(60):
        code = rand.getrandbits(6) | 1
        external = code >> 4 & 1
        await u.clk(init_i=1, code_i=code)
        if not ready:
            half, motor = code >> 2 & 1, code & 3
            u.put(phase_init_i=1, positive_i=code >> 3 & 1)
            positive = code >> 3 & 1
        await u.clk(init_i=0, code_i=rand.getrandbits(8))
        tail = external << 5 | positive << 3 | half << 2 | motor
        got = await u.settle(phase_init_i=0, positive_i=rand.randrange(2))
        same(f"{n}: before it is complete", got, (tail | chop << 4, ready))
        await u.clk(ready_i=1)
        chop, ready = code >> 5 & 1, 1
        same(f"{n}: complete", await u.settle(ready_i=0), (tail | chop << 4, 1))
        if rand.random() < 0.3:
            await u.clk(off_i=1)
            chop, ready = 0, 0
            same(f"{n}: off", await u.settle(off_i=0), (tail, 0))


@cocotb.test()
@cocotb.parametrize(unread_flag=[0, 1])
async def finish_answers(dut, unread_flag):
    """For random motions and reads, the status, answers and interrupt equal those of a plain model."""
    rand = rng()
    u = BlockDriver(dut, f"finish{unread_flag}", BLOCKS, "answer_o int_no")
    await u.reset()
    unread, silent, op, pending = 0, 0, 0, 0
    for n in range(800):
        names = {"cause_i": 4, "remaining_i": 24, "inputs_i": 8, "outputs_i": 8, "auxi_i": 4, "select_i": 3}
        pins = {name: rand.getrandbits(width) for name, width in names.items()}
        what = rand.choice(("start", "done", "read", "none"))
        code = rand.getrandbits(8)
        answer, int_n = await u.settle(
            op_code_i=code, start_i=what == "start", done_i=what == "done", read_i=what == "read", **pins
        )
        bit7 = unread if unread_flag else 1
        shown = {
            0: bit7 << 7 | pins["cause_i"] << 3 | op,
            1: pins["inputs_i"],
            2: pins["outputs_i"],
            5: pins["auxi_i"],
        }.get(pins["select_i"], pins["remaining_i"] & 0xFF)
        same(f"{n}: answer to {pins['select_i']}", answer & 0xFF, shown)
        if pins["select_i"] == 3:
            same(f"{n}: all of it", answer, pins["remaining_i"])
        same(f"{n}: interrupt", int_n, 1 - pending)
        await u.clk()
        if what == "start":
            silent, op = code >> 4 & 1, code & 7
        elif what == "done":
            unread, pending = 1, pending | (1 - silent)
        elif what == "read" and pins["select_i"] == 0:
            unread, pending = 0, 0


async def clk_to_action(u: BlockDriver, where: str, closed: bool) -> int:
    """Return the number of clock edges until an action appears on act_o.

    If `closed` is set, check that the mailbox is closed until then.
    """
    for took in range(5_000):
        if (await u.settle())[0]:
            return took
        if closed:
            same(f"{where}: closed before it", u.get("open_o"), 0)
        await u.clk()
    raise AssertionError(f"{where}: no action within {took + 1} cycles")


@cocotb.test()
async def proc_time_fast(dut):
    """In FAST, act_o equals act_i in the same cycle; an initialisation ends when its table is complete."""
    u = BlockDriver(dut, "fast", BLOCKS, "act_o open_o go_o end_delay_o phase_init_o ready_o")
    await u.reset()
    for name in ACTIONS:
        phase_init = name == "init"
        got = await u.clk(act_i=action(name), initialised_i=0)
        same(name, got, (action(name), 1, 1, 0, int(phase_init), 0))
    same("no phase_init once initialised", (await u.clk(act_i=action("init"), initialised_i=1))[4], 0)
    u.put(act_i=0)
    for _ in range(5):
        same("closed while the table is built", (await u.clk(building_i=1))[1], 0)
    same("and one cycle longer, when it is complete", await u.clk(building_i=0), (0, 0, 1, 0, 0, 1))
    same("open", await u.clk(), (0, 1, 1, 0, 0, 0))


@cocotb.test()
@cocotb.parametrize(name=list(VARIANTS))
async def proc_time_datasheet(dut, name):
    """In DATASHEET, start, first pulse, end and opening of the mailbox occur at their documented times."""
    clk, xtal, bits, low, high, timed = VARIANTS[name]
    u = BlockDriver(
        dut,
        f"proc_time_{name}",
        BLOCKS,
        "act_o open_o go_o end_delay_o phase_init_o ready_o",
        BlockDriver.FREE,
    )
    await u.reset()

    def cyc(microseconds: float) -> int:
        """Return the cycles of a time that is specified for 16 MHz; the time scales with the crystal."""
        return ceil(round(microseconds * 16) * clk / xtal)

    steps = low + 3
    await u.clk(act_i=action("init"), params_i=steps << 16, initialised_i=0)
    # In the next cycle the command unit outputs the parameters shifted down by one byte, with the present
    # byte as the highest one.
    await u.clk(act_i=0, params_i=0xA5 << 24 | steps << 8)
    await u.settle(params_i=0)
    same("phases", await u.run_until("phase_init_o", 1), cyc(44) - 1)
    whole = ceil((264_000 + 209 * (steps - low)) * clk / xtal)
    same("initialisation", await u.run_until("ready_o", 1), whole - cyc(44))
    same("closed", u.get("open_o"), 0)
    await u.clk(initialised_i=1)
    same("open", u.get("open_o"), 1)
    for op, begin, first in (
        (2, 27, 86),
        (4, 27, 194),
        (5, 27, 194),
        (7, 27, 194),
        (3, 112, 200),
        (6, 112, 200),
    ):
        ramp, single = op in (3, 6), op == 2
        for end in ("normal", "stop", "short"):
            if end == "short" and not ramp:
                continue  # only an operation with a ramp can end at a pulse before its count is complete
            await u.clk(
                act_i=action("start"),
                code_i=0x40 | op,
                code_held_i=0x40 | op,
                params_i=0xFFFF << 8,
                steps_i=9,
            )
            u.put(act_i=0, code_i=0, ramp_i=ramp, single_i=single, params_i=0)
            where = f"{name}, operation {op}, {end}"
            same(f"{where}: start", await clk_to_action(u, where, True), cyc(begin))
            same(f"{where}: what starts", (u.get("act_o"), u.get("code_o")), (action("start"), 0x40 | op))
            if end == "stop":
                await u.clk(stop_i=1)
                same(f"{where}: lingers, closed", (await u.settle(stop_i=0))[1:4], (0, 0, 1))
            else:
                same(f"{where}: pulse 1", await u.run_until("go_o", 1), cyc(first) - cyc(begin))
                await u.clk(pulse_i=1, last_i=1, final_i=end == "normal")
                same(f"{where}: lingers, closed", (await u.settle(pulse_i=0, last_i=0))[1::2][:2], (0, 1))
                await u.clk()
            slow = ramp and end != "normal"
            same(f"{where}: end", await u.run_until("end_delay_o", 0), cyc(200 if slow else 26))
            opens = 200 if slow else 26 if single and end == "normal" else 156
            rest = await u.run_until("open_o", 1)
            same(f"{where}: open", rest, cyc(opens) - cyc(200 if slow else 26) + 1)
    for what in ("halt", "read", "switching"):
        same(f"{what} at once", (await u.clk(act_i=action(what)))[0], action(what))
    u.put(ramp_i=1)
    got = (await u.clk(act_i=action("decel")))[0]
    u.put(act_i=0)
    same("decelerating stop of a ramp", got, 0 if timed else action("decel"))
    if timed:
        same("takes its time", await clk_to_action(u, "decelerating stop", False), cyc(17))
