// SPDX-License-Identifier: Apache-2.0
// Waits for the pulses (or steps) of a simulated motor, and prints them.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

struct Pulse {
    uint64_t clk;
    bool ccw;
};

// Run the bus cycle by cycle until `count` pulses are recorded. After 1 s at 16 MHz, the program ends.
template <class Bus>
void run_pulses(Bus& bus, unsigned count) {
    constexpr uint64_t kLimit = 16'000'000;
    for (uint64_t n = 0; bus.pulses.size() < count; ++n) {
        if (n == kLimit) {
            std::printf("FAIL only %zu pulses of %u\n", bus.pulses.size(), count);
            std::exit(1);
        }
        bus.clk();
    }
}

// Print "name cw=… ccw=… at t t t …", and discard the pulses.
inline void print_pulses(const char* name, std::vector<Pulse>& pulses) {
    unsigned ccw = 0;
    for (const Pulse& pulse : pulses) ccw += pulse.ccw;
    std::printf("%s cw=%zu ccw=%u at", name, pulses.size() - ccw, ccw);
    for (const Pulse& pulse : pulses) std::printf(" %llu", static_cast<unsigned long long>(pulse.clk));
    std::printf("\n");
    pulses.clear();
}
