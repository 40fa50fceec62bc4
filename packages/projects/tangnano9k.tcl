# SPDX-License-Identifier: Apache-2.0
# Written by `make packages` from constraints/tangnano9k/board.yml; change that, not this.
# Not run by this project's tests, which have no vendor tools; please report what does not work.
# Tang Nano 9K with Gowin EDA:
#   make verilog TOP=board_tangnano9k_ppmc104
#   gw_sh packages/projects/tangnano9k.tcl
# The environment variable PART selects another part of the board: bank.
set root [file normalize [file join [file dirname [info script]] .. ..]]
set parts {ppmc104 bank}
set on [lindex $parts 0]
if {[info exists ::env(PART)]} {set on $::env(PART)}
if {[lsearch -exact $parts $on] < 0} {error "PART=$on: this board has $parts"}
set top board_tangnano9k_[string map {- _} $on]
set plain $root/build/verilog/$top.v
if {![file exists $plain]} {error "${plain}: not written; run `make verilog TOP=$top` in $root"}
set pins $root/constraints/tangnano9k/$on
file mkdir $root/build/gowin/$top
cd $root/build/gowin/$top

set_device -name GW1NR-9C GW1NR-LV9QN88PC6/I5
add_file -type verilog $plain
add_file -type cst $pins/pins.cst
add_file -type sdc $pins/clocks.sdc
set_option -top_module $top
set_option -output_base_name $top
set_option -verilog_std v2001
set_option -use_sspi_as_gpio 1
run all
