// SPDX-License-Identifier: Apache-2.0
// Stations of ppmc312_line: objects of the class that Verilator generates from line_station.
#include <string>

#include "Vstation.h"
#include "svdpi.h"
#include "verilated.h"

// Return a new station, out of reset, before its first clock edge.
extern "C" void* line_station_new(int number) {
    auto* const station = new Vstation{Verilated::threadContextp(), ("station" + std::to_string(number)).c_str()};
    station->rst_n = 1;
    station->clk = 0;
    station->eval();
    return station;
}

// Simulate one rising edge with the input pins before it. Return the output pins after it.
extern "C" int line_station_clk(void* handle, svBit rst_n, int pins) {
    auto* const station = static_cast<Vstation*>(handle);
    station->rst_n = rst_n;
    station->pins_i = pins;
    station->clk = 0;
    station->eval();
    station->clk = 1;
    station->eval();
    return static_cast<int>(station->pins_o);
}
