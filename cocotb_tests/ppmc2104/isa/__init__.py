"""Tests of the four-axis ISA module isa_4axis and of its bus slave ppmc_isa.

setting.py     pins and build of the module, a test bench with its four axes
master.py      an ISA bus master that times in nanoseconds, and a host for one part
models.py      the inputs of each part, replayed into a separate golden model; irq compared with int_n
tb_bus.py      addresses, AEN, lengths of bus accesses, the source register
tb_motion.py   interrupts, four axes together, both parts with random hosts
tb_slave.py    ppmc_isa alone with one part, as in the J105 board
test_isa_4axis.py runs them under pytest
"""
