# Written by `make packages` from rtl/files.yml; change that, not this.
# Not run by this project's tests, which have no vendor tools; please report what does not work.
# Gowin EDA, with a project open: source .../packages/gowin.tcl
set root [file normalize [file join [file dirname [info script]] ..]]
set_option -verilog_std sysv2017
set_option -include_path $root/rtl/common
add_file -type verilog $root/rtl/common/ppmc_pkg.sv
add_file -type verilog $root/rtl/common/ppmc_reset.sv
add_file -type verilog $root/rtl/common/ppmc_sync.sv
add_file -type verilog $root/rtl/common/ppmc_ram.sv
add_file -type verilog $root/rtl/common/ppmc_tick_gen.sv
add_file -type verilog $root/rtl/common/ppmc_square.sv
add_file -type verilog $root/rtl/common/ppmc_xtal_timer.sv
add_file -type verilog $root/rtl/common/ppmc_uart_rx.sv
add_file -type verilog $root/rtl/common/ppmc_uart_tx.sv
add_file -type verilog $root/rtl/motion/ppmc_motion_pkg.sv
add_file -type verilog $root/rtl/motion/ppmc_op_pkg.sv
add_file -type verilog $root/rtl/motion/ppmc_ramp_pkg.sv
add_file -type verilog $root/rtl/motion/ppmc_base_clock.sv
add_file -type verilog $root/rtl/motion/ppmc_ext_clock.sv
add_file -type verilog $root/rtl/motion/ppmc_ext_lag.sv
add_file -type verilog $root/rtl/motion/ppmc_rate_counter.sv
add_file -type verilog $root/rtl/motion/ppmc_pulse_shaper.sv
add_file -type verilog $root/rtl/motion/ppmc_stop_guard.sv
add_file -type verilog $root/rtl/motion/ppmc_ramp_serial.sv
add_file -type verilog $root/rtl/motion/ppmc_ramp_builder.sv
add_file -type verilog $root/rtl/motion/ppmc_ramp_table.sv
add_file -type verilog $root/rtl/motion/ppmc_ramp_tables.sv
add_file -type verilog $root/rtl/motion/ppmc_ramp_seq.sv
add_file -type verilog $root/rtl/motion/ppmc_axis.sv
add_file -type verilog $root/rtl/motion/ppmc_excitation.sv
add_file -type verilog $root/rtl/motion/ppmc_chopper.sv
add_file -type verilog $root/rtl/motion/ppmc_hold_timer.sv
add_file -type verilog $root/rtl/motion/ppmc_motor_port.sv
add_file -type verilog $root/rtl/motion/ppmc_pulse_counter.sv
add_file -type verilog $root/rtl/host/ppmc_strobe_bus.sv
add_file -type verilog $root/rtl/host/ppmc_mailbox.sv
add_file -type verilog $root/rtl/host/ppmc_host_port.sv
add_file -type verilog $root/rtl/host/ppmc_strobe_master.sv
add_file -type verilog $root/rtl/host/ppmc_bridge_pkg.sv
add_file -type verilog $root/rtl/host/ppmc_bridge_rx.sv
add_file -type verilog $root/rtl/host/ppmc_bridge_tx.sv
add_file -type verilog $root/rtl/host/ppmc_bridge_msg.sv
add_file -type verilog $root/rtl/host/ppmc_bridge_rate.sv
add_file -type verilog $root/rtl/host/ppmc_bridge_answer.sv
add_file -type verilog $root/rtl/host/ppmc_bridge_exec.sv
add_file -type verilog $root/rtl/host/ppmc_uart_bridge.sv
add_file -type verilog $root/rtl/host/ppmc_uart_host.sv
add_file -type verilog $root/rtl/host/ppmc_wishbone.sv
add_file -type verilog $root/rtl/host/ppmc_axil.sv
add_file -type verilog $root/rtl/host/ppmc_isa.sv
add_file -type verilog $root/rtl/ppmc104/ppmc104_pkg.sv
add_file -type verilog $root/rtl/ppmc104/ppmc104_command.sv
add_file -type verilog $root/rtl/ppmc104/ppmc104_setup.sv
add_file -type verilog $root/rtl/ppmc104/ppmc104_finish.sv
add_file -type verilog $root/rtl/ppmc104/ppmc104_pace.sv
add_file -type verilog $root/rtl/ppmc104/ppmc104.sv
add_file -type verilog $root/rtl/ppmc2104/ppmc2104_pkg.sv
add_file -type verilog $root/rtl/ppmc2104/ppmc2104_command.sv
add_file -type verilog $root/rtl/ppmc2104/ppmc2104_report.sv
add_file -type verilog $root/rtl/ppmc2104/ppmc2104_speed.sv
add_file -type verilog $root/rtl/ppmc2104/ppmc2104_pace.sv
add_file -type verilog $root/rtl/ppmc2104/ppmc2104_setup.sv
add_file -type verilog $root/rtl/ppmc2104/ppmc2104_axis.sv
add_file -type verilog $root/rtl/ppmc2104/ppmc2104.sv
add_file -type verilog $root/rtl/isa_4axis/isa_4axis.sv
add_file -type verilog $root/rtl/boards/ppmc104_board.sv
add_file -type verilog $root/rtl/boards/ppmc2104_board.sv
