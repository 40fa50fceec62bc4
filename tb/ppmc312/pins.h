// SPDX-License-Identifier: Apache-2.0
// Pins of ppmc312_carrier for the virtual board. The drive has an encoder.
#pragma once

#include "axes.h"

constexpr unsigned kAxes = 1;
constexpr unsigned kAllAxes = 1;

inline unsigned motion_pins(const Vboard& top) { return top.pout; }

class Motors {
   public:
    // The motor steps at the rising edges of POUT.
    unsigned steps(unsigned before, unsigned now) { return now & ~before; }
    bool ccw(const Vboard& top, unsigned) const { return top.dir; }
};

inline void idle_inputs(Vboard& top) {
    top.cs_n = top.oe_n = top.we_n = 1;
    top.run = top.evt0_n = top.evt1_n = 1;
    top.auxi = 0xFF;
    top.end_n = 0;  // the drive always reports "in position"
}

inline void set_switches(Vboard& top, const Plant (&plants)[kAxes]) {
    const Plant& plant = plants[0];
    top.fl_n = !plant.l1;
    top.bl_n = !plant.l2;
    top.fhl_n = !plant.l3;
    top.bhl_n = !plant.l4;
    top.org_n = !plant.cnp;
    top.alm_n = !plant.alm;
    top.index_n = !plant.index;
}

inline unsigned phases(const Vboard&, unsigned) { return 0; }

// For each motor pulse that the shaft follows, the encoder outputs a pulse of the same length.
inline void encoder_low(Vboard& top) { top.epin = 0; }
inline void encoder_pulse(Vboard& top, bool ccw) {
    top.epdir = ccw;
    top.epin = 1;
}
inline bool interrupt(const Vboard& top) { return !top.irq_n; }
