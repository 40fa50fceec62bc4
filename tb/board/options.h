// SPDX-License-Identifier: Apache-2.0
// Arguments name=value of the virtual board. openppmc.sim checks the arguments for the user. Here, an error
// only ends the program.
#pragma once

#include <cstdint>
#include <string>

#include "pins.h"

struct Options {
    PlantText plants[kAxes];
    double speed = 1.0;     // board time / real time; 0: as fast as possible
    std::string vcd;        // file name; empty: no waveforms
    double vcd_from = 0;    // begin of the waveforms in ms of board time
    double vcd_for = 20;    // duration of the waveforms in ms
    std::string log;        // file for the pulses; empty: no log
};

// Throws std::runtime_error with a message of one line.
Options parse_options(int argc, char** argv);
