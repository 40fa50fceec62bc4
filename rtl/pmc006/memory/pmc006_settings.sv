// SPDX-License-Identifier: Apache-2.0
// pmc006_settings: stores the parameter registers.
// Rules:  P006-CMD-04..50, P006-MOT-52; EXTEN, VSET and ACC of the user program: docs/pmc006/README.md, 13.
// Timing: the registers change at the edge that ends the cycle of write_i.
`default_nettype none

module pmc006_settings
  import pmc006_pkg::*;
(
    input  wire logic                clk_i,
    input  wire logic                rst_ni,
    input  wire exec_cmd_t           cmd_i,       // instruction in progress
    input  wire reg_access_t         access_i,    // register of cmd_i
    input  wire logic                write_i,     // strobe: execute cmd_i; its data are accepted
    input  wire logic                sample_i,    // strobe: sample the value for the reply
    output motor_settings_t          settings_o,  // settings used by motion and drive
    output control_settings_t        control_o,   // settings used only by the control
    output logic              [13:0] value_o      // value of access_i.reg_id at the last sample_i; RegNone: 0
);

  logic [13:0] data;
  logic write, unused_bits;

  assign write = write_i && access_i.write;
  assign unused_bits = &{1'b0, cmd_i};

  always_comb begin
    data = cmd_i.data[13:0];
    // The acceleration coefficient 6 has the effect of 5. Only the user program can set 6.
    if (cmd_i.op == I_ACC && data[2:1] == 2'b11) data[1:0] = 2'b01;
    // If the instruction is not from a frame, bit 0 of EXTEN enables or disables both inputs.
    if (cmd_i.op == I_EXTEN && cmd_i.source != FromFrame) data[1] = data[0];
  end

  pmc006_reply_ram u_reply_ram (
      .clk_i,
      .rst_ni,
      .write_i (write),
      .reg_id_i(access_i.reg_id),
      .data_i  (data),
      .sample_i,
      .value_o
  );

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      settings_o <= SETTINGS_RESET;
      control_o  <= CONTROL_RESET;
    end else if (write) begin
      unique case (access_i.reg_id)
        RegMstep:   settings_o.mstep <= data[7:0];
        RegCurrent: settings_o.cur <= data[11:0];
        RegAcc:     settings_o.acc <= data[2:0];
        RegDec:     settings_o.dec <= data[2:0];
        RegAutodec: settings_o.autodec <= data[0];
        RegAtt:     settings_o.att <= data[2:0];
        RegVstart:  settings_o.vstart <= data[11:0];
        RegVstop:   settings_o.vstop <= data[11:0];
        RegCcomp:   settings_o.ccomp <= data[10:0];
        RegScomp:   settings_o.scomp <= data[10:0];
        RegVmax: begin
          settings_o.vmax <= data;
          settings_o.regulate <= cmd_i.option[0];
        end
        RegDir:     settings_o.dir <= data[0];
        RegFree:    settings_o.free <= data[0];
        RegAddr:    control_o.addr <= data[7:0];
        RegTrigger: control_o.trigm <= data[1:0];
        RegExten:   control_o.exten <= data[1:0];
        RegOffline: control_o.offline <= data[0];
        RegStlen:   control_o.stlen <= data[6:0];
        RegStcfg:   control_o.stcfg <= data[2:0];
        RegStlvl:   control_o.stlvl <= data[8:0];
        default:    ;
      endcase
    end
  end

endmodule

`default_nettype wire
