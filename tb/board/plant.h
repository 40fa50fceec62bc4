// SPDX-License-Identifier: Apache-2.0
// What the board is screwed to: a motor that follows every pulse, limit and origin switches, a drive with an alarm.
// Positions are pulses, CW positive.
#pragma once

#include <cstdint>
#include <optional>

struct PlantText {
    int64_t start = 4000;
    int64_t cw = 40000;        // L1 active at and above
    int64_t ccw = -400;        // L2 active at and below
    int64_t slow_cw = 38000;   // L3 active at and above
    int64_t slow_ccw = 600;    // L4 active at and below
    int64_t origin = 0;        // CNP active at and below
    std::optional<int64_t> alarm_from, alarm_to;  // ALM active from … to
};

class Plant {
   public:
    explicit Plant(const PlantText& text = {}) : text_(text), position_(text.start) { look(); }

    // A falling edge of POUT, or a step of the phases; `dir` = 0 turns CW.
    void pulse(bool dir) {
        position_ += dir ? -1 : 1;
        ++pulses_;
        look();
    }

    int64_t position() const { return position_; }
    uint64_t pulses() const { return pulses_; }

    // Switches, true = active (pin low).
    bool l1, l2, l3, l4, cnp, alm;

   private:
    void look();

    PlantText text_;
    int64_t position_;
    uint64_t pulses_ = 0;
};
