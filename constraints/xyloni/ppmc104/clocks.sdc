# SPDX-License-Identifier: Apache-2.0
# Written by `make boards` from constraints/xyloni/board.yml and ppmc104_carrier.sv; change those, not this.
# board_xyloni_ppmc104: PPMC-104 with UART host on Xyloni. Wiring: docs/boards.md.

# oscillator
create_clock -name clk -period 30.003 [get_ports {clk}]
