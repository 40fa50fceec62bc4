// SPDX-License-Identifier: Apache-2.0
// What pins.h of a part is written in: places of bits, motors on outputs, switches on inputs.
#pragma once

#include <cstdint>

#include "Vpart.h"

struct Bit {
    int word;  // of the inputs or outputs; -1: there is none
    uint32_t place;
};

// A motor steps with an edge of a bit, or with the phases, five bits from `step` on.
struct Drive {
    Bit step, dir;
    bool phases, rises, ccw;  // the step is a rise; level of dir that turns CCW
    Bit encoder, encoder_dir;  // inputs that tell the part what the axle did
};

// In the order of tb/board/plant.h: l1, l2, l3, l4, cnp, alm; a closed one is low.
struct Switches {
    Bit at[6];
};
