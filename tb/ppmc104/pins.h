// SPDX-License-Identifier: Apache-2.0
// Pins of ppmc104_carrier for the virtual board.
#pragma once

#include "axes.h"

constexpr unsigned kAxes = 1;
constexpr unsigned kAllAxes = 1;

using Motors = PulseMotors;

inline unsigned motion_pins(const Vboard& top) { return top.pout_n; }

inline void idle_inputs(Vboard& top) {
    top.cs_n = top.rd_n = top.wr_n = 1;
    top.csel = top.vsel = 1;
}

inline void set_switches(Vboard& top, const Plant (&plants)[kAxes]) {
    set_limits(top, plants[0]);
    top.alm_n = !plants[0].alm;
}

inline unsigned phases(const Vboard& top, unsigned) { return top.s; }

inline void encoder_low(Vboard&) {}
inline void encoder_pulse(Vboard&, bool) {}
inline bool interrupt(const Vboard& top) { return !top.int_n; }
