# SPDX-License-Identifier: Apache-2.0
# Tang Nano 9K: the oscillator, 27 MHz.
create_clock -name clk_27m -period 37.037 [get_ports {clk_27m}]
