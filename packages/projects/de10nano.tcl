# SPDX-License-Identifier: Apache-2.0
# Written by `make packages` from constraints/de10nano/board.yml; change that, not this.
# Not run by this project's tests, which have no vendor tools; please report what does not work.
# DE10-Nano with Quartus:
#   make verilog TOP=board_de10nano_ppmc104
#   quartus_sh -t packages/projects/de10nano.tcl
set root [file normalize [file join [file dirname [info script]] .. ..]]
set parts {ppmc104}
set on [lindex $parts 0]
if {[info exists ::env(PART)]} {set on $::env(PART)}
if {[lsearch -exact $parts $on] < 0} {error "PART=$on: this board has $parts"}
set top board_de10nano_[string map {- _} $on]
set plain $root/build/verilog/$top.v
if {![file exists $plain]} {error "${plain}: not written; run `make verilog TOP=$top` in $root"}
set pins $root/constraints/de10nano/$on
file mkdir $root/build/quartus/$top
cd $root/build/quartus/$top

package require ::quartus::project
package require ::quartus::flow
project_new -overwrite $top
set_global_assignment -name VERILOG_FILE $plain
source $pins/pins.qsf
set_global_assignment -name SDC_FILE $pins/clocks.sdc
export_assignments
execute_flow -compile
project_close
