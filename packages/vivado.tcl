# Written by `make packages` from rtl/files.yml; change that, not this.
# Not run by this project's tests, which have no vendor tools; please report what does not work.
# Vivado, in a project: source .../packages/vivado.tcl
set root [file normalize [file join [file dirname [info script]] ..]]
set files [list \
  $root/rtl/common/ppmc_pkg.sv \
  $root/rtl/common/ppmc_reset.sv \
  $root/rtl/common/ppmc_sync.sv \
  $root/rtl/common/ppmc_ram.sv \
  $root/rtl/common/ppmc_tick_gen.sv \
  $root/rtl/common/ppmc_square.sv \
  $root/rtl/common/ppmc_xtal_timer.sv \
  $root/rtl/common/ppmc_uart_rx.sv \
  $root/rtl/common/ppmc_uart_tx.sv \
  $root/rtl/motion/ppmc_motion_pkg.sv \
  $root/rtl/motion/ppmc_op_pkg.sv \
  $root/rtl/motion/ppmc_ramp_pkg.sv \
  $root/rtl/motion/ppmc_base_clock.sv \
  $root/rtl/motion/ppmc_ext_clock.sv \
  $root/rtl/motion/ppmc_ext_lag.sv \
  $root/rtl/motion/ppmc_rate_counter.sv \
  $root/rtl/motion/ppmc_pulse_shaper.sv \
  $root/rtl/motion/ppmc_stop_guard.sv \
  $root/rtl/motion/ppmc_ramp_serial.sv \
  $root/rtl/motion/ppmc_ramp_builder.sv \
  $root/rtl/motion/ppmc_ramp_table.sv \
  $root/rtl/motion/ppmc_ramp_tables.sv \
  $root/rtl/motion/ppmc_ramp_seq.sv \
  $root/rtl/motion/ppmc_axis.sv \
  $root/rtl/motion/ppmc_excitation.sv \
  $root/rtl/motion/ppmc_chopper.sv \
  $root/rtl/motion/ppmc_hold_timer.sv \
  $root/rtl/motion/ppmc_motor_port.sv \
  $root/rtl/motion/ppmc_pulse_counter.sv \
  $root/rtl/host/ppmc_strobe_bus.sv \
  $root/rtl/host/ppmc_mailbox.sv \
  $root/rtl/host/ppmc_host_port.sv \
  $root/rtl/host/ppmc_strobe_master.sv \
  $root/rtl/host/ppmc_bridge_pkg.sv \
  $root/rtl/host/ppmc_bridge_rx.sv \
  $root/rtl/host/ppmc_bridge_tx.sv \
  $root/rtl/host/ppmc_bridge_msg.sv \
  $root/rtl/host/ppmc_bridge_rate.sv \
  $root/rtl/host/ppmc_bridge_answer.sv \
  $root/rtl/host/ppmc_bridge_exec.sv \
  $root/rtl/host/ppmc_uart_bridge.sv \
  $root/rtl/host/ppmc_uart_host.sv \
  $root/rtl/host/ppmc_wishbone.sv \
  $root/rtl/host/ppmc_axil.sv \
  $root/rtl/host/ppmc_isa.sv \
  $root/rtl/single/ppmc_code_pkg.sv \
  $root/rtl/single/ppmc_command.sv \
  $root/rtl/single/ppmc_setup.sv \
  $root/rtl/single/ppmc_pace.sv \
  $root/rtl/single/ppmc_finish.sv \
  $root/rtl/single/ppmc_single.sv \
  $root/rtl/ppmc104/ppmc104_pkg.sv \
  $root/rtl/ppmc104/ppmc104_setup.sv \
  $root/rtl/ppmc104/ppmc104_pace.sv \
  $root/rtl/ppmc104/ppmc104.sv \
  $root/rtl/ppmc2104/ppmc2104_pkg.sv \
  $root/rtl/ppmc2104/ppmc2104_command.sv \
  $root/rtl/ppmc2104/ppmc2104_report.sv \
  $root/rtl/ppmc2104/ppmc2104_speed.sv \
  $root/rtl/ppmc2104/ppmc2104_pace.sv \
  $root/rtl/ppmc2104/ppmc2104_setup.sv \
  $root/rtl/ppmc2104/ppmc2104_axis.sv \
  $root/rtl/ppmc2104/ppmc2104.sv \
  $root/rtl/stmc/stmc_pkg.sv \
  $root/rtl/stmc/stmc.sv \
  $root/rtl/stmc/j105_stmc.sv \
  $root/rtl/isa_4axis/isa_4axis.sv \
  $root/rtl/boards/ppmc_board_host.sv \
  $root/rtl/boards/ppmc104_board.sv \
  $root/rtl/boards/ppmc2104_board.sv \
  $root/rtl/boards/ppmc_board_steps.sv \
  $root/rtl/boards/stmc_board.sv \
]
add_files -norecurse $files
set_property file_type SystemVerilog [get_files $files]
set dirs [get_property include_dirs [current_fileset]]
lappend dirs $root/rtl/common
set_property include_dirs $dirs [current_fileset]
