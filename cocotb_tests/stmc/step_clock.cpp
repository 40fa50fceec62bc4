// SPDX-License-Identifier: Apache-2.0
// Simulates ppmc_square for SECONDS, cycle by cycle, and compares the time of each toggle with its exact value.
// Prints the number of toggles. At the first toggle with a wrong time, prints one line and exits with code 1.
#include <cstdint>
#include <cstdio>

#include "Vppmc_square.h"

int main() {
    // A period has two toggles. Toggle t occurs after ceil(t * CLK_HZ / TOGGLE_HZ) cycles: less than a cycle late.
    const std::uint64_t clk_hz = CLK_HZ, toggle_hz = TOGGLE_HZ, last = clk_hz * SECONDS;
    Vppmc_square dut;
    dut.clk_i = 0;
    dut.rst_ni = 0;
    dut.eval();
    dut.rst_ni = 1;
    std::uint64_t toggles = 0;
    std::uint64_t due = (clk_hz + toggle_hz - 1) / toggle_hz;
    for (std::uint64_t clk = 1; clk <= last; ++clk) {
        const unsigned before = dut.wave_o;
        dut.clk_i = 1;
        dut.eval();
        dut.clk_i = 0;
        dut.eval();
        if ((dut.wave_o != before) != (clk == due)) {
            std::printf("toggle %llu belongs to clk %llu, wave_o is %u after clk %llu\n", toggles + 1ULL,
                        static_cast<unsigned long long>(due), static_cast<unsigned>(dut.wave_o),
                        static_cast<unsigned long long>(clk));
            return 1;
        }
        if (clk == due) {
            ++toggles;
            due = ((toggles + 1) * clk_hz + toggle_hz - 1) / toggle_hz;
        }
    }
    std::printf("%llu\n", static_cast<unsigned long long>(toggles));
    return 0;
}
