// SPDX-License-Identifier: Apache-2.0
// Couples board time to wall time: on average, never faster than `speed` times real time. At most 2 ms of
// lost time is caught up.
#pragma once

#include <cstdint>
#include <time.h>

class Pace {
   public:
    // speed: board seconds per real second; 0: as fast as possible.
    Pace(uint64_t clk_hz, double speed) : per_clk_(1e9 / static_cast<double>(clk_hz)), speed_(speed) { rebase(0); }

    // Return the wall time in nanoseconds, from an arbitrary origin.
    static int64_t wall() {
        timespec t;
        clock_gettime(CLOCK_MONOTONIC, &t);
        return int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
    }

    // Sleep if cycle `now` is reached too early.
    void keep(uint64_t now) {
        const int64_t wall_now = wall();
        if (speed_ > 0) {
            const int64_t due = base_wall_ + static_cast<int64_t>(static_cast<double>(now - base_clk_) * per_clk_ / speed_);
            const int64_t early = due - wall_now;
            if (early > kGrain) {
                timespec nap{static_cast<time_t>(early / 1'000'000'000), static_cast<long>(early % 1'000'000'000)};
                nanosleep(&nap, nullptr);
            } else if (early < -kLag) {
                base_wall_ += -early - kLag;
            }
        }
        if (wall_now - mark_wall_ >= kWindow) {
            factor_ = static_cast<double>(now - mark_clk_) * per_clk_ / static_cast<double>(wall_now - mark_wall_);
            mark(now, wall_now);
        }
    }

    // Restart at cycle `now`, after a time that was not simulated.
    void rebase(uint64_t now) {
        base_clk_ = now;
        base_wall_ = wall();
        mark(now, base_wall_);
    }

    // Return the number of cycles that pass in `ns` of wall time; 0 if `speed` is 0.
    uint64_t clk_in(int64_t ns) const {
        return static_cast<uint64_t>(static_cast<double>(ns) * speed_ / per_clk_);
    }

    // Return board time / wall time, measured over about half a second.
    double factor() const { return factor_; }

   private:
    static constexpr int64_t kGrain = 100'000;      // ns; a shorter sleep is not worth a system call
    static constexpr int64_t kLag = 2'000'000;      // ns; more lost time than this is not caught up
    static constexpr int64_t kWindow = 500'000'000;

    void mark(uint64_t now, int64_t wall_now) {
        mark_clk_ = now;
        mark_wall_ = wall_now;
    }

    double per_clk_, speed_, factor_ = 1.0;
    uint64_t base_clk_ = 0, mark_clk_ = 0;
    int64_t base_wall_ = 0, mark_wall_ = 0;
};
