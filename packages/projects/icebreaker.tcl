# SPDX-License-Identifier: Apache-2.0
# Written by `make packages` from constraints/icebreaker/board.yml; change that, not this.
# Not run by this project's tests, which have no vendor tools; please report what does not work.
# iCEBreaker with Radiant:
#   make verilog TOP=board_icebreaker_ppmc104
#   radiantc packages/projects/icebreaker.tcl
# The environment variable PART selects another part of the board: ppmc104-bus, ppmc2104, stmc, pmc006, bank.
set root [file normalize [file join [file dirname [info script]] .. ..]]
set parts {ppmc104 ppmc104-bus ppmc2104 stmc pmc006 bank}
set on [lindex $parts 0]
if {[info exists ::env(PART)]} {set on $::env(PART)}
if {[lsearch -exact $parts $on] < 0} {error "PART=$on: this board has $parts"}
set top board_icebreaker_[string map {- _} $on]
set plain $root/build/verilog/$top.v
if {![file exists $plain]} {error "${plain}: not written; run `make verilog TOP=$top` in $root"}
set pins $root/constraints/icebreaker/$on
file mkdir $root/build/radiant/$top
cd $root/build/radiant/$top

file delete -force $top.rdf
prj_create -name $top -impl impl_1 -dev iCE40UP5K-SG48I -performance High-Performance_1.2V -synthesis lse
prj_add_source $plain
# The cells of the iCE40 have other names in Radiant.
prj_add_source $root/packages/projects/radiant_cells.v
prj_add_source $pins/pins.pdc
prj_set_impl_opt -impl impl_1 top $top
prj_save
prj_run Synthesis -impl impl_1
prj_run Map -impl impl_1
prj_run PAR -impl impl_1
prj_run Export -impl impl_1
prj_save
prj_close
