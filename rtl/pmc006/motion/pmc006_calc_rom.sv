// SPDX-License-Identifier: Apache-2.0
// pmc006_calc_rom: the planner's program: planning of a motion, the update tick, compensation.
// Rules:  P006-MOT-10..23, P006-MOT-30/31, P006-MOT-40..42, P006-MOT-50/51, P006-EXC-20..23, section 5.5.
// Entry:  address 0 with a start, 1 with an update tick.
// Timing: code_o is the word of addr_i one clk later, while fetch_i.
// Note:   a part of the program is named by its first address (pmc006_calc_pkg); a part that grows changes the
//         next address only.
`default_nettype none

module pmc006_calc_rom
  import pmc006_calc_pkg::*;
(
    input  wire logic       clk_i,
    input  wire logic       fetch_i,
    input  wire logic [8:0] addr_i,
    output instr_t          code_o
);

  (* rom_style = "block" *)
  instr_t rom[512];

  initial begin
    for (int unsigned i = 0; i < 512; i++) rom[i] = code(OpHalt, Plain, K0);
    // ---- where a start and an update tick enter
    rom[AtEntry+0] = jump(Always, AtPlan);
    rom[AtEntry+1] = jump(Always, AtAdvance);
    // ---- a motion has been accepted: V = VSTART
    rom[AtPlan+0] = code(OpLoad, Plain, RLeft);
    rom[AtPlan+1] = code(OpStore, Plain, MLeft);
    // live target
    rom[AtTarget+0] = jump(IfAnalog, AtTargetAdc);
    rom[AtTarget+1] = code(OpLoad, Plain, RVmax);
    rom[AtTarget+2] = jump(Always, AtTargetDone);
    rom[AtTargetAdc+0] = code(OpLoad, Plain, RAdc);
    rom[AtTargetAdc+1] = code(OpAdd, Low, RAdc9);  // (h + h[9]) << 6
    rom[AtTargetAdc+2] = code(OpMul, N32, RVmax);
    rom[AtTargetAdc+3] = code(OpLoad, Plain, RMid);
    rom[AtTargetDone+0] = jump(IfPlan, AtPlanTarget);
    rom[AtTargetDone+1] = code(OpSub, Plain, MLt);  // retarget if it has changed
    rom[AtTargetDone+2] = jump(IfZero, AtWalk);
    rom[AtTargetDone+3] = code(OpAdd, Plain, MLt);
    rom[AtTargetDone+4] = code(OpStore, Plain, MLt);
    rom[AtTargetDone+5] = code(OpSub, Plain, RV);
    rom[AtTargetDone+6] = jump(IfZero, AtReached);
    rom[AtTargetDone+7] = set(4'b0111, PhRamp, 2'b11);
    rom[AtTargetDone+8] = jump(IfAnalog, AtStraight);
    rom[AtRetarget+0] = jump(IfCarry, AtCoef);
    rom[AtRetarget+1] = set(4'b0010, PhCruise, 2'b00);
    rom[AtRetarget+2] = code(OpLoad, Plain, RV);
    rom[AtRetarget+3] = code(OpSub, Plain, MLt);
    rom[AtRetarget+4] = jump(Always, AtCoef);
    rom[AtStraight+0] = set(4'b0001, PhCruise, 2'b00);
    rom[AtStraight+1] = jump(Always, AtRetarget);
    rom[AtReached+0] = set(4'b0100, PhCruise, 2'b00);
    rom[AtReached+1] = jump(Always, AtWalk);
    rom[AtPlanTarget+0] = code(OpStore, Plain, MLt);
    rom[AtPlanTarget+1] = jump(IfShort, AtPlanShort);
    rom[AtPlanTarget+2] = code(OpSub, Plain, RV);
    rom[AtPlanTarget+3] = jump(IfCarry, AtPlanFast);
    rom[AtPlanTarget+4] = code(OpLoad, Plain, MLt);  // below VSTART: the target itself, all the way
    rom[AtPlanTarget+5] = code(OpOut, OutSpeed, K0);
    rom[AtPlanTarget+6] = jump(Always, AtCruise);
    rom[AtPlanFast+0] = jump(IfSpeed, AtPlanFree);
    rom[AtPlanFast+1] = code(OpLoad, Plain, MLt);
    rom[AtPlanFast+2] = code(OpSub, Plain, RVe);
    rom[AtPlanFast+3] = jump(IfNotCarry, AtPlanFree);
    rom[AtPlanFast+4] = code(OpLoad, Plain, MLt);  // ways of both ramps at the coefficients set
    rom[AtPlanFast+5] = code(OpAdd, Plain, RV);
    rom[AtPlanFast+6] = code(OpStore, Plain, MT);
    rom[AtPlanFast+7] = code(OpLoad, Plain, MLt);
    rom[AtPlanFast+8] = code(OpSub, Low, RV);
    rom[AtPlanFast+9] = code(OpMul, N16, MT);
    rom[AtPlanFast+10] = code(OpLoad, Plain, RMid);
    rom[AtPlanFast+11] = code(OpAdd, Plain, RWay);
    rom[AtPlanFast+12] = code(OpSub, Low, K1);
    rom[AtPlanFast+13] = code(OpDiv, Plain, RWay);
    rom[AtPlanFast+14] = code(OpLoad, Plain, RLo);
    rom[AtPlanFast+15] = code(OpStore, Plain, MWay1);
    rom[AtPlanFast+16] = code(OpLoad, Plain, MLt);
    // way from speed hi down to VSTOP
    rom[AtWay+0] = code(OpStore, Plain, MX);
    rom[AtWay+1] = code(OpAdd, Plain, RVe);
    rom[AtWay+2] = code(OpStore, Plain, MT);
    rom[AtWay+3] = code(OpLoad, Plain, MX);
    rom[AtWay+4] = code(OpSub, Low, RVe);
    rom[AtWay+5] = code(OpMul, N16, MT);
    rom[AtWay+6] = code(OpLoad, Plain, RMid);
    rom[AtWay+7] = code(OpAdd, Dec, RWay);
    rom[AtWay+8] = code(OpSub, Low, K1);
    rom[AtWay+9] = code(OpDiv, Dec, RWay);
    rom[AtWay+10] = code(OpLoad, Plain, MX);
    rom[AtWay+11] = code(OpLoad, Plain, RMargin);
    rom[AtWay+12] = jump(IfPlan, AtPlanWay);
    rom[AtWay+13] = code(OpAdd, Plain, RLo);
    rom[AtWay+14] = code(OpSub, Plain, MLeft);
    rom[AtWay+15] = jump(IfCarry, AtFit);
    rom[AtWay+16] = jump(Always, AtTarget);
    rom[AtPlanWay+0] = code(OpStore, Plain, MSlack);
    rom[AtPlanWay+1] = code(OpLoad, Plain, RLo);
    rom[AtPlanWay+2] = code(OpStore, Plain, MWay2);
    rom[AtPlanNeed+0] = code(OpLoad, Plain, MWay1);
    rom[AtPlanNeed+1] = code(OpAdd, Plain, MWay2);
    rom[AtPlanNeed+2] = code(OpAdd, Plain, MSlack);
    rom[AtPlanNeed+3] = code(OpAdd, Plain, K3);
    rom[AtPlanNeed+4] = code(OpSub, Plain, RLeft);  // carry: need > N
    rom[AtPlanNeed+5] = jump(IfNotCarry, AtPlanFree);
    rom[AtPlanNeed+6] = jump(IfAcc5, AtPlanDec);
    rom[AtPlanNeed+7] = code(OpOut, OutAcc, K0);  // na + 1 halves the way
    rom[AtPlanNeed+8] = code(OpLoad, Plain, MWay1);
    rom[AtPlanNeed+9] = code(OpAdd, Plain, K1);
    rom[AtPlanNeed+10] = code(OpMul, N1, K0);
    rom[AtPlanNeed+11] = code(OpStore, Plain, MWay1);
    rom[AtPlanNeed+12] = jump(IfDec5, AtPlanNeed);
    rom[AtPlanNeed+13] = jump(Always, AtPlanDecMore);
    rom[AtPlanDec+0] = jump(IfDec5, AtPlanPeak);
    rom[AtPlanDecMore+0] = code(OpOut, OutDec, K0);
    rom[AtPlanDecMore+1] = code(OpLoad, Plain, MWay2);
    rom[AtPlanDecMore+2] = code(OpAdd, Plain, K1);
    rom[AtPlanDecMore+3] = code(OpMul, N1, K0);
    rom[AtPlanDecMore+4] = code(OpStore, Plain, MWay2);
    rom[AtPlanDecMore+5] = jump(Always, AtPlanNeed);
    // too short even so: the peak speed is lowered
    rom[AtPlanPeak+0] = code(OpLoad, Low, RV);
    rom[AtPlanPeak+1] = code(OpMul, N16, RV);
    rom[AtPlanPeak+2] = code(OpLoad, Plain, RMid);
    rom[AtPlanPeak+3] = code(OpStore, Plain, MT);
    rom[AtPlanPeak+4] = code(OpLoad, Low, RVe);
    rom[AtPlanPeak+5] = code(OpLoad, Plain, MT);
    rom[AtPlanPeak+6] = code(OpMul, N16, RVe);
    rom[AtPlanPeak+7] = code(OpLoad, Plain, RMid);
    rom[AtPlanPeak+8] = code(OpMul, N1, K0);
    rom[AtPlanPeak+9] = code(OpStore, Plain, MT);
    rom[AtPlanPeak+10] = code(OpLoad, Plain, RLeft);
    rom[AtPlanPeak+11] = code(OpSub, Plain, MSlack);
    rom[AtPlanPeak+12] = code(OpSub, Plain, K4);
    rom[AtPlanPeak+13] = code(OpStore, Plain, MX);
    rom[AtPlanPeak+14] = code(OpLoad, Low, K54400);
    rom[AtPlanPeak+15] = code(OpLoad, Plain, MT);
    rom[AtPlanPeak+16] = code(OpMul, N16, MX);
    rom[AtPlanPeak+17] = code(OpLoad, Low, RMid);
    rom[AtPlanPeak+18] = code(OpOut, OutNext, K0);  // 0
    rom[AtPlanPeak+19] = code(OpRoot, Plain, RRoot);
    rom[AtPlanPeak+20] = code(OpLoad, Plain, RRoot);
    rom[AtPlanPeak+21] = code(OpMul, N2, K0);
    rom[AtPlanPeak+22] = code(OpStore, Plain, MT);
    rom[AtPlanPeak+23] = code(OpLoad, Plain, MLt);
    rom[AtPlanPeak+24] = code(OpSub, Plain, MT);
    rom[AtPlanPeak+25] = jump(IfNotCarry, AtPlanFree);
    rom[AtPlanPeak+26] = code(OpLoad, Plain, MT);
    rom[AtPlanPeak+27] = jump(Always, AtPlanGoal);
    rom[AtPlanFree+0] = code(OpLoad, Plain, MLt);
    // hi = speed to go to, not below V
    rom[AtPlanGoal+0] = code(OpSub, Plain, RV);
    rom[AtPlanGoal+1] = jump(IfZero, AtCruise);
    rom[AtPlanGoal+2] = set(4'b0100, PhRamp, 2'b00);
    rom[AtPlanGoal+3] = jump(Always, AtCoef);
    // fewer than 256 steps: one straight ramp to VSTOP
    rom[AtPlanShort+0] = code(OpLoad, Plain, RVe);
    rom[AtPlanShort+1] = code(OpSub, Plain, RV);
    rom[AtPlanShort+2] = jump(IfZero, AtCruise);
    rom[AtPlanShort+3] = set(4'b0101, PhRamp, 2'b00);
    rom[AtPlanShort+4] = jump(IfCarry, AtCoef);
    rom[AtPlanShort+5] = set(4'b0010, PhCruise, 2'b00);
    rom[AtPlanShort+6] = code(OpLoad, Plain, RV);
    rom[AtPlanShort+7] = code(OpSub, Plain, RVe);
    rom[AtPlanShort+8] = jump(Always, AtCoef);
    rom[AtCruise+0] = set(4'b0100, PhCruise, 2'b00);
    rom[AtPlanned+0] = code(OpLoad, Plain, RV);
    rom[AtPlanned+1] = code(OpOut, OutNext, K0);
    rom[AtPlanned+2] = code(OpHalt, Plain, K0);
    // ---- ramp of height hi from V on: the increment of its coefficient
    rom[AtCoef+0] = code(OpStore, Plain, MDv);
    rom[AtCoef+1] = code(OpLoad, Low, K100);
    rom[AtCoef+2] = code(OpMul, N16, MDv);
    rom[AtCoef+3] = code(OpLoad, Plain, RMid);
    rom[AtCoef+4] = code(OpStore, Plain, MT);
    rom[AtCoef+5] = code(OpLoad, Low, K0);
    rom[AtCoef+6] = code(OpLoad, Plain, RRate);
    rom[AtCoef+7] = code(OpSub, Plain, MT);
    rom[AtCoef+8] = jump(IfCarry, AtCoefWhole);
    rom[AtCoef+9] = code(OpAdd, Plain, MT);
    rom[AtCoef+10] = code(OpDiv, Plain, MT);
    rom[AtCoef+11] = code(OpLoad, Plain, RLo);
    rom[AtCoef+12] = jump(Always, AtRamp);
    rom[AtCoefWhole+0] = code(OpLoad, Plain, K0);  // 2^32
    rom[AtRamp+0] = code(OpStore, Plain, MDu);
    rom[AtRamp+1] = code(OpLoad, Plain, RV);
    rom[AtRamp+2] = code(OpStore, Plain, MV1);
    rom[AtRamp+3] = code(OpLoad, Plain, K0);
    rom[AtRamp+4] = code(OpStore, Plain, MU);
    rom[AtRamp+5] = jump(IfPlan, AtRampPlanned);
    rom[AtRamp+6] = jump(Always, AtWalk);
    rom[AtRampPlanned+0] = jump(IfShort, AtFit);
    rom[AtRampPlanned+1] = jump(Always, AtPlanned);
    // ---- increment of a ramp from V to VSTOP within the steps left
    rom[AtFit+0] = code(OpLoad, Plain, MLeft);
    rom[AtFit+1] = code(OpSub, Plain, K4);
    rom[AtFit+2] = jump(IfCarry, AtFitSome);
    rom[AtFit+3] = code(OpLoad, Plain, K0);
    rom[AtFitSome+0] = code(OpAdd, Plain, K1);
    rom[AtFitSome+1] = code(OpStore, Plain, MX);  // max(1, R - 3)
    rom[AtFitSome+2] = code(OpLoad, Low, K20000);
    rom[AtFitSome+3] = code(OpMul, N16, MX);
    rom[AtFitSome+4] = code(OpLoad, Plain, RMid);
    rom[AtFitSome+5] = code(OpStore, Plain, MT);
    rom[AtFitSome+6] = code(OpLoad, Low, K0);
    rom[AtFitSome+7] = code(OpLoad, Plain, RV);
    rom[AtFitSome+8] = code(OpAdd, Plain, RVe);
    rom[AtFitSome+9] = code(OpDiv, Plain, MT);
    rom[AtFitSome+10] = jump(IfZero, AtFitExact);
    rom[AtFitSome+11] = code(OpLoad, Plain, K1);
    rom[AtFitExact+0] = code(OpAdd, Plain, RLo);
    rom[AtFitExact+1] = code(OpStore, Plain, MT);
    rom[AtFitExact+2] = jump(IfPlan, AtFitShort);
    rom[AtFitExact+3] = set(4'b0111, PhDec, 2'b01);
    rom[AtFitExact+4] = code(OpLoad, Plain, RV);
    rom[AtFitExact+5] = code(OpSub, Plain, RVe);
    rom[AtFitExact+6] = code(OpStore, Plain, MDv);
    rom[AtFitExact+7] = code(OpLoad, Plain, MT);
    rom[AtFitExact+8] = jump(Always, AtRamp);
    // the greater of both increments
    rom[AtFitShort+0] = code(OpLoad, Plain, MDu);
    rom[AtFitShort+1] = jump(IfZero, AtPlanned);
    rom[AtFitShort+2] = code(OpSub, Plain, MT);
    rom[AtFitShort+3] = jump(IfCarry, AtPlanned);
    rom[AtFitShort+4] = code(OpLoad, Plain, MT);
    rom[AtFitShort+5] = code(OpStore, Plain, MDu);
    rom[AtFitShort+6] = jump(Always, AtPlanned);
    // ---- an update tick
    rom[AtAdvance+0] = code(OpLoad, Plain, RLeft);
    rom[AtAdvance+1] = code(OpStore, Plain, MLeft);
    rom[AtAdvance+2] = jump(IfEnding, AtStopping);
    rom[AtAdvance+3] = jump(IfLive, AtLive);
    rom[AtAdvance+4] = jump(Always, AtWalk);
    rom[AtStopping+0] = jump(IfStop, AtWalk);
    rom[AtStopping+1] = set(4'b0100, PhCruise, 2'b00);  // the stop request is withdrawn
    rom[AtStopping+2] = code(OpLoad, Plain, RV);
    rom[AtStopping+3] = code(OpStore, Plain, MLt);
    rom[AtLive+0] = jump(IfStop, AtStop);
    rom[AtLive+1] = jump(IfSpeed, AtTarget);
    rom[AtLive+2] = code(OpLoad, Plain, RVe);
    rom[AtLive+3] = code(OpSub, Plain, RV);
    rom[AtLive+4] = jump(IfCarry, AtTarget);
    rom[AtLive+5] = code(OpLoad, Plain, RV);
    rom[AtLive+6] = jump(Always, AtWay);
    rom[AtStop+0] = code(OpLoad, Plain, RVe);
    rom[AtStop+1] = code(OpSub, Plain, RV);
    rom[AtStop+2] = jump(IfCarry, AtStopped);
    rom[AtStop+3] = set(4'b0111, PhStop, 2'b01);
    rom[AtStop+4] = code(OpLoad, Plain, RV);
    rom[AtStop+5] = code(OpSub, Plain, RVe);
    rom[AtStop+6] = jump(Always, AtCoef);
    rom[AtStopped+0] = set(4'b0100, PhEnd, 2'b00);
    // ---- the next speed
    rom[AtWalk+0] = jump(IfRamp, AtClimb);
    rom[AtWalk+1] = jump(IfEnding, AtCompensate);
    rom[AtWalk+2] = code(OpLoad, Plain, RV);
    rom[AtWalk+3] = code(OpOut, OutNext, K0);
    rom[AtWalk+4] = jump(Always, AtCompensate);
    rom[AtClimb+0] = code(OpLoad, Plain, MDu);
    rom[AtClimb+1] = jump(IfZero, AtClimbed);
    rom[AtClimb+2] = code(OpAdd, Plain, MU);
    rom[AtClimb+3] = jump(IfCarry, AtClimbed);
    rom[AtClimb+4] = code(OpStore, Plain, MU);
    rom[AtClimb+5] = code(OpMul, N16, K0);
    rom[AtClimb+6] = code(OpStore, Plain, MX);
    rom[AtClimb+7] = jump(IfSmooth, AtSmooth);
    rom[AtClimb+8] = code(OpLoad, Low, K0);  // straight
    rom[AtClimb+9] = code(OpLoad, Plain, MX);
    rom[AtClimb+10] = code(OpLoad, Low, RMid);
    rom[AtClimb+11] = jump(Always, AtShaped);
    rom[AtSmooth+0] = code(OpLoad, Low, MX);
    rom[AtSmooth+1] = code(OpMul, N16, MX);
    rom[AtSmooth+2] = code(OpLoad, Plain, RMid);
    rom[AtSmooth+3] = code(OpStore, Plain, MT);
    rom[AtSmooth+4] = code(OpLoad, Plain, K3x2p16);
    rom[AtSmooth+5] = code(OpSub, Plain, MX);
    rom[AtSmooth+6] = code(OpSub, Low, MX);
    rom[AtSmooth+7] = code(OpMul, N32, MT);
    rom[AtSmooth+8] = code(OpLoad, Low, RMid);
    rom[AtShaped+0] = code(OpLoad, Plain, K2p31);
    rom[AtShaped+1] = code(OpMul, N32, MDv);
    rom[AtShaped+2] = jump(Always, AtApply);
    rom[AtClimbed+0] = set(4'b1000, PhCruise, 2'b00);
    rom[AtClimbed+1] = code(OpLoad, Plain, MDv);
    rom[AtApply+0] = code(OpStore, Plain, MT);
    rom[AtApply+1] = code(OpLoad, Plain, MV1);
    rom[AtApply+2] = jump(IfUp, AtApplyUp);
    rom[AtApply+3] = code(OpSub, Plain, MT);
    rom[AtApply+4] = jump(Always, AtApplied);
    rom[AtApplyUp+0] = code(OpAdd, Plain, MT);
    rom[AtApplied+0] = code(OpOut, OutNext, K0);
    // ---- full-step speed, base code, Bn and Wn
    rom[AtCompensate+0] = code(OpLoad, Low, RV);
    rom[AtCompensate+1] = code(OpDiv, Plain, RMstep);
    rom[AtCompensate+2] = code(OpLoad, Plain, RLo);
    rom[AtCompensate+3] = code(OpStore, Plain, MX);
    rom[AtCompensate+4] = code(OpLoad, Plain, RCur);
    rom[AtCompensate+5] = code(OpSub, Low, K325);
    rom[AtCompensate+6] = code(OpDiv, Plain, K150);
    rom[AtCompensate+7] = code(OpLoad, Low, RLo);
    rom[AtCompensate+8] = code(OpLoad, Plain, K416);
    rom[AtCompensate+9] = code(OpMul, N16, K153);
    rom[AtCompensate+10] = code(OpLoad, Plain, RMid);
    rom[AtCompensate+11] = code(OpMul, N4, K0);
    rom[AtCompensate+12] = code(OpAdd, Low, K0);
    rom[AtCompensate+13] = code(OpMul, N16, RCcomp);
    rom[AtCompensate+14] = code(OpLoad, Plain, RMid);
    rom[AtCompensate+15] = code(OpStore, Plain, MT);
    rom[AtCompensate+16] = code(OpLoad, Low, MX);
    rom[AtCompensate+17] = code(OpMul, N16, MT);
    rom[AtCompensate+18] = code(OpOut, OutBump, K0);
    rom[AtCompensate+19] = code(OpLoad, Low, MX);
    rom[AtCompensate+20] = code(OpMul, N16, RScomp);
    rom[AtCompensate+21] = code(OpOut, OutLead, K0);
    rom[AtCompensate+22] = code(OpHalt, Plain, K0);
  end

  always_ff @(posedge clk_i) if (fetch_i) code_o <= rom[addr_i];

endmodule

`default_nettype wire
