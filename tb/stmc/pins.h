// SPDX-License-Identifier: Apache-2.0
// Pins of stmc_carrier for the virtual board.
#pragma once

#include "axes.h"
#include "steps.h"

constexpr unsigned kAxes = 1;
constexpr unsigned kAllAxes = 1;

// There is no pulse output, so the motor follows the phases.
inline unsigned motion_pins(const Vboard& top) { return top.s; }

class Motors {
   public:
    // Return whether the motor steps between two values of motion_pins(). ccw() returns the direction.
    unsigned steps(unsigned, unsigned now) {
        step_ = phases_.step(now);
        return step_ != 0;
    }
    bool ccw(const Vboard&, unsigned) const { return step_ < 0; }

   private:
    PhaseSteps phases_;
    int step_ = 0;
};

inline void idle_inputs(Vboard& top) { top.cs_n = top.rd_n = top.wr_n = 1; }

inline void set_switches(Vboard& top, const Plant (&plants)[kAxes]) {
    set_limits(top, plants[0]);
    top.mon = !plants[0].alm;
}

inline unsigned phases(const Vboard& top, unsigned) { return top.s; }

inline void encoder_low(Vboard&) {}
inline void encoder_pulse(Vboard&, bool) {}
inline bool interrupt(const Vboard& top) { return !top.int_n; }
