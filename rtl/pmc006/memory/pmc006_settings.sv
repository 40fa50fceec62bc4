// SPDX-License-Identifier: Apache-2.0
// pmc006_settings: the parameter registers.
// Rules:  section 3.0, P006-CMD-04..50, P006-MOT-52, P006-PRG section 12.3 (EXTEN, VSET, ACC).
// Timing: registers; they change on the edge that ends the clk of write_i.
`default_nettype none

module pmc006_settings
  import pmc006_pkg::*;
(
    input  wire logic   clk_i,
    input  wire logic   rst_ni,
    input  wire order_t order_i,  // what is carried out
    input  wire logic   write_i,     // order_i is carried out, its data are legal
    output settings_t   settings_o,  // what motion and drive look at
    output control_t    control_o  // what only the control looks at
);

  logic [13:0] data;
  logic host, unused_bits;

  assign data = order_i.data[13:0];
  assign host = order_i.source == FromFrame;
  assign unused_bits = &{1'b0, order_i};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      settings_o <= SETTINGS_RESET;
      control_o  <= CONTROL_RESET;
    end else if (write_i) begin
      unique case (order_i.op)
        I_MSTEP:   settings_o.mstep <= data[7:0];
        I_CURRENT: settings_o.cur <= data[11:0];
        // 6 acts as 5.
        I_ACC:     settings_o.acc <= (data[2:0] == 3'd6) ? 3'd5 : data[2:0];
        I_DEC:     settings_o.dec <= data[2:0];
        I_AUTODEC: settings_o.autodec <= data[0];
        I_ATT:     settings_o.att <= data[2:0];
        I_VSTART:  settings_o.vstart <= data[11:0];
        I_VSTOP:   settings_o.vstop <= data[11:0];
        I_CCOMP:   settings_o.ccomp <= data[10:0];
        I_SCOMP:   settings_o.scomp <= data[10:0];
        I_VMAX: begin
          settings_o.vmax <= data;
          settings_o.regulate <= order_i.option[0];
        end
        I_DIR:     settings_o.dir <= data[0];
        I_FREE:    settings_o.free <= data[0];
        I_ADDR:    control_o.addr <= data[7:0];
        I_TRIGGER: control_o.trigm <= data[1:0];
        I_EXTEN:   control_o.exten <= host ? data[1:0] : {2{data[0]}};
        I_OFFLINE: control_o.offline <= data[0];
        I_STLEN:   control_o.stlen <= data[6:0];
        I_STCFG:   control_o.stcfg <= data[2:0];
        I_STLVL:   control_o.stlvl <= data[8:0];
        default:   ;
      endcase
    end
  end

endmodule

`default_nettype wire
