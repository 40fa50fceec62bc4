// SPDX-License-Identifier: Apache-2.0
#include "plant.h"

void Plant::look() {
    l1 = position_ >= text_.cw;
    l2 = position_ <= text_.ccw;
    l3 = position_ >= text_.slow_cw;
    l4 = position_ <= text_.slow_ccw;
    cnp = position_ <= text_.origin && position_ >= text_.origin_from;
    index = text_.index && (position_ - kIndexAt) % text_.index == 0;
    alm = text_.alarm_from && position_ >= *text_.alarm_from && position_ <= *text_.alarm_to;
}
