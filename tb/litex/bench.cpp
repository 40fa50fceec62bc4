// SPDX-License-Identifier: Apache-2.0
// Test bench of the LiteX SoC: clock, UART on the terminal, a pulse counter per motor, a limit switch.
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

#include "Vsoc.h"
#include "verilated.h"

namespace {

constexpr uint64_t kClks = 8'000'000;  // number of cycles; 0.5 s at 16 MHz
constexpr unsigned kToSwitch = 50;      // number of pulses after the line "switch"

// Counts the falling edges of pout_n, by the level of dir.
struct Motor {
    unsigned cw = 0, ccw = 0;
    bool last = true;

    void see(bool pout_n, bool dir) {
        if (last && !pout_n) ++(dir ? ccw : cw);
        last = pout_n;
    }
};

}  // namespace

int main(int argc, char** argv) {
    Verilated::commandArgs(argc, argv);
    Vsoc soc;
    std::string line;
    Motor part;
    std::array<Motor, 4> axes;
    bool armed = false, done = false;
    unsigned until = 0;
    soc.serial_source_ready = 1;
    soc.stepper_l1_n = 1;
    for (uint64_t now = 0; now < kClks && !done; ++now) {
        soc.sys_clk = 0;
        soc.eval();
        // The DUT samples this level at the next rising edge.
        const bool sent = soc.serial_source_valid;
        const char letter = static_cast<char>(soc.serial_source_data);
        soc.sys_clk = 1;
        soc.eval();
        part.see(soc.stepper_pout_n, soc.stepper_dir);
#ifdef WITH_BANK
        for (unsigned n = 0; n < axes.size(); ++n) {
            axes[n].see(soc.bank_pout_n >> n & 1, soc.bank_dir >> n & 1);
        }
#endif
        if (armed) soc.stepper_l1_n = part.cw < until;
        if (!sent) continue;
        std::putchar(letter);
        if (letter != '\n') {
            line += letter;
            continue;
        }
        if (line == "switch") {
            armed = true;
            until = part.cw + kToSwitch;
        }
        done = line == "done";
        line.clear();
    }
    std::printf("pulses cw=%u ccw=%u\n", part.cw, part.ccw);
    for (const Motor& motor : axes) std::printf("axis-pulses cw=%u ccw=%u\n", motor.cw, motor.ccw);
    return done ? 0 : 1;
}

double sc_time_stamp() { return 0; }
