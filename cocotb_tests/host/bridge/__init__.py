"""Tests of the UART bridge, whose contract is docs/uart_bridge.md.

bench.py         Bench: clock, line (bit level, any rate error), frames, the bus slave
slave.py         RegisterModel: a mailbox part whose behaviour depends only on its accesses
settings.py      build configurations
tb_line.py       UB-LIN; tb_frames.py UB-FRM; tb_ops.py ops, UB-BUS; tb_waits.py UB-WAIT;
tb_messages.py   UB-SEQ, UB-ANS, UB-MSG; tb_random.py random scripts, compared with the golden model
tb_board.py      ppmc104_carrier: a part with its bridge
tb_station.py    top of a board with a PPMC-2104 on the bus of the old chip
"""
