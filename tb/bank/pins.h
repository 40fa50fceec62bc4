// SPDX-License-Identifier: Apache-2.0
// Pins of ppmc_bank_carrier for the virtual board; BOARD_AXES is its parameter AXES.
#pragma once

#include <type_traits>

#include "axes.h"

constexpr unsigned kAxes = BOARD_AXES;
constexpr AxisBits kAllAxes = ~AxisBits{0} >> (64 - kAxes);

using Motors = PulseMotors;

inline AxisBits motion_pins(const Vboard& top) { return top.pout_n; }

inline void idle_inputs(Vboard& top) {
    top.spi_cs_n = 1;
    top.sck = top.mosi = 0;
}

inline void set_switches(Vboard& top, const Plant (&plants)[kAxes]) {
    const auto bits = [&](auto& port, bool Plant::*active) {
        AxisBits all = 0;
        for (unsigned n = 0; n < kAxes; ++n) all |= AxisBits{!(plants[n].*active)} << n;
        port = static_cast<std::decay_t<decltype(port)>>(all);
    };
    bits(top.l1_n, &Plant::l1);
    bits(top.l2_n, &Plant::l2);
    bits(top.l3_n, &Plant::l3);
    bits(top.l4_n, &Plant::l4);
    bits(top.cnp_n, &Plant::cnp);
    bits(top.alm_n, &Plant::alm);
}

// Five bits per axis. Verilator stores up to 64 bits in one number, and more bits in 32-bit words.
template <class Port>
unsigned five_bits(const Port& port, unsigned from) {
    if constexpr (std::is_integral_v<Port>) {
        return static_cast<unsigned>(port >> from) & 31;
    } else {
        unsigned value = 0;
        for (unsigned n = 0; n < 5; ++n) value |= (port[(from + n) / 32] >> (from + n) % 32 & 1) << n;
        return value;
    }
}

inline unsigned phases(const Vboard& top, unsigned axis) { return five_bits(top.s, 5 * axis); }

inline void encoder_low(Vboard&) {}
inline void encoder_pulse(Vboard&, bool) {}
inline bool interrupt(const Vboard& top) { return !top.int_n; }
