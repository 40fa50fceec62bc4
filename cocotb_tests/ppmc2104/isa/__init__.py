"""Tests of the four-axis ISA module isa_4axis and of its bus slave ppmc_isa.

setting.py     the module's pins, its build, a bench with its four axes
master.py      an ISA bus master by nanoseconds, and the host of one part behind it
models.py      what each of the two parts saw, replayed into a golden model of its own; irq against int_n
tb_bus.py      addresses, AEN, lengths of cycles, the source register
tb_motion.py   interrupts, four axes at once, both parts busy at random
tb_slave.py    ppmc_isa alone with one part, as the J105 board needs it
test_isa_4axis.py runs them under pytest
"""
