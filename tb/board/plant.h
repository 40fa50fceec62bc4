// SPDX-License-Identifier: Apache-2.0
// Plant model of the board. It consists of limit and origin switches, a drive with an alarm, and a motor that
// follows every pulse, except at an end stop. Positions are in pulses, CW positive.
#pragma once

#include <cstdint>
#include <optional>

struct PlantText {
    int64_t start = 4000;
    int64_t cw = 40000;        // L1 is active at this position and above
    int64_t ccw = -400;        // L2 is active at this position and below
    int64_t slow_cw = 38000;   // L3 is active at this position and above
    int64_t slow_ccw = 600;    // L4 is active at this position and below
    int64_t origin = 0;        // CNP is active from origin_from to this position
    int64_t origin_from = INT64_MIN;  // lowest position at which CNP is active (cam)
    int64_t index = 0;         // pulses between two active positions of the index, see kIndexAt; 0: never
    std::optional<int64_t> block;  // end stop of the shaft in CW direction
    std::optional<int64_t> alarm_from, alarm_to;  // ALM is active between these positions
};

class Plant {
   public:
    explicit Plant(const PlantText& text = {}) : text_(text), position_(text.start) { look(); }

    // Make one pulse, or one step of the phases; `dir` = 0 is CW. Return false if the shaft cannot follow.
    bool pulse(bool dir) {
        ++pulses_;
        if (!dir && text_.block && position_ >= *text_.block) return false;
        position_ += dir ? -1 : 1;
        look();
        return true;
    }

    int64_t position() const { return position_; }
    uint64_t pulses() const { return pulses_; }

    // Switches, true: active (pin low).
    bool l1, l2, l3, l4, cnp, alm, index;

   private:
    static constexpr int64_t kIndexAt = -20;
    void look();

    PlantText text_;
    int64_t position_;
    uint64_t pulses_ = 0;
};
