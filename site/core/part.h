// SPDX-License-Identifier: Apache-2.0
// One Verilated part: its clock and its reset.
#pragma once

#include "Vpart.h"
#include "Vpart___024root.h"

inline void power_on(Vpart& part) {
    part.clk = 0;
    part.rst_n = 1;
    part.eval();
}

inline void rise(Vpart& part) {
    part.clk = 1;
    part.eval();
}

// No block uses the falling edge. If Verilator has this variable, it is set as if clk had been low; then the falling
// edge need not be simulated (tb/board/dut.h).
template <class Root>
auto rearm(Vpart&, Root& root, int) -> decltype(root.__Vtrigprevexpr___TOP__clk__0, void()) {
    root.__Vtrigprevexpr___TOP__clk__0 = 0;
}
template <class Root>
void rearm(Vpart& part, Root&, long) {
    part.clk = 0;
    part.eval();
}
inline void rearm(Vpart& part) { rearm(part, *part.rootp, 0); }

inline void set_reset(Vpart& part, bool level) { part.rst_n = level; }

inline void settle(Vpart& part) { part.eval(); }
