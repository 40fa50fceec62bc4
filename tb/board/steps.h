// SPDX-License-Identifier: Apache-2.0
// Determines the steps of a motor from the levels of its phases S5..S1: 3, 4 or 5 phases, full or half steps,
// both polarities. The sequences of all motors are defined here, independently of the step counter of the
// board.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

class PhaseSteps {
   public:
    PhaseSteps() {
        for (unsigned phases = 3; phases <= 5; ++phases) {
            for (const bool half : {false, true}) {
                std::vector<unsigned> ring;
                for (unsigned n = 0; n < phases; ++n) {
                    const unsigned a = 1u << n, b = 1u << (n + 1) % phases, c = 1u << (n + 2) % phases;
                    ring.push_back(a | b);
                    if (half) ring.push_back(phases == 5 ? a | b | c : b);
                }
                for (std::size_t n = 0; n < ring.size(); ++n) {
                    const unsigned from = ring[n], to = ring[(n + 1) % ring.size()];
                    at(from, to) = at(~from, ~to) = 1;
                    at(to, from) = at(~to, ~from) = -1;
                }
            }
        }
    }

    // Update the levels of the phases. Return 1 for a CW step, -1 for a CCW step, 0 for no step. While all
    // levels are equal (chopper, or no excitation yet), the motor does not move.
    int step(unsigned levels) {
        levels &= kAll;
        if (levels == 0 || levels == kAll) return 0;
        const int moved = at(levels_, levels);
        levels_ = levels;
        return moved;
    }

   private:
    static constexpr unsigned kAll = 31;
    signed char& at(unsigned from, unsigned to) { return table_[(from & kAll) << 5 | (to & kAll)]; }

    std::array<signed char, 1024> table_{};
    unsigned levels_ = 0;
};
