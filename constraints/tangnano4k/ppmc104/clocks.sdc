# SPDX-License-Identifier: Apache-2.0
# Written by `make boards` from constraints/tangnano4k/board.yml and ppmc104_carrier.sv; change those, not this.
# board_tangnano4k_ppmc104: PPMC-104 with UART host on Tang Nano 4K. Wiring: docs/boards.md.

# oscillator
create_clock -name clk_27m -period 37.037 [get_ports {clk_27m}]
