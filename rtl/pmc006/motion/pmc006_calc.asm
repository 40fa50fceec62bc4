; SPDX-License-Identifier: Apache-2.0
; Program of the motion planner of the PMC006B4: planning of a motion, update tick, current compensation.
; Rules:  P006-MOT-10..23, P006-MOT-30/31, P006-MOT-40..42, P006-MOT-50/51, P006-EXC-20..23.
; `make rom` writes pmc006_calc_rom.sv and the entry points in pmc006_calc_pkg.sv from this file; `make lint`
; compares them.
;
; hi and lo are the accumulator pair of pmc006_calc, 32 bits each. pmc006_calc_pkg defines the names of words
; (M…), constants (K…), registers (R…), conditions, outputs and phases.
;
;   load X           hi = X, no carry
;   add X            hi = hi + X; Carry: overflow
;   sub X            hi = hi - X; Carry: X <= hi before
;   load.lo, add.lo, sub.lo    as load, add and sub, but the result is in lo, and hi = 0
;   mul.N X          {hi, lo} = (hi + X * (lowest N bits of lo)) << (32 - N), plus lo >> N; N = 1, 2, 16, 32.
;                    After mul.16, RMid = hi before + X * (lowest 16 bits of lo)
;   shift.N          {hi, lo} = {hi, lo} >> N; the same as mul.N K0
;   div X            lo = {hi, lo} / X, hi = remainder
;   add.dec, sub.dec, div.dec  as add, sub and div, but RWay uses the deceleration coefficient nd
;   root             Vn = square root of lo; hi and Vn must be 0 before
;   store M          word M = hi
;   out O            output O = hi; out Acc, out Dec: increment the coefficient na, nd
;   set …            phase=P, up=0|1, smooth=0|1: shape of the ramp; set over: the ramp has ended
;   jump L [if C]    continue at label L if condition C is true; without a condition, always
;   halt             end of the run
;
; Abbreviations: V current speed, Vn next speed, LT live target, VE = VSTOP, R steps left, na, nd the
; coefficients.

; ---- entry points of a start and of an update tick: the labels Entry… are written to the package

EntryPlan:
        jump Plan
EntryTick:
        jump Advance

; ---- a motion has been accepted: V = VSTART

Plan:
        load RLeft              ; R is stable only until 6 cycles after the start
        store MLeft

Target: ; live target
        jump TargetAdc if Analog
        load RVmax              ; LT = VMAX
        jump TargetDone
TargetAdc:
        load RAdc               ; h << 6
        add.lo RAdc9            ; (h + h[9]) << 6: the largest h selects VMAX
        mul.32 RVmax
        load RMid               ; LT = VMAX * (h + h[9]) / 1024
TargetDone:
        jump PlanTarget if Plan
        sub MLt                 ; new ramp if the target has changed
        jump Walk if Zero
        add MLt
        store MLt               ; the new target
        sub RV
        jump Reached if Zero    ; the target equals the current speed
        set phase=Ramp up=1 smooth=1
        jump Straight if Analog
Retarget:                       ; hi = LT - V, with its carry
        jump Coef if Carry
        set up=0                ; downwards: height V - LT
        load RV
        sub MLt
        jump Coef
Straight:
        set smooth=0            ; an analog target is followed without S-curve
        jump Retarget
Reached:
        set phase=Cruise        ; no ramp is needed
        jump Walk

PlanTarget: ; hi = target at the beginning of the planning
        store MLt
        jump PlanShort if Short
        sub RV
        jump PlanFast if Carry
        load MLt                ; below VSTART: move at the target speed
        out Speed
        jump Cruise
PlanFast:
        jump PlanFree if Speed  ; speed mode has no distance to keep
        load MLt
        sub RVe
        jump PlanFree if NotCarry ; below VSTOP: no deceleration
        load MLt                ; distances of both ramps at the set coefficients
        add RV
        store MT                ; LT + V
        load MLt
        sub.lo RV               ; LT - V
        mul.16 MT
        load RMid               ; LT^2 - V^2
        add RWay
        sub.lo K1               ; to round up
        div RWay
        load RLo
        store MWay1             ; acceleration distance
        load MLt                ; the deceleration distance follows

Way:    ; distance from speed hi down to VSTOP
        store MX
        add RVe
        store MT                ; hi + VE
        load MX
        sub.lo RVe              ; hi - VE
        mul.16 MT
        load RMid               ; hi^2 - VE^2
        add.dec RWay
        sub.lo K1               ; to round up
        div.dec RWay
        load MX
        load RMargin            ; margin(hi)
        jump PlanWay if Plan
        add RLo                 ; stopping distance
        sub MLeft
        jump Fit if Carry       ; begin to decelerate
        jump Target
PlanWay:
        add K3
        store MSlack            ; margin(LT) + 3
        load RLo
        store MWay2             ; deceleration distance

PlanNeed: ; if both distances do not fit, use steeper ramps, up to 5
        load MWay1
        add MWay2
        add MSlack
        sub RLeft               ; Carry: the ramps need more steps than are left
        jump PlanFree if NotCarry
        jump PlanDec if Acc5
        out Acc                 ; na + 1 halves the distance
        load MWay1
        add K1                  ; rounded up
        shift.1
        store MWay1
        jump PlanNeed if Dec5
        jump PlanDecMore
PlanDec:
        jump PlanPeak if Dec5
PlanDecMore:
        out Dec                 ; nd + 1 halves the deceleration distance
        load MWay2
        add K1                  ; rounded up
        shift.1
        store MWay2
        jump PlanNeed

PlanPeak: ; too short even at 5: reduce the peak speed
        load.lo RV
        mul.16 RV
        load RMid               ; V^2
        store MT
        load.lo RVe
        load MT
        mul.16 RVe
        load RMid               ; V^2 + VE^2
        shift.1
        store MT                ; half of the sum
        load RLeft
        sub MSlack
        sub K1
        store MX                ; steps for both ramps
        load.lo K54400          ; the steepest acceleration, 1700 << 5
        load MT
        mul.16 MX
        load.lo RMid            ; square of the peak speed
        out Next                ; Vn = 0 for the root
        root
        load RRoot              ; 4 * Vn + 1
        shift.2
        store MT                ; peak speed
        load MLt
        sub MT
        jump PlanFree if NotCarry ; above the target: use the target
        load MT
        jump PlanGoal
PlanFree:
        load MLt                ; up to the target

PlanGoal: ; hi = speed to reach, not below V
        sub RV
        jump Cruise if Zero     ; already reached
        set phase=Ramp          ; up and smooth were set by the start
        jump Coef

PlanShort: ; fewer than 256 steps: one straight ramp to VSTOP
        load RVe
        sub RV
        jump Cruise if Zero     ; VSTART = VSTOP: no ramp
        set phase=Ramp smooth=0
        jump Coef if Carry      ; upwards
        set up=0
        load RV                 ; downwards
        sub RVe
        jump Coef
Cruise:
        set phase=Cruise
Planned:
        load RV
        out Next                ; the first interval has the current speed
        halt

; ---- ramp of height hi from V: increment for its coefficient

Coef:
        store MDv               ; height
        load.lo K100
        mul.16 MDv
        load RMid
        store MT                ; 100 * height
        load.lo K0              ; lo = 0
        load RRate              ; 17 << coefficient
        sub MT
        jump CoefWhole if Carry ; the complete ramp in one update
        add MT
        div MT                  ; 2^32 * rate / (100 * height)
        load RLo
        jump Ramp
CoefWhole:
        load K0                 ; represents 2^32

Ramp:   ; hi = increment; the ramp begins at V
        store MDu
        load RV
        store MV1               ; first speed
        load K0
        store MU                ; no progress yet
        jump RampPlanned if Plan
        jump Walk
RampPlanned:
        jump Fit if Short       ; VSTOP must be reached within the steps
        jump Planned

; ---- increment of a ramp from V to VSTOP within the steps left

Fit:
        load MLeft
        sub K4
        jump FitSome if Carry
        load K0                 ; fewer than 4 steps left
FitSome:
        add K1
        store MX                ; max(1, R - 3)
        load.lo K20000
        mul.16 MX
        load RMid
        store MT                ; 20000 * steps
        load.lo K0              ; lo = 0
        load RV
        add RVe
        div MT                  ; 2^32 * (V + VE) / (20000 * steps)
        jump FitExact if Zero
        load K1                 ; to round up
FitExact:
        add RLo
        store MT                ; increment
        jump FitShort if Plan
        set phase=Dec up=0 smooth=1
        load RV
        sub RVe
        store MDv               ; height
        load MT
        jump Ramp
FitShort: ; the greater of the two increments
        load MDu
        jump Planned if Zero    ; 2^32 is the greater increment
        sub MT
        jump Planned if Carry
        load MT
        store MDu
        jump Planned

; ---- an update tick

Advance:
        load RLeft              ; R of this tick
        store MLeft
        jump Stopping if Ending
        jump Live if Live
        jump Walk               ; DEC, CREEP: no decision
Stopping:
        jump Walk if Stop       ; the stop request is still active
        set phase=Cruise        ; the stop request was withdrawn
        load RV
        store MLt               ; evaluate the target again
Live:
        jump Stop if Stop
        jump Target if Speed    ; no distance to keep
        load RVe
        sub RV
        jump Target if Carry    ; not above VSTOP: no deceleration
        load RV
        jump Way                ; check whether to decelerate
Stop:
        load RVe
        sub RV
        jump Stopped if Carry   ; slow enough to stop immediately
        set phase=Stop up=0 smooth=1
        load RV
        sub RVe                 ; height
        jump Coef
Stopped:
        set phase=End           ; continue with the next speed

; ---- the next speed

Walk:
        jump Climb if Ramp
        jump Compensate if Ending ; Vn is unchanged
        load RV
        out Next                ; Vn = V
        jump Compensate
Climb:
        load MDu
        jump Climbed if Zero    ; 2^32: the ramp ends with its first update
        add MU
        jump Climbed if Carry   ; progress has passed 2^32
        store MU
        shift.16
        store MX                ; x = progress / 2^16
        jump Smooth if Smooth
        load.lo K0              ; straight: x * 2^16
        load MX
        load.lo RMid            ; lo = fraction of the ramp, times 2^32
        jump Shaped
Smooth:                         ; (3 * x^2 * 2^16 - 2 * x^3) / 2^16
        load.lo MX
        mul.16 MX
        load RMid               ; x^2
        store MT
        load K3x2p16            ; 3 * 2^16
        sub MX
        sub.lo MX               ; 3 * 2^16 - 2 * x
        mul.32 MT
        load.lo RMid            ; lo = fraction of the ramp, times 2^32
Shaped:
        load K2p31              ; to round to the nearest
        mul.32 MDv              ; hi = height * fraction / 2^32
        jump Apply
Climbed:
        set over                ; phase after the ramp
        load MDv                ; full height
Apply:                          ; hi = change of speed since the start of the ramp
        store MT
        load MV1
        jump ApplyUp if Up
        sub MT
        jump Applied
ApplyUp:
        add MT
Applied:
        out Next                ; Vn

; ---- full-step speed, base code, Bn and Wn

Compensate:
        load.lo RV
        div RMstep
        load RLo
        store MX                ; full-step speed, steps/s
        load.lo RBase
        mul.16 RCcomp
        load RMid               ; RB * CCOMP
        store MT
        load.lo MX
        mul.16 MT
        out CurrentComp         ; Bn = speed * RB * CCOMP / 2^22
        load.lo MX
        mul.16 RScomp
        out LeadAngle           ; Wn = speed * SCOMP / 2^16, at most 64
        halt
