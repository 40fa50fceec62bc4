// SPDX-License-Identifier: Apache-2.0
// Pins of ppmc2104_carrier for the virtual board.
#pragma once

#include "axes.h"

constexpr unsigned kAxes = 2;
constexpr unsigned kAllAxes = 3;

using Motors = PulseMotors;

inline unsigned motion_pins(const Vboard& top) { return top.pout_n; }

inline void idle_inputs(Vboard& top) {
    top.cs_n = top.ds_wrs_n = top.rw_rds_n = 1;
    top.errint_n = 1;
    top.run = top.csel = kAllAxes;
}

inline void set_switches(Vboard& top, const Plant (&plants)[kAxes]) {
    const auto bits = [&](bool Plant::*active) {
        return static_cast<CData>(!(plants[0].*active) | !(plants[1].*active) << 1);
    };
    top.fl_n = bits(&Plant::l1);
    top.bl_n = bits(&Plant::l2);
    top.fhl_n = bits(&Plant::l3);
    top.bhl_n = bits(&Plant::l4);
    top.org_n = bits(&Plant::cnp);
    top.alm_n = bits(&Plant::alm);
}

inline unsigned phases(const Vboard& top, unsigned axis) { return axis ? top.s2 : top.s1; }

inline void encoder_low(Vboard&) {}
inline void encoder_pulse(Vboard&, bool) {}
inline bool interrupt(const Vboard& top) { return !top.int_n; }
