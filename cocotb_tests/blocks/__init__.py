"""Unit tests of the shared RTL blocks, each against the contract in its header comment.

    tb_common.py   ppmc_sync, ppmc_reset, ppmc_ram, ppmc_tick_gen, ppmc_xtal_timer
    tb_motion.py   clocks, counters, pulse shaper, stop guard, hold timer, chopper, excitation
    tb_ramp.py     ramp builder, ramp table, ramp sequencer
    tb_host.py     strobe bus, mailbox, host port
    tb_single.py   command unit, set-up, finish status, processing times of the parts with one axis

Each tb module has a table BLOCKS: instance name -> Block. wrapper.py turns it into one top module that holds
all instances side by side, each with its own clock, so that an area costs one build. Inside the simulator a
test drives one instance through `Unit`.
"""
