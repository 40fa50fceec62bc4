// SPDX-License-Identifier: Apache-2.0
// Definitions that the pins.h of several devices share. The pins.h of a device (tb/<device>/) connects the
// virtual board to the ports of its carrier, axis by axis. Ports of two axes are one number, in which bit 0
// is axis 1. Each pins.h defines kAxes and kAllAxes, motion_pins, Motors, idle_inputs, set_switches, phases,
// encoder_low, encoder_pulse and interrupt.
#pragma once

#include <cstdint>

#include "Vboard.h"
#include "plant.h"

using AxisBits = uint64_t;  // one bit per axis; bit 0 is axis 1

// Motors that step at the falling edges of POUT*, one motor per axis.
class PulseMotors {
   public:
    // Return the axes whose motors step between two values of motion_pins(). ccw() returns the direction.
    AxisBits steps(AxisBits before, AxisBits now) { return before & ~now; }
    template <class Top>
    bool ccw(const Top& top, unsigned axis) const {
        return top.dir >> axis & 1;
    }
};

// The five switches of a device with one axis on a byte bus. The pins.h of the device sets the alarm.
template <class Top>
void set_limits(Top& top, const Plant& plant) {
    top.l1_n = !plant.l1;
    top.l2_n = !plant.l2;
    top.l3_n = !plant.l3;
    top.l4_n = !plant.l4;
    top.cnp_n = !plant.cnp;
}
