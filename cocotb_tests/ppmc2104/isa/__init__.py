"""Tests of the four-axis ISA module isa_4axis and of its bus slave ppmc_isa.

    setting.py pins and build of the module, a test bench with its four axes models.py comparison of each part
    with a separate golden model, and of irq with int_n tb_bus.py addresses, AEN, lengths of bus accesses, the
    source register tb_motion.py interrupts, four axes together, both parts with random hosts tb_slave.py
    ppmc_isa alone with one part, as on the J105 board

test_isa.py runs the tests under pytest, test_program.py the C program of the manual. The ISA bus master is in
harness/isa.py.
"""
