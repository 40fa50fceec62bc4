// SPDX-License-Identifier: Apache-2.0
// The stations of a line: objects of one Verilated class, with the interface of a single part (part.h). Bit k of each
// port belongs to station k. Included by the pins.h of a line, which accesses the pins of one station.
//
// An idle station sleeps: if its state and its outputs are the same after kPeriod cycles, they repeat until an input
// changes. Then only the rest of a period is simulated. Counters that run freely without an effect are not compared:
// these are the bytes that change in a station after power-on and a character for another station. While a station
// receives or moves, busy() is true, because the counters have an effect then. Sleep changes no edge:
// tests/common/web compares the edges of all stations with golden models.
#pragma once

#include <cstring>
#include <memory>

#include "part.h"

class Stations {
   public:
    explicit Stations(VerilatedContext* context) {
        for (uint32_t n = 0; n < kStations; ++n) {
            all_[n].part = std::make_unique<Vpart>(context);
            set_levels(*all_[n].part, n);
        }
        find_counters(context);
    }

    void power_on() {
        for (uint32_t n = 0; n < kStations; ++n) {
            ::power_on(*all_[n].part);
            take(n);
        }
    }

    void set_input(uint32_t pin, uint32_t value) {
        const uint32_t changed = now_ ? value ^ inputs_[pin] : ~0u;
        inputs_[pin] = value;
        for (uint32_t n = 0; n < kStations; ++n) {
            if (!(changed >> n & 1)) continue;
            wake(all_[n]);
            set_bit(*all_[n].part, pin, value >> n & 1);
        }
    }

    void set_reset(bool level) {
        for (Station& one : all_) {
            wake(one);
            one.part->rst_n = level;
        }
    }

    void settle() {
        for (uint32_t n = 0; n < kStations; ++n) {
            all_[n].part->eval();
            take(n);
        }
    }

    void rise() {
        ++now_;
        for (uint32_t n = 0; n < kStations; ++n) {
            Station& one = all_[n];
            if (one.asleep) continue;
            clock(one);
            take(n);
            ++one.quiet;
            if (one.quiet == kSettled) {
                std::memcpy(one.before, one.part->rootp, sizeof one.before);
            } else if (one.quiet == kSettled + kPeriod) {
                one.quiet = 0;
                one.asleep = !busy(*one.part) && repeats(one);
                one.since = now_;
            }
        }
    }

    void get_outputs(uint32_t* to) const { std::memcpy(to, outputs_, sizeof outputs_); }

   private:
    static constexpr uint32_t kSettled = 256;  // cycles without a change of an input or output
    struct Station {
        std::unique_ptr<Vpart> part;
        uint32_t bits = 0, quiet = 0;
        bool asleep = false;
        uint64_t since = 0;  // begin of the sleep
        char before[sizeof(Vpart___024root)];
    };

    static void clock(Station& one) {
        ::rise(*one.part);
        rearm(*one.part);
    }

    bool repeats(const Station& one) const {
        const char* const now = reinterpret_cast<const char*>(one.part->rootp);
        if (!std::memcmp(one.before, now, sizeof one.before)) return true;
        for (size_t n = 0; n < sizeof one.before; ++n)
            if (one.before[n] != now[n] && !free_[n]) return false;
        return true;
    }

    // Find the bytes of counters that run freely in an idle station.
    void find_counters(VerilatedContext* context) {
        Station one;
        one.part = std::make_unique<Vpart>(context);
        set_levels(*one.part, 0);
        for (uint32_t pin = 0; pin < kInputs; ++pin) set_bit(*one.part, pin, kIdle[pin] & 1);
        ::power_on(*one.part);
        one.part->rst_n = 0;
        clock(one);
        one.part->rst_n = 1;
        const auto run = [&one](uint32_t cycles) {
            while (cycles--) clock(one);
        };
        const auto receive = [&](uint32_t level, uint32_t bits) {
            set_bit(*one.part, kRxd, level);
            run(bits * kBit);
        };
        run(kPeriod);
        receive(0, 1);  // start bit of the character 81
        receive(1, 1);
        receive(0, 6);
        receive(1, 4);
        for (uint32_t turn = 0; turn < 4; ++turn) {
            std::memcpy(one.before, one.part->rootp, sizeof one.before);
            run(kPeriod);
            const char* const now = reinterpret_cast<const char*>(one.part->rootp);
            for (size_t n = 0; n < sizeof one.before; ++n) free_[n] |= one.before[n] != now[n];
        }
    }

    void wake(Station& one) {
        one.quiet = 0;
        if (!one.asleep) return;
        one.asleep = false;
        for (uint64_t left = (now_ - one.since) % kPeriod; left; --left) clock(one);
    }

    void take(uint32_t n) {
        const uint32_t bits = get_bits(*all_[n].part), changed = bits ^ all_[n].bits;
        if (!changed) return;
        for (uint32_t left = changed; left; left &= left - 1) outputs_[__builtin_ctz(left)] ^= 1u << n;
        all_[n].bits = bits;
        all_[n].quiet = 0;
    }

    Station all_[kStations];
    bool free_[sizeof(Vpart___024root)] = {};  // bytes of counters without an effect in an idle station
    uint64_t now_ = 0;  // rising edges since power-on
    uint32_t inputs_[kInputs] = {}, outputs_[kOutputs] = {};
};

inline void power_on(Stations& top) { top.power_on(); }
inline void set_input(Stations& top, uint32_t pin, uint32_t value) { top.set_input(pin, value); }
inline void get_outputs(const Stations& top, uint32_t* to) { top.get_outputs(to); }
inline void rise(Stations& top) { top.rise(); }
inline void rearm(Stations&) {}
inline void set_reset(Stations& top, bool level) { top.set_reset(level); }
inline void settle(Stations& top) { top.settle(); }
