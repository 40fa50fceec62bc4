# Written by `make packages` from scripts/fpga/packages/vendors.py; change that, not this.
# Not run by this project's tests, which have no vendor tools; please report what does not work.
# Plain Verilog-2005 of one part, bridge or board, written earlier by
#   make verilog TOP=<top> PARAMS=CLK_HZ=<Hz of your clk>
# Gowin EDA, with a project open: set top ppmc104; source .../packages/gowin.tcl
if {![info exists root]} {set root [file normalize [file join [file dirname [info script]] ..]]}
if {![info exists top]} {set top ppmc104}
set plain $root/build/verilog/$top.v
if {![file exists $plain]} {error "${plain}: not written; run `make verilog TOP=$top` in $root"}
add_file -type verilog $plain
