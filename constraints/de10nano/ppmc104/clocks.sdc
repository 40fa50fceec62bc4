# SPDX-License-Identifier: Apache-2.0
# Written by `make boards` from constraints/de10nano/board.yml and ppmc104_carrier.sv; change those, not this.
# board_de10nano_ppmc104: PPMC-104 with UART or bus host on DE10-Nano. Wiring: docs/boards.md.

# oscillator
create_clock -name clk -period 20.000 [get_ports {clk}]
derive_clock_uncertainty

# Every input is synchronised inside, and no output has a phase that matters outside.
set_false_path -from [remove_from_collection [all_inputs] [get_ports {clk}]]
set_false_path -to [all_outputs]
