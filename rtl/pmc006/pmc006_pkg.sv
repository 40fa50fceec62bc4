// SPDX-License-Identifier: Apache-2.0
// pmc006_pkg: instruction codes of the PMC006B4, and its registers with their factory values.
// Rules:  P006-CMD-01..57, P006-PRG-01/02/10..17/20/30..33; codes: docs/pmc006/README.md, 4, 13.
`default_nettype none

package pmc006_pkg;

  // A design uses only some of the items of this package.
  // verilator lint_off UNUSEDPARAM

  // ---- instruction codes (comment: ASCII); bit 7 = 0: frame, bit 7 = 1: only the user program ------------

  localparam logic [7:0] I_NONE = 8'h00;
  localparam logic [7:0] I_POINTER = 8'h41;  // A
  localparam logic [7:0] I_BURN = 8'h42;  // B
  localparam logic [7:0] I_TRY = 8'h45;  // E
  localparam logic [7:0] I_OFFLINE = 8'h46;  // F
  localparam logic [7:0] I_GET = 8'h47;  // G
  localparam logic [7:0] I_ABORT = 8'h49;  // I
  localparam logic [7:0] I_TRIGGER = 8'h4a;  // J
  localparam logic [7:0] I_TRIGGER_READ = 8'h4b;  // K
  localparam logic [7:0] I_VSTART = 8'h4c;  // L
  localparam logic [7:0] I_CCOMP = 8'h4d;  // M
  localparam logic [7:0] I_RUN = 8'h4e;  // N
  localparam logic [7:0] I_STATUS2 = 8'h4f;  // O
  localparam logic [7:0] I_SCOMP = 8'h50;  // P
  localparam logic [7:0] I_ATT = 8'h51;  // Q
  localparam logic [7:0] I_VERSION = 8'h52;  // R
  localparam logic [7:0] I_VSTOP = 8'h53;  // S
  localparam logic [7:0] I_STLEN = 8'h54;  // T
  localparam logic [7:0] I_ATT_READ = 8'h55;  // U
  localparam logic [7:0] I_STORED = 8'h56;  // V, which the old chip does not have
  localparam logic [7:0] I_PUT = 8'h57;  // W
  localparam logic [7:0] I_STPOS = 8'h58;  // X
  localparam logic [7:0] I_STCFG = 8'h59;  // Y
  localparam logic [7:0] I_STLVL = 8'h5a;  // Z
  localparam logic [7:0] I_AUTODEC = 8'h61;  // a
  localparam logic [7:0] I_CLEAR1 = 8'h62;  // b
  localparam logic [7:0] I_POS = 8'h63;  // c
  localparam logic [7:0] I_DIR = 8'h64;  // d
  localparam logic [7:0] I_CURRENT = 8'h65;  // e
  localparam logic [7:0] I_EXTEN = 8'h66;  // f
  localparam logic [7:0] I_FREE = 8'h67;  // g
  localparam logic [7:0] I_DEC_READ = 8'h68;  // h
  localparam logic [7:0] I_POS_SET = 8'h69;  // i
  localparam logic [7:0] I_STATUS1 = 8'h6a;  // j
  localparam logic [7:0] I_MSTEP_READ = 8'h6b;  // k
  localparam logic [7:0] I_CLEAR2 = 8'h6c;  // l
  localparam logic [7:0] I_MSTEP = 8'h6d;  // m
  localparam logic [7:0] I_CURRENT_READ = 8'h6e;  // n
  localparam logic [7:0] I_DEC = 8'h6f;  // o
  localparam logic [7:0] I_STALL = 8'h70;  // p
  localparam logic [7:0] I_VMAX_READ = 8'h71;  // q
  localparam logic [7:0] I_ACC_READ = 8'h72;  // r
  localparam logic [7:0] I_STEP = 8'h73;  // s
  localparam logic [7:0] I_SAVE = 8'h74;  // t
  localparam logic [7:0] I_ACC = 8'h75;  // u
  localparam logic [7:0] I_VMAX = 8'h76;  // v
  localparam logic [7:0] I_ADDR = 8'h77;  // w
  localparam logic [7:0] I_PORTS = 8'h78;  // x
  localparam logic [7:0] I_OUT = 8'h79;  // y
  localparam logic [7:0] I_START = 8'h7a;  // z

  localparam logic [7:0] P_END = 8'h80;
  localparam logic [7:0] P_CNTI = 8'h8b;
  localparam logic [7:0] P_CNTC = 8'h8c;
  localparam logic [7:0] P_JMP = 8'h8d;
  localparam logic [7:0] P_JNE = 8'h8e;
  localparam logic [7:0] P_JEQ = 8'h8f;
  localparam logic [7:0] P_WAIT = 8'h90;
  localparam logic [7:0] P_OUT = 8'h91;
  localparam logic [7:0] P_CMP = 8'h92;
  localparam logic [7:0] P_RESET_EN = 8'h93;
  localparam logic [7:0] P_PAUSE_EN = 8'h94;

  // Instruction code for an opcode of the user program: a frame code (I_…) or a program code (P_…).
  function automatic logic [7:0] program_op(logic [7:0] opcode);
    unique case (opcode)
      8'h01:   return I_STEP;
      8'h02:   return I_MSTEP;
      8'h03:   return I_DIR;
      8'h04:   return I_EXTEN;
      8'h05:   return I_FREE;
      8'h06:   return I_CLEAR2;
      8'h07:   return I_CLEAR1;
      8'h08:   return I_VMAX;
      8'h09:   return I_ACC;
      8'h0a:   return I_TRIGGER;
      default: return (opcode > 8'h14) ? P_END : {1'b1, opcode[6:0]};
    endcase
  endfunction

  // Source of an instruction.
  typedef enum logic [1:0] {
    FromFrame,
    FromProgram,
    FromTry,      // program instruction, executed by instruction E
    FromBoot      // parameter from the EEPROM
  } instr_source_e;

  // Instruction in progress.
  typedef struct packed {
    logic [7:0]    op;
    logic [3:0]    option;  // option of a program instruction, saturates at 15; 0 for other sources
    instr_source_e source;
    logic [31:0]   data;
  } exec_cmd_t;

  // ---- register numbers, which are the addresses in pmc006_reply_ram --------------------------------------

  // A reset of pmc006_reply_ram fills the addresses from 2 on.
  typedef enum logic [4:0] {
    RegMstep   = 5'd2,
    RegCurrent,
    RegAcc,
    RegDec,
    RegAutodec,
    RegAtt,
    RegVstart,
    RegVstop,
    RegCcomp,
    RegScomp,
    RegVmax,
    RegDir,
    RegFree,
    RegAddr,
    RegTrigger,
    RegExten,
    RegOffline,
    RegStlen,
    RegStcfg,
    RegStlvl,
    RegNone
  } register_e;

  // Register access of an instruction.
  typedef struct packed {
    logic      write;   // 1: write the register, 0: read the register for the reply
    register_e reg_id;
  } reg_access_t;

  // ---- signals between line, control, motion and drive --------------------------------------------------

  // Frame from the host. code and data are valid with go, and stable until a byte of the next frame is
  // received.
  typedef struct packed {
    logic        go;    // strobe: a valid frame is complete
    logic [7:0]  code;  // instruction code
    logic [31:0] data;  // data of the instruction
  } frame_t;

  // Start of a motion. Assumes: start and run are not high in the same cycle.
  typedef struct packed {
    logic        start;  // strobe (instruction s or ROT): make `count` steps
    logic [30:0] count;  // number of steps, at least 1; valid with start
    logic        run;    // strobe (instruction N 1 at standstill): run until stopped
    logic        speed;  // SPEED_MODE; 0: decelerate and end a speed run
  } motion_start_t;

  // State of the motion.
  typedef struct packed {
    logic busy;     // 1: a motion is in progress
    logic forward;  // direction of the current or last motion; 1: forward
    logic steady;   // 1: constant speed above 0; valid with busy
  } motion_status_t;

  // Values from the motion for the drive.
  typedef struct packed {
    logic [7:0]  increment;     // angle of a step, 512 per electrical turn
    logic [10:0] current_comp;  // current compensation B (P006-EXC-22)
    logic [6:0]  lead_angle;    // lead angle W (P006-EXC-23)
  } drive_cmd_t;

  // Sample of an A/D converter.
  typedef struct packed {
    logic       valid;  // strobe: level is new
    logic [9:0] level;  // sample; valid with `valid`
  } sample_t;

  localparam logic [6:0] PROGRAM_LAST_LINE = 7'd99;
  localparam logic [7:0] PROGRAM_WORDS = 8'd200;

  // ---- registers ------------------------------------------------------------------------------------------

  // Settings used by motion and drive.
  typedef struct packed {
    logic [7:0]  mstep;     // 0 (full step), 2, 4, 8, .. 128
    logic [11:0] cur;       // current in mA, 400 .. 4000
    logic [2:0]  acc;       // acceleration coefficient, 0 .. 5
    logic [2:0]  dec;       // deceleration coefficient, 0 .. 5
    logic        autodec;   // 1: reduce the current at standstill
    logic [2:0]  att;       // attenuation coefficient, 1 .. 4
    logic [11:0] vstart;    // start speed in pps, 65 .. 3000
    logic [11:0] vstop;     // stop speed in pps, 65 .. 3000
    logic [10:0] ccomp;     // current compensation, 100 .. 1200
    logic [10:0] scomp;     // speed compensation, 300 .. 2000
    logic [13:0] vmax;      // maximum speed in pps, 0 .. 16000
    logic        dir;       // 1: forward
    logic        regulate;  // 1: analog speed (VMAX scaled by the converter)
    logic        free;      // 1: motor released
  } motor_settings_t;

  localparam motor_settings_t SETTINGS_RESET = '{
      mstep: 8'd16,
      cur: 12'd800,
      acc: 3'd0,
      dec: 3'd0,
      autodec: 1'b1,
      att: 3'd1,
      vstart: 12'd600,
      vstop: 12'd600,
      ccomp: 11'd300,
      scomp: 11'd1250,
      vmax: 14'd1000,
      dir: 1'b1,
      regulate: 1'b0,
      free: 1'b0
  };

  // Settings used only by the control.
  typedef struct packed {
    logic [7:0] addr;     // address on the line, 1 .. 120 or 255
    logic [1:0] trigm;    // edge of the emergency input, 1: rising; [0]: EXT1, [1]: EXT2
    logic [1:0] exten;    // 1: emergency input enabled; [0]: EXT1, [1]: EXT2
    logic       offline;  // 1: start the user program after the boot
    logic [6:0] stlen;    // stall length in samples, 0 .. 63, or 64 (reset value)
    logic [2:0] stcfg;    // [0]: detect a stall, [1]: stop the motion, [2]: drive GPO5
    logic [8:0] stlvl;    // stall level, compared with the samples of the back EMF
  } control_settings_t;

  localparam control_settings_t CONTROL_RESET = '{
      addr: 8'hff,
      trigm: 2'b00,
      exten: 2'b00,
      offline: 1'b0,
      stlen: 7'd64,
      stcfg: 3'b000,
      stlvl: 9'd0
  };

  // verilator lint_on UNUSEDPARAM

endpackage

`default_nettype wire
