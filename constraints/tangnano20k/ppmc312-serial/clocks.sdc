# SPDX-License-Identifier: Apache-2.0
# Written by `make boards` from constraints/tangnano20k/board.yml and ppmc312_carrier.sv; change those, not this.
# board_tangnano20k_ppmc312_serial: PPMC-312 in serial mode on Tang Nano 20K. Wiring: docs/boards.md.

# oscillator; the PLL's output follows from it
create_clock -name clk_27m -period 37.037 [get_ports {clk_27m}]
