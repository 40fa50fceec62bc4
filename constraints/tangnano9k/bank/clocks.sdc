# SPDX-License-Identifier: Apache-2.0
# Written by `make boards` from constraints/tangnano9k/board.yml and ppmc_bank_carrier.sv; change those, not this.
# board_tangnano9k_bank: PPMC bank with UART or SPI host on Tang Nano 9K. Wiring: docs/boards.md.

# oscillator; the PLL's output follows from it
create_clock -name clk_27m -period 37.037 [get_ports {clk_27m}]
