// SPDX-License-Identifier: Apache-2.0
// The ports of the Verilated top by axis. BOARD_PART is the number of the part on the board; ports of two axes are
// one number, bit 0 = axis 1.
#pragma once

#include "Vboard.h"
#include "plant.h"
#include "steps.h"

#ifndef BOARD_PART
#error "BOARD_PART must be the number of the part"
#endif

constexpr unsigned kAxes = BOARD_PART == 2104 ? 2 : 1;
constexpr unsigned kAllAxes = (1u << kAxes) - 1;

#if BOARD_PART == 105

// No pulse output: the motor follows the phases.
inline unsigned motion_pins(const Vboard& top) { return top.s; }

class Motors {
   public:
    // Between two motion_pins(): the axes whose motors step; ccw() tells which way.
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

#elif BOARD_PART == 312

inline unsigned motion_pins(const Vboard& top) { return top.pout; }

class Motors {
   public:
    unsigned steps(unsigned before, unsigned now) { return now & ~before; }
    bool ccw(const Vboard& top, unsigned) const { return top.dir; }
};

#else

inline unsigned motion_pins(const Vboard& top) { return top.pout_n; }

class Motors {
   public:
    unsigned steps(unsigned before, unsigned now) { return before & ~now; }
    bool ccw(const Vboard& top, unsigned axis) const { return top.dir >> axis & 1; }
};

#endif

#if BOARD_PART == 2104

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

#elif BOARD_PART == 312

inline void idle_inputs(Vboard& top) {
    top.cs_n = top.oe_n = top.we_n = 1;
    top.run = top.evt0_n = top.evt1_n = 1;
    top.auxi = 0xFF;
    top.end_n = 0;  // the drive says at once that it is where it shall be
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

#else

inline void set_switches(Vboard& top, const Plant (&plants)[kAxes]) {
    const Plant& plant = plants[0];
    top.l1_n = !plant.l1;
    top.l2_n = !plant.l2;
    top.l3_n = !plant.l3;
    top.l4_n = !plant.l4;
    top.cnp_n = !plant.cnp;
#if BOARD_PART == 105
    top.mon = !plant.alm;
#else
    top.alm_n = !plant.alm;
#endif
}

inline unsigned phases(const Vboard& top, unsigned) { return top.s; }

#endif

// An encoder gives a pulse as long as that of the motor for each one that the axle follows.
#if BOARD_PART == 312
inline void encoder_low(Vboard& top) { top.epin = 0; }
inline void encoder_pulse(Vboard& top, bool ccw) {
    top.epdir = ccw;
    top.epin = 1;
}
inline bool interrupt(const Vboard& top) { return !top.irq_n; }
#else
inline void encoder_low(Vboard&) {}
inline void encoder_pulse(Vboard&, bool) {}
inline bool interrupt(const Vboard& top) { return !top.int_n; }
#endif

#if BOARD_PART == 104

inline void idle_inputs(Vboard& top) {
    top.cs_n = top.rd_n = top.wr_n = 1;
    top.csel = top.vsel = 1;
}

#endif
