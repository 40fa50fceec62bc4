# SPDX-License-Identifier: Apache-2.0
# Written by `make packages` from constraints/arty_a7/board.yml; change that, not this.
# Not run by this project's tests, which have no vendor tools; please report what does not work.
# Arty A7-35T, -100T with Vivado:
#   make verilog TOP=board_arty_a7_ppmc104
#   vivado -mode batch -source packages/projects/arty_a7.tcl
set root [file normalize [file join [file dirname [info script]] .. ..]]
set parts {ppmc104}
set on [lindex $parts 0]
if {[info exists ::env(PART)]} {set on $::env(PART)}
if {[lsearch -exact $parts $on] < 0} {error "PART=$on: this board has $parts"}
set top board_arty_a7_[string map {- _} $on]
set plain $root/build/verilog/$top.v
if {![file exists $plain]} {error "${plain}: not written; run `make verilog TOP=$top` in $root"}
set pins $root/constraints/arty_a7/$on
file mkdir $root/build/vivado/$top
cd $root/build/vivado/$top

create_project -force -part xc7a35ticsg324-1L $top .
add_files -norecurse $plain
add_files -fileset constrs_1 -norecurse $pins/pins.xdc
set_property top $top [current_fileset]
launch_runs impl_1 -to_step write_bitstream
wait_on_run impl_1
if {[get_property PROGRESS [get_runs impl_1]] ne "100%"} {error "$top: the run impl_1 failed"}
if {[get_property STATS.WNS [get_runs impl_1]] < 0} {error "$top: too slow for its clock"}
