# SPDX-License-Identifier: Apache-2.0
# Written by `make boards` from constraints/arty_a7/board.yml and ppmc104_carrier.sv; change those, not this.
# board_arty_a7_ppmc104: PPMC-104 with UART or bus host on Arty A7-35T, -100T. Wiring: docs/boards.md.
# Use Vivado. This project has linted this board, but not built or run it.

# The configuration bank has 3.3 V.
set_property CFGBVS VCCO [current_design]
set_property CONFIG_VOLTAGE 3.3 [current_design]

# Board
set_property -dict {PACKAGE_PIN E3  IOSTANDARD LVCMOS33} [get_ports {clk}] ; # oscillator, 100 MHz
set_property -dict {PACKAGE_PIN C2  IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {ck_rst_n}] ; # button RESET
set_property -dict {PACKAGE_PIN H5  IOSTANDARD LVCMOS33} [get_ports {led[0]}] ; # LD4
set_property -dict {PACKAGE_PIN J5  IOSTANDARD LVCMOS33} [get_ports {led[1]}] ; # LD5
set_property -dict {PACKAGE_PIN T9  IOSTANDARD LVCMOS33} [get_ports {led[2]}] ; # LD6
set_property -dict {PACKAGE_PIN T10 IOSTANDARD LVCMOS33} [get_ports {led[3]}] ; # LD7

# USB-UART (J10)
set_property -dict {PACKAGE_PIN A9  IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {uart_rxd}] ; # from the PC
set_property -dict {PACKAGE_PIN D10 IOSTANDARD LVCMOS33} [get_ports {uart_txd}] ; # to the PC

# JA: motor
set_property -dict {PACKAGE_PIN G13 IOSTANDARD LVCMOS33} [get_ports {pout_n}] ; # JA1
set_property -dict {PACKAGE_PIN B11 IOSTANDARD LVCMOS33} [get_ports {dir}] ; # JA2
set_property -dict {PACKAGE_PIN A11 IOSTANDARD LVCMOS33} [get_ports {hold}] ; # JA3
set_property -dict {PACKAGE_PIN D13 IOSTANDARD LVCMOS33} [get_ports {s[1]}] ; # JA7
set_property -dict {PACKAGE_PIN B18 IOSTANDARD LVCMOS33} [get_ports {s[2]}] ; # JA8
set_property -dict {PACKAGE_PIN A18 IOSTANDARD LVCMOS33} [get_ports {s[3]}] ; # JA9
set_property -dict {PACKAGE_PIN K16 IOSTANDARD LVCMOS33} [get_ports {s[4]}] ; # JA10
set_property -dict {PACKAGE_PIN D12 IOSTANDARD LVCMOS33} [get_ports {s[5]}] ; # JA4

# JD: switches, external base clock
set_property -dict {PACKAGE_PIN D4  IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {l1_n}] ; # JD1
set_property -dict {PACKAGE_PIN D3  IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {l2_n}] ; # JD2
set_property -dict {PACKAGE_PIN F4  IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {l3_n}] ; # JD3
set_property -dict {PACKAGE_PIN F3  IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {l4_n}] ; # JD4
set_property -dict {PACKAGE_PIN E2  IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {cnp_n}] ; # JD7
set_property -dict {PACKAGE_PIN D2  IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {alm_n}] ; # JD8
set_property -dict {PACKAGE_PIN H2  IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {clock}] ; # JD9
set_property -dict {PACKAGE_PIN G2  IOSTANDARD LVCMOS33} [get_ports {aux_n}] ; # JD10

# JB: auxiliary
set_property -dict {PACKAGE_PIN E15 IOSTANDARD LVCMOS33} [get_ports {auxo[0]}] ; # JB1
set_property -dict {PACKAGE_PIN E16 IOSTANDARD LVCMOS33} [get_ports {auxo[1]}] ; # JB2
set_property -dict {PACKAGE_PIN D15 IOSTANDARD LVCMOS33} [get_ports {auxo[2]}] ; # JB3
set_property -dict {PACKAGE_PIN C15 IOSTANDARD LVCMOS33} [get_ports {auxo[3]}] ; # JB4
set_property -dict {PACKAGE_PIN J17 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {auxi[0]}] ; # JB7
set_property -dict {PACKAGE_PIN J18 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {auxi[1]}] ; # JB8
set_property -dict {PACKAGE_PIN K15 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {auxi[2]}] ; # JB9
set_property -dict {PACKAGE_PIN J15 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {auxi[3]}] ; # JB10

# JC: straps
set_property -dict {PACKAGE_PIN U12 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {csel}] ; # JC1
set_property -dict {PACKAGE_PIN V12 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {vsel}] ; # JC2

# Shield connector: bus
set_property -dict {PACKAGE_PIN V15 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {d[0]}] ; # IO0
set_property -dict {PACKAGE_PIN U16 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {d[1]}] ; # IO1
set_property -dict {PACKAGE_PIN P14 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {d[2]}] ; # IO2
set_property -dict {PACKAGE_PIN T11 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {d[3]}] ; # IO3
set_property -dict {PACKAGE_PIN R12 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {d[4]}] ; # IO4
set_property -dict {PACKAGE_PIN T14 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {d[5]}] ; # IO5
set_property -dict {PACKAGE_PIN T15 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {d[6]}] ; # IO6
set_property -dict {PACKAGE_PIN T16 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {d[7]}] ; # IO7
set_property -dict {PACKAGE_PIN N15 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {a0}] ; # IO8
set_property -dict {PACKAGE_PIN M16 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {cs_n}] ; # IO9
set_property -dict {PACKAGE_PIN V17 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {rd_n}] ; # IO10
set_property -dict {PACKAGE_PIN U18 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {wr_n}] ; # IO11
set_property -dict {PACKAGE_PIN R17 IOSTANDARD LVCMOS33} [get_ports {int_n}] ; # IO12
set_property -dict {PACKAGE_PIN P17 IOSTANDARD LVCMOS33} [get_ports {d_oe}] ; # IO13
set_property -dict {PACKAGE_PIN U11 IOSTANDARD LVCMOS33 PULLUP TRUE} [get_ports {host_rst_n}] ; # IO26

# oscillator
create_clock -name clk -period 10.000 [get_ports {clk}]

# Every input is synchronised inside, and no output has a phase that matters outside.
set_false_path -from [get_ports -filter {DIRECTION != OUT && NAME != clk}]
set_false_path -to [get_ports -filter {DIRECTION != IN}]
