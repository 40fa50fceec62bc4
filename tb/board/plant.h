// SPDX-License-Identifier: Apache-2.0
// Plant model of the board: a motor that follows every pulse, limit and origin switches, a drive with an
// alarm. Positions are in pulses, CW positive.
#pragma once

#include <cstdint>
#include <optional>

struct PlantText {
    int64_t start = 4000;
    int64_t cw = 40000;        // L1 active at and above
    int64_t ccw = -400;        // L2 active at and below
    int64_t slow_cw = 38000;   // L3 active at and above
    int64_t slow_ccw = 600;    // L4 active at and below
    int64_t origin = 0;        // CNP active at and below this position,
    int64_t origin_from = INT64_MIN;  // and at and above this position: a cam
    int64_t index = 0;         // the index is active once per this number of pulses, at kIndexAt; 0: never
    std::optional<int64_t> block;  // CW end stop of the shaft
    std::optional<int64_t> alarm_from, alarm_to;  // ALM active between these positions
};

class Plant {
   public:
    explicit Plant(const PlantText& text = {}) : text_(text), position_(text.start) { look(); }

    // Make a pulse, or a step of the phases; `dir` = 0 turns CW. Return false if the shaft cannot follow.
    bool pulse(bool dir) {
        ++pulses_;
        if (!dir && text_.block && position_ >= *text_.block) return false;
        position_ += dir ? -1 : 1;
        look();
        return true;
    }

    int64_t position() const { return position_; }
    uint64_t pulses() const { return pulses_; }

    // Switches, true = active (pin low).
    bool l1, l2, l3, l4, cnp, alm, index;

   private:
    static constexpr int64_t kIndexAt = -20;
    void look();

    PlantText text_;
    int64_t position_;
    uint64_t pulses_ = 0;
};
