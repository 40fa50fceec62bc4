// SPDX-License-Identifier: Apache-2.0
// Types for the pins.h of a part: positions of bits, motors on outputs, switches on inputs.
#pragma once

#include <cstdint>

#include "Vpart.h"

struct Bit {
    int word;  // number among the words of inputs or outputs; -1: not connected
    uint32_t place;
};

// A motor steps with an edge of the bit `step`, or with its phases, five bits from `step` on.
struct Drive {
    Bit step, dir;
    bool phases, rises, ccw;  // phases: step by phases; rises: step by a rising edge; ccw: level of dir for CCW
    Bit encoder, encoder_dir;  // inputs that report the rotation of the shaft
};

// In the order of tb/board/plant.h: l1, l2, l3, l4, cnp, alm; a closed switch is low.
struct Switches {
    Bit at[6];
};
