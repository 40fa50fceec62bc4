# SPDX-License-Identifier: Apache-2.0
# DE10-Nano: the oscillator, 50 MHz. Every input is synchronised inside; no output has a phase that matters outside.
create_clock -name clk -period 20.000 [get_ports {clk}]
derive_clock_uncertainty
set_false_path -from [remove_from_collection [all_inputs] [get_ports {clk}]]
set_false_path -to [all_outputs]
