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
    int64_t origin = 0;        // CNP active at and below,
    int64_t origin_from = INT64_MIN;  // and from here on: a cam
    int64_t index = 0;         // the encoder's index is active once in so many pulses, at kIndexAt; 0: never
    std::optional<int64_t> block;  // what the axle cannot pass CW
    std::optional<int64_t> alarm_from, alarm_to;  // ALM active from … to
};

class Plant {
   public:
    explicit Plant(const PlantText& text = {}) : text_(text), position_(text.start) { look(); }

    // A pulse, or a step of the phases; `dir` = 0 turns CW. False if the axle cannot follow.
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
