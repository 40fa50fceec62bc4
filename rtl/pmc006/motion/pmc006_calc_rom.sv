// SPDX-License-Identifier: Apache-2.0
// pmc006_calc_rom: ROM with the program of the motion planner: planning, update tick, current compensation.
// Rules:  P006-MOT-10..23, P006-MOT-30/31, P006-MOT-40..42, P006-MOT-50/51, P006-EXC-20..23.
// Timing: code_o follows fetch_i by one cycle and is stable until the next fetch_i.
// Note:   written by `make rom` from pmc006_calc.asm; change the program there.
`default_nettype none

module pmc006_calc_rom
  import pmc006_calc_pkg::*;
(
    input  wire logic       clk_i,
    input  wire logic       fetch_i,  // strobe: read the word at addr_i
    input  wire logic [8:0] addr_i,   // word address
    output instr_t          code_o    // word at addr_i of the last fetch_i
);

  (* rom_style = "block" *)
  instr_t rom[512];

  initial begin
    for (int unsigned i = CALC_ROM_WORDS; i < 512; i++) rom[i] = 17'h00010;  // halt
    rom[0]   = 17'h14002;  // EntryPlan: jump Plan
    rom[1]   = 17'h140c3;  // EntryTick: jump Advance
    rom[2]   = 17'h02042;  // Plan: load RLeft
    rom[3]   = 17'h08005;  // store MLeft
    rom[4]   = 17'h14e07;  // Target: jump TargetAdc if Analog
    rom[5]   = 17'h02043;  // load RVmax
    rom[6]   = 17'h1400b;  // jump TargetDone
    rom[7]   = 17'h02044;  // TargetAdc: load RAdc
    rom[8]   = 17'h04445;  // add.lo RAdc9
    rom[9]   = 17'h0a843;  // mul.32 RVmax
    rom[10]  = 17'h0204d;  // load RMid
    rom[11]  = 17'h1501d;  // TargetDone: jump PlanTarget if Plan
    rom[12]  = 17'h06000;  // sub MLt
    rom[13]  = 17'h146db;  // jump Walk if Zero
    rom[14]  = 17'h04000;  // add MLt
    rom[15]  = 17'h08000;  // store MLt
    rom[16]  = 17'h06040;  // sub RV
    rom[17]  = 17'h1461b;  // jump Reached if Zero
    rom[18]  = 17'h12e13;  // set phase=Ramp up=1 smooth=1
    rom[19]  = 17'h14e19;  // jump Straight if Analog
    rom[20]  = 17'h1428c;  // Retarget: jump Coef if Carry
    rom[21]  = 17'h12400;  // set up=0
    rom[22]  = 17'h02040;  // load RV
    rom[23]  = 17'h06000;  // sub MLt
    rom[24]  = 17'h1408c;  // jump Coef
    rom[25]  = 17'h12200;  // Straight: set smooth=0
    rom[26]  = 17'h14014;  // jump Retarget
    rom[27]  = 17'h12800;  // Reached: set phase=Cruise
    rom[28]  = 17'h140db;  // jump Walk
    rom[29]  = 17'h08000;  // PlanTarget: store MLt
    rom[30]  = 17'h1487f;  // jump PlanShort if Short
    rom[31]  = 17'h06040;  // sub RV
    rom[32]  = 17'h14224;  // jump PlanFast if Carry
    rom[33]  = 17'h02000;  // load MLt
    rom[34]  = 17'h10210;  // out Speed
    rom[35]  = 17'h14088;  // jump Cruise
    rom[36]  = 17'h14a7a;  // PlanFast: jump PlanFree if Speed
    rom[37]  = 17'h02000;  // load MLt
    rom[38]  = 17'h06041;  // sub RVe
    rom[39]  = 17'h1447a;  // jump PlanFree if NotCarry
    rom[40]  = 17'h02000;  // load MLt
    rom[41]  = 17'h04040;  // add RV
    rom[42]  = 17'h08006;  // store MT
    rom[43]  = 17'h02000;  // load MLt
    rom[44]  = 17'h06440;  // sub.lo RV
    rom[45]  = 17'h0a606;  // mul.16 MT
    rom[46]  = 17'h0204d;  // load RMid
    rom[47]  = 17'h04028;  // add RWay
    rom[48]  = 17'h06411;  // sub.lo K1
    rom[49]  = 17'h0c028;  // div RWay
    rom[50]  = 17'h0204c;  // load RLo
    rom[51]  = 17'h08008;  // store MWay1
    rom[52]  = 17'h02000;  // load MLt
    rom[53]  = 17'h08007;  // Way: store MX
    rom[54]  = 17'h04041;  // add RVe
    rom[55]  = 17'h08006;  // store MT
    rom[56]  = 17'h02007;  // load MX
    rom[57]  = 17'h06441;  // sub.lo RVe
    rom[58]  = 17'h0a606;  // mul.16 MT
    rom[59]  = 17'h0204d;  // load RMid
    rom[60]  = 17'h04228;  // add.dec RWay
    rom[61]  = 17'h06411;  // sub.lo K1
    rom[62]  = 17'h0c228;  // div.dec RWay
    rom[63]  = 17'h02007;  // load MX
    rom[64]  = 17'h0204e;  // load RMargin
    rom[65]  = 17'h15046;  // jump PlanWay if Plan
    rom[66]  = 17'h0404c;  // add RLo
    rom[67]  = 17'h06005;  // sub MLeft
    rom[68]  = 17'h142a3;  // jump Fit if Carry
    rom[69]  = 17'h14004;  // jump Target
    rom[70]  = 17'h04012;  // PlanWay: add K3
    rom[71]  = 17'h0800a;  // store MSlack
    rom[72]  = 17'h0204c;  // load RLo
    rom[73]  = 17'h08009;  // store MWay2
    rom[74]  = 17'h02008;  // PlanNeed: load MWay1
    rom[75]  = 17'h04009;  // add MWay2
    rom[76]  = 17'h0400a;  // add MSlack
    rom[77]  = 17'h06042;  // sub RLeft
    rom[78]  = 17'h1447a;  // jump PlanFree if NotCarry
    rom[79]  = 17'h15c57;  // jump PlanDec if Acc5
    rom[80]  = 17'h10810;  // out Acc
    rom[81]  = 17'h02008;  // load MWay1
    rom[82]  = 17'h04011;  // add K1
    rom[83]  = 17'h0a010;  // shift.1
    rom[84]  = 17'h08008;  // store MWay1
    rom[85]  = 17'h15e4a;  // jump PlanNeed if Dec5
    rom[86]  = 17'h14058;  // jump PlanDecMore
    rom[87]  = 17'h15e5e;  // PlanDec: jump PlanPeak if Dec5
    rom[88]  = 17'h10a10;  // PlanDecMore: out Dec
    rom[89]  = 17'h02009;  // load MWay2
    rom[90]  = 17'h04011;  // add K1
    rom[91]  = 17'h0a010;  // shift.1
    rom[92]  = 17'h08009;  // store MWay2
    rom[93]  = 17'h1404a;  // jump PlanNeed
    rom[94]  = 17'h02440;  // PlanPeak: load.lo RV
    rom[95]  = 17'h0a640;  // mul.16 RV
    rom[96]  = 17'h0204d;  // load RMid
    rom[97]  = 17'h08006;  // store MT
    rom[98]  = 17'h02441;  // load.lo RVe
    rom[99]  = 17'h02006;  // load MT
    rom[100] = 17'h0a641;  // mul.16 RVe
    rom[101] = 17'h0204d;  // load RMid
    rom[102] = 17'h0a010;  // shift.1
    rom[103] = 17'h08006;  // store MT
    rom[104] = 17'h02042;  // load RLeft
    rom[105] = 17'h0600a;  // sub MSlack
    rom[106] = 17'h06011;  // sub K1
    rom[107] = 17'h08007;  // store MX
    rom[108] = 17'h02416;  // load.lo K54400
    rom[109] = 17'h02006;  // load MT
    rom[110] = 17'h0a607;  // mul.16 MX
    rom[111] = 17'h0244d;  // load.lo RMid
    rom[112] = 17'h10010;  // out Next
    rom[113] = 17'h0e04f;  // root
    rom[114] = 17'h0204f;  // load RRoot
    rom[115] = 17'h0a210;  // shift.2
    rom[116] = 17'h08006;  // store MT
    rom[117] = 17'h02000;  // load MLt
    rom[118] = 17'h06006;  // sub MT
    rom[119] = 17'h1447a;  // jump PlanFree if NotCarry
    rom[120] = 17'h02006;  // load MT
    rom[121] = 17'h1407b;  // jump PlanGoal
    rom[122] = 17'h02000;  // PlanFree: load MLt
    rom[123] = 17'h06040;  // PlanGoal: sub RV
    rom[124] = 17'h14688;  // jump Cruise if Zero
    rom[125] = 17'h12810;  // set phase=Ramp
    rom[126] = 17'h1408c;  // jump Coef
    rom[127] = 17'h02041;  // PlanShort: load RVe
    rom[128] = 17'h06040;  // sub RV
    rom[129] = 17'h14688;  // jump Cruise if Zero
    rom[130] = 17'h12a10;  // set phase=Ramp smooth=0
    rom[131] = 17'h1428c;  // jump Coef if Carry
    rom[132] = 17'h12400;  // set up=0
    rom[133] = 17'h02040;  // load RV
    rom[134] = 17'h06041;  // sub RVe
    rom[135] = 17'h1408c;  // jump Coef
    rom[136] = 17'h12800;  // Cruise: set phase=Cruise
    rom[137] = 17'h02040;  // Planned: load RV
    rom[138] = 17'h10010;  // out Next
    rom[139] = 17'h00010;  // halt
    rom[140] = 17'h08004;  // Coef: store MDv
    rom[141] = 17'h02414;  // load.lo K100
    rom[142] = 17'h0a604;  // mul.16 MDv
    rom[143] = 17'h0204d;  // load RMid
    rom[144] = 17'h08006;  // store MT
    rom[145] = 17'h02410;  // load.lo K0
    rom[146] = 17'h02020;  // load RRate
    rom[147] = 17'h06006;  // sub MT
    rom[148] = 17'h14299;  // jump CoefWhole if Carry
    rom[149] = 17'h04006;  // add MT
    rom[150] = 17'h0c006;  // div MT
    rom[151] = 17'h0204c;  // load RLo
    rom[152] = 17'h1409a;  // jump Ramp
    rom[153] = 17'h02010;  // CoefWhole: load K0
    rom[154] = 17'h08002;  // Ramp: store MDu
    rom[155] = 17'h02040;  // load RV
    rom[156] = 17'h08003;  // store MV1
    rom[157] = 17'h02010;  // load K0
    rom[158] = 17'h08001;  // store MU
    rom[159] = 17'h150a1;  // jump RampPlanned if Plan
    rom[160] = 17'h140db;  // jump Walk
    rom[161] = 17'h148a3;  // RampPlanned: jump Fit if Short
    rom[162] = 17'h14089;  // jump Planned
    rom[163] = 17'h02005;  // Fit: load MLeft
    rom[164] = 17'h06013;  // sub K4
    rom[165] = 17'h142a7;  // jump FitSome if Carry
    rom[166] = 17'h02010;  // load K0
    rom[167] = 17'h04011;  // FitSome: add K1
    rom[168] = 17'h08007;  // store MX
    rom[169] = 17'h02415;  // load.lo K20000
    rom[170] = 17'h0a607;  // mul.16 MX
    rom[171] = 17'h0204d;  // load RMid
    rom[172] = 17'h08006;  // store MT
    rom[173] = 17'h02410;  // load.lo K0
    rom[174] = 17'h02040;  // load RV
    rom[175] = 17'h04041;  // add RVe
    rom[176] = 17'h0c006;  // div MT
    rom[177] = 17'h146b3;  // jump FitExact if Zero
    rom[178] = 17'h02011;  // load K1
    rom[179] = 17'h0404c;  // FitExact: add RLo
    rom[180] = 17'h08006;  // store MT
    rom[181] = 17'h150bc;  // jump FitShort if Plan
    rom[182] = 17'h12e15;  // set phase=Dec up=0 smooth=1
    rom[183] = 17'h02040;  // load RV
    rom[184] = 17'h06041;  // sub RVe
    rom[185] = 17'h08004;  // store MDv
    rom[186] = 17'h02006;  // load MT
    rom[187] = 17'h1409a;  // jump Ramp
    rom[188] = 17'h02002;  // FitShort: load MDu
    rom[189] = 17'h14689;  // jump Planned if Zero
    rom[190] = 17'h06006;  // sub MT
    rom[191] = 17'h14289;  // jump Planned if Carry
    rom[192] = 17'h02006;  // load MT
    rom[193] = 17'h08002;  // store MDu
    rom[194] = 17'h14089;  // jump Planned
    rom[195] = 17'h02042;  // Advance: load RLeft
    rom[196] = 17'h08005;  // store MLeft
    rom[197] = 17'h152c8;  // jump Stopping if Ending
    rom[198] = 17'h156cc;  // jump Live if Live
    rom[199] = 17'h140db;  // jump Walk
    rom[200] = 17'h14cdb;  // Stopping: jump Walk if Stop
    rom[201] = 17'h12800;  // set phase=Cruise
    rom[202] = 17'h02040;  // load RV
    rom[203] = 17'h08000;  // store MLt
    rom[204] = 17'h14cd3;  // Live: jump Stop if Stop
    rom[205] = 17'h14a04;  // jump Target if Speed
    rom[206] = 17'h02041;  // load RVe
    rom[207] = 17'h06040;  // sub RV
    rom[208] = 17'h14204;  // jump Target if Carry
    rom[209] = 17'h02040;  // load RV
    rom[210] = 17'h14035;  // jump Way
    rom[211] = 17'h02041;  // Stop: load RVe
    rom[212] = 17'h06040;  // sub RV
    rom[213] = 17'h142da;  // jump Stopped if Carry
    rom[214] = 17'h12e19;  // set phase=Stop up=0 smooth=1
    rom[215] = 17'h02040;  // load RV
    rom[216] = 17'h06041;  // sub RVe
    rom[217] = 17'h1408c;  // jump Coef
    rom[218] = 17'h12808;  // Stopped: set phase=End
    rom[219] = 17'h154e0;  // Walk: jump Climb if Ramp
    rom[220] = 17'h15301;  // jump Compensate if Ending
    rom[221] = 17'h02040;  // load RV
    rom[222] = 17'h10010;  // out Next
    rom[223] = 17'h14101;  // jump Compensate
    rom[224] = 17'h02002;  // Climb: load MDu
    rom[225] = 17'h146f8;  // jump Climbed if Zero
    rom[226] = 17'h04001;  // add MU
    rom[227] = 17'h142f8;  // jump Climbed if Carry
    rom[228] = 17'h08001;  // store MU
    rom[229] = 17'h0a610;  // shift.16
    rom[230] = 17'h08007;  // store MX
    rom[231] = 17'h15aec;  // jump Smooth if Smooth
    rom[232] = 17'h02410;  // load.lo K0
    rom[233] = 17'h02007;  // load MX
    rom[234] = 17'h0244d;  // load.lo RMid
    rom[235] = 17'h140f5;  // jump Shaped
    rom[236] = 17'h02407;  // Smooth: load.lo MX
    rom[237] = 17'h0a607;  // mul.16 MX
    rom[238] = 17'h0204d;  // load RMid
    rom[239] = 17'h08006;  // store MT
    rom[240] = 17'h02017;  // load K3x2p16
    rom[241] = 17'h06007;  // sub MX
    rom[242] = 17'h06407;  // sub.lo MX
    rom[243] = 17'h0a806;  // mul.32 MT
    rom[244] = 17'h0244d;  // load.lo RMid
    rom[245] = 17'h02018;  // Shaped: load K2p31
    rom[246] = 17'h0a804;  // mul.32 MDv
    rom[247] = 17'h140fa;  // jump Apply
    rom[248] = 17'h13000;  // Climbed: set over
    rom[249] = 17'h02004;  // load MDv
    rom[250] = 17'h08006;  // Apply: store MT
    rom[251] = 17'h02003;  // load MV1
    rom[252] = 17'h158ff;  // jump ApplyUp if Up
    rom[253] = 17'h06006;  // sub MT
    rom[254] = 17'h14100;  // jump Applied
    rom[255] = 17'h04006;  // ApplyUp: add MT
    rom[256] = 17'h10010;  // Applied: out Next
    rom[257] = 17'h02440;  // Compensate: load.lo RV
    rom[258] = 17'h0c049;  // div RMstep
    rom[259] = 17'h0204c;  // load RLo
    rom[260] = 17'h08007;  // store MX
    rom[261] = 17'h02446;  // load.lo RBase
    rom[262] = 17'h0a647;  // mul.16 RCcomp
    rom[263] = 17'h0204d;  // load RMid
    rom[264] = 17'h08006;  // store MT
    rom[265] = 17'h02407;  // load.lo MX
    rom[266] = 17'h0a606;  // mul.16 MT
    rom[267] = 17'h10410;  // out CurrentComp
    rom[268] = 17'h02407;  // load.lo MX
    rom[269] = 17'h0a648;  // mul.16 RScomp
    rom[270] = 17'h10610;  // out LeadAngle
    rom[271] = 17'h00010;  // halt
  end

  always_ff @(posedge clk_i) if (fetch_i) code_o <= rom[addr_i];

endmodule

`default_nettype wire
